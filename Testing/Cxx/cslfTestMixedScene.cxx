// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTestMixedScene.h"

#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkConeSource.h>
#include <vtkNew.h>
#include <vtkOutlineSource.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

namespace cslf
{
namespace testing
{
namespace
{
void AddActor(
  vtkRenderer* renderer, vtkPolyDataAlgorithm* source, double r, double g, double b, double opacity)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(r, g, b);
  actor->GetProperty()->SetOpacity(opacity);
  renderer->AddActor(actor);
}
}

void AddMixedScene(vtkRenderer* renderer, vtkCSLFMapper* mapper)
{
  renderer->SetBackground(0.2, 0.2, 0.25);

  vtkNew<vtkPlaneSource> behind;
  behind->SetOrigin(-1.5, -1.5, -1.6);
  behind->SetPoint1(0.4, -1.5, -1.6);
  behind->SetPoint2(-1.5, 1.2, -1.6);
  AddActor(renderer, behind, 0.9, 0.9, 0.9, 1.0);

  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);

  vtkNew<vtkConeSource> cone;
  cone->SetCenter(0.0, -0.15, 0.3);
  cone->SetDirection(-0.5, -0.4, 1.0);
  cone->SetHeight(1.1);
  cone->SetRadius(0.3);
  cone->SetResolution(48);
  AddActor(renderer, cone, 0.9, 0.4, 0.1, 1.0);

  vtkNew<vtkPlaneSource> sheet;
  sheet->SetOrigin(0.1, -0.8, 0.75);
  sheet->SetPoint1(0.8, -0.8, 0.75);
  sheet->SetPoint2(0.1, 0.3, 0.75);
  AddActor(renderer, sheet, 0.2, 0.5, 1.0, 0.4);

  vtkNew<vtkOutlineSource> outline;
  outline->SetBounds(mapper->GetBounds());
  AddActor(renderer, outline, 1.0, 1.0, 1.0, 1.0);

  vtkNew<vtkAxesActor> axes;
  axes->AxisLabelsOff();
  axes->SetTotalLength(1.3, 1.3, 1.3);
  renderer->AddActor(axes);

  vtkNew<vtkTextActor> text;
  text->SetInput("light field");
  text->SetPosition(10, 10);
  text->GetTextProperty()->SetFontSize(20);
  renderer->AddActor(text);

  renderer->GetActiveCamera()->SetPosition(2.0, 1.6, 4.0);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.3);
}
}
}
