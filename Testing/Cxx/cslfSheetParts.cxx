// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSheetParts.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

namespace cslf
{
namespace testing
{
vtkSmartPointer<vtkActor> AddActor(vtkRenderer* renderer, vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

vtkSmartPointer<vtkActor> AddData(vtkRenderer* renderer, vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  return actor;
}

vtkCamera* Look(vtkRenderer* renderer, double x, double y, double z, double reach)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(reach);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  double position[3] = { x, y, z };
  vtkMath::Normalize(position);
  vtkMath::MultiplyScalar(position, 10.0);
  camera->SetPosition(position);
  camera->SetViewUp(0.0, 1.0, 0.0);
  return camera;
}

void AddHeadlight(vtkRenderer* renderer)
{
  vtkNew<vtkLight> light;
  light->SetLightTypeToHeadlight();
  renderer->AddLight(light);
}

vtkSmartPointer<vtkImageData> MakeLetters()
{
  vtkNew<vtkTextProperty> style;
  style->SetFontSize(48);
  style->BoldOn();
  style->SetColor(0.95, 0.9, 0.3);
  style->SetBackgroundColor(0.15, 0.25, 0.5);
  style->SetBackgroundOpacity(1.0);
  vtkNew<vtkTextRenderer> text;
  text->SetScaleToPowerOfTwo(false);
  auto image = vtkSmartPointer<vtkImageData>::New();
  int size[2];
  text->RenderString(style, "VTK", image, size, 72);
  return image;
}
}
}
