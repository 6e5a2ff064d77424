// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The pictures of all lookups side by side: nearest, linear, bilinear, focal, depth and geometry.
#include "cslfTestField.h"
#include "cslfTestImage.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

int TestCSLFMapperImage(int argc, char* argv[])
{
  const auto field = cslf::testing::MakeTestField(
    cslf::Layout(5, 64), cslf::Cube(), VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(150 * vtkCSLFMapper::NUMBER_OF_LOOKUPS, 150);
  constexpr double width = 1.0 / vtkCSLFMapper::NUMBER_OF_LOOKUPS;
  for (int lookup = vtkCSLFMapper::NEAREST; lookup < vtkCSLFMapper::NUMBER_OF_LOOKUPS; ++lookup)
  {
    vtkNew<vtkCSLFMapper> mapper;
    mapper->SetInputData(field);
    mapper->SetGeometryData(cslf::testing::MakeTestSurfaces(cslf::Cube()));
    mapper->SetLookup(lookup);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkNew<vtkRenderer> renderer;
    renderer->SetViewport(width * lookup, 0.0, width * (lookup + 1), 1.0);
    renderer->SetBackground(0.2, 0.2, 0.25);
    renderer->AddActor(actor);
    renderer->GetActiveCamera()->SetPosition(1.5, 1.0, 4.0);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Zoom(1.5);
    window->AddRenderer(renderer);
  }
  CSLF_CHECK(cslf::testing::MatchesBaseline(argc, argv, window));
  return cslf::testing::Result();
}
