// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes of points, wireframes and lines, and of images in any plane.
#include "cslfSheetParts.h"
#include "cslfSheetScenes.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace cslf
{
namespace testing
{
namespace
{
/// A tube of triangle strips around a wave, with a colour for each strip.
vtkSmartPointer<vtkPolyData> MakeStrips(double y)
{
  vtkNew<vtkLineSource> line;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 13; ++i)
  {
    points->InsertNextPoint(0.16 * i - 0.96, y + 0.15 * std::sin(0.9 * i), 0.0);
  }
  line->SetPoints(points);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputConnection(line->GetOutputPort());
  tube->SetNumberOfSides(8);
  tube->SetRadius(0.25);
  tube->Update();
  vtkSmartPointer<vtkPolyData> strips = tube->GetOutput();
  strips->GetPointData()->Initialize();
  strips->GetCellData()->Initialize();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < strips->GetNumberOfCells(); ++i)
  {
    colors->InsertNextTuple3(i % 3 == 0 ? 230 : 60, i % 3 == 1 ? 200 : 90, i % 3 == 2 ? 220 : 50);
  }
  strips->GetCellData()->SetScalars(colors);
  return strips;
}

void BuildPoints(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  // Only the points that cells use, in the colours of the cells.
  for (const bool asSpheres : { false, true })
  {
    vtkProperty* property = AddData(renderer, MakeStrips(asSpheres ? 0.5 : -0.5))->GetProperty();
    property->SetRepresentationToPoints();
    property->SetRenderPointsAsSpheres(asSpheres);
    property->SetPointSize(asSpheres ? 18.0 : 12.0);
  }
  Look(renderer, 0.2, 0.3, 1.0);
}

/// Three curves of several points, with a colour for each curve, and vertices at their ends.
vtkSmartPointer<vtkPolyData> MakeCurves(double y)
{
  auto curves = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->InsertNextTuple3(60, 40, 160);
  vertices->InsertNextCell(3);
  for (int curve = 0; curve < 3; ++curve)
  {
    colors->InsertNextTuple3(210 - 60 * curve, 90 + 40 * curve, 60);
    lines->InsertNextCell(25);
    for (int i = 0; i < 25; ++i)
    {
      lines->InsertCellPoint(points->InsertNextPoint(
        0.08 * i - 0.96, y + 0.2 * curve + 0.12 * std::sin(0.5 * i + curve), 0.0));
    }
    vertices->InsertCellPoint(points->GetNumberOfPoints() - 1);
  }
  curves->SetPoints(points);
  curves->SetVerts(vertices);
  curves->SetLines(lines);
  curves->GetCellData()->SetScalars(colors);
  return curves;
}

void BuildWireframe(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkProperty* strips = AddData(renderer, MakeStrips(0.5))->GetProperty();
  strips->SetRepresentationToWireframe();
  strips->SetLineWidth(4.0);
  strips->SetAmbient(1.0); // because VTK draws wide edges with wrong normals
  strips->SetDiffuse(0.0);
  vtkProperty* curves = AddData(renderer, MakeCurves(-0.8))->GetProperty();
  curves->SetRepresentationToWireframe();
  curves->SetLineWidth(9.0);
  curves->SetPointSize(24.0);
  Look(renderer, 0.0, 0.0, 1.0);
}

void BuildUnlitLines(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkProperty* shining = AddData(renderer, MakeCurves(0.3))->GetProperty();
  shining->LightingOff();
  vtkProperty* lit = AddData(renderer, MakeCurves(-0.7))->GetProperty();
  lit->SetAmbient(0.3);
  lit->SetDiffuse(0.7);
  for (vtkProperty* property : { shining, lit })
  {
    property->SetLineWidth(12.0);
    property->SetPointSize(30.0);
  }
  Look(renderer, 0.0, 0.0, 1.0);
}

vtkSmartPointer<vtkImageData> MakeColumn()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(1, 8, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int row = 0; row < 8; ++row)
  {
    image->GetPointData()->GetScalars()->SetTuple3(row, 30 * row + 20, 120, 240 - 30 * row);
  }
  return image;
}

void BuildTexturePlanes(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  // Letters in the planes XY, XZ and YZ, and one column of eight pixels.
  for (int i = 0; i < 4; ++i)
  {
    vtkSmartPointer<vtkImageData> image = MakeLetters();
    const int* size = image->GetDimensions();
    if (i == 1)
    {
      image->SetExtent(3, size[0] + 2, 5, 5, -2, size[1] - 3);
    }
    if (i == 2)
    {
      image->SetExtent(7, 7, -4, size[0] - 5, 1, size[1]);
    }
    if (i == 3)
    {
      image = MakeColumn();
    }
    vtkNew<vtkTexture> texture;
    texture->SetInputData(image);
    vtkNew<vtkPlaneSource> plane;
    vtkSmartPointer<vtkActor> actor = AddActor(renderer, plane);
    actor->SetTexture(texture);
    actor->SetPosition(1.05 * (i % 2) - 0.525, 0.525 - 1.05 * (i / 2), 0.0);
  }
  Look(renderer, 0.0, 0.0, 1.0);
}
}

std::vector<SheetScene> MakeRepresentationScenes()
{
  return {
    { "Points: strips, cell colours", BuildPoints, Expectation::Bounds, 34.0, 104.0 },
    { "Wireframe: strips, polylines", BuildWireframe, Expectation::Bounds, 17.0, 120.0 },
    { "Lines, points: no lighting", BuildUnlitLines, Expectation::Bounds, 17.0, 165.0 },
    { "Textures: planes, one column", BuildTexturePlanes },
  };
}
}
}
