// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfScenery.h"

#include <vtkActor.h>
#include <vtkAxesActor.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkOutlineSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>

#include <algorithm>

namespace cslf::tool
{
namespace
{
/// The length of the axes, relative to the cube's longest edge.
constexpr double AxisLength = 0.3;

vtkSmartPointer<vtkActor> MakeUnlitActor(vtkMapper* mapper, double r, double g, double b)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(r, g, b);
  return actor;
}
}

vtkSmartPointer<vtkActor> MakeOutline(const Cube& cube)
{
  double bounds[6];
  cube.GetBounds(bounds);
  vtkNew<vtkOutlineSource> source;
  source->SetBounds(bounds);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  return MakeUnlitActor(mapper, 0.7, 0.7, 0.75);
}

vtkSmartPointer<vtkProp> MakeAxes(const Cube& cube)
{
  double bounds[6];
  cube.GetBounds(bounds);
  const double length = AxisLength * std::max({ cube.Edges.x, cube.Edges.y, cube.Edges.z });
  vtkNew<vtkTransform> corner;
  corner->Translate(bounds[0], bounds[2], bounds[5]);
  auto axes = vtkSmartPointer<vtkAxesActor>::New();
  axes->SetUserTransform(corner);
  axes->SetTotalLength(length, length, length);
  for (vtkCaptionActor2D* caption : { axes->GetXAxisCaptionActor2D(),
         axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D() })
  {
    caption->GetTextActor()->SetTextScaleModeToNone();
    caption->GetCaptionTextProperty()->SetFontSize(14);
    caption->GetCaptionTextProperty()->ShadowOff();
    caption->GetCaptionTextProperty()->ItalicOff();
  }
  return axes;
}

vtkSmartPointer<vtkActor> MakeViewpointMarkers(const Description& field)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> dots;
  for (int slice = 0; slice < field.Grid.GetSlices(); ++slice)
  {
    const glm::dvec3 position =
      field.Box.PointToWorld(field.Grid.ViewpointPosition(field.Grid.ViewpointOf(slice)));
    const vtkIdType point = points->InsertNextPoint(position.x, position.y, position.z);
    dots->InsertNextCell(1, &point);
  }
  vtkNew<vtkPolyData> markers;
  markers->SetPoints(points);
  markers->SetVerts(dots);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(markers);
  auto actor = MakeUnlitActor(mapper, 1.0, 0.75, 0.2);
  actor->GetProperty()->SetPointSize(3.0);
  return actor;
}
}
