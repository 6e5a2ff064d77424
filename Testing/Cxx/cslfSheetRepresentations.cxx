// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Scenes of points, wireframes, lines and unusual polygons, and of images in any plane.
#include "cslfSheetParts.h"
#include "cslfSheetScenes.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkLineSource.h>
#include <vtkMath.h>
#include <vtkMinimalStandardRandomSequence.h>
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
#include <utility>
#include <vector>

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

void BuildPolygons(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  // A square whose hole is joined to its outline by a bridge, a star that crosses itself, a bow tie,
  // and a square whose corners come in rows.
  const std::vector<std::vector<std::pair<double, double>>> outlines = {
    { { -0.95, 0.1 }, { -0.1, 0.1 }, { -0.1, 0.95 }, { -0.95, 0.95 }, { -0.95, 0.1 },
      { -0.7, 0.35 }, { -0.7, 0.7 }, { -0.35, 0.7 }, { -0.35, 0.35 }, { -0.7, 0.35 } },
    { { 0.23, 0.1 }, { 0.52, 1.0 }, { 0.81, 0.1 }, { 0.05, 0.66 }, { 0.99, 0.66 } },
    { { -0.95, -0.9 }, { -0.1, -0.15 }, { -0.1, -0.9 }, { -0.95, -0.15 } },
    { { 0.15, -0.95 }, { 0.95, -0.95 }, { 0.15, -0.15 }, { 0.95, -0.15 } },
  };
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (const auto& outline : outlines)
  {
    polygons->InsertNextCell(static_cast<vtkIdType>(outline.size()));
    for (const auto& corner : outline)
    {
      polygons->InsertCellPoint(points->InsertNextPoint(corner.first, corner.second, 0.0));
    }
    const vtkIdType i = colors->GetNumberOfTuples();
    colors->InsertNextTuple3(200 - 40 * i, 90 + 30 * i, 60 + 45 * i);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->GetCellData()->SetScalars(colors);
  AddData(renderer, data);
  Look(renderer, 0.0, 0.0, 1.0);
}

void BuildCloud(vtkRenderer* renderer)
{
  AddHeadlight(renderer);
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(7);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  while (points->GetNumberOfPoints() < 600)
  {
    double point[3];
    for (double& coordinate : point)
    {
      coordinate = random->GetNextRangeValue(-1.0, 1.0);
    }
    if (vtkMath::Norm(point) < 1.0)
    {
      const vtkIdType id = points->InsertNextPoint(point);
      vertices->InsertNextCell(1, &id);
      colors->InsertNextTuple3(120 + 100 * point[1], 150 - 50 * point[0], 140 - 100 * point[1]);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetVerts(vertices);
  data->GetPointData()->SetScalars(colors);
  vtkProperty* property = AddData(renderer, data)->GetProperty();
  property->SetRenderPointsAsSpheres(true);
  property->SetPointSize(25.0); // in the window only
  Look(renderer, 0.2, 0.3, 1.0);
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
    { "Polygons that cross themselves", BuildPolygons, Expectation::Bounds, 4.0, 160.0 },
    { "Cloud, radius from the spacing", BuildCloud, Expectation::Bounds, 34.0, 190.0, 0.0, -1.0 },
  };
}
}
}
