// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A light field in a VTK pipeline and scene: a contour of image data, coloured by how steeply the
// data changes there, becomes a light field, which is shown with an outline, axes and a scalar bar.
// Isosurface [viewpoints per side] [texels per side] [samples]
#include "Example.h"

#include <vtkCSLFEnvironment.h>
#include <vtkCSLFRadianceCacheOptions.h>

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourFilter.h>
#include <vtkCubeAxesActor.h>
#include <vtkDataArray.h>
#include <vtkImageGradientMagnitude.h>
#include <vtkOutlineFilter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataNormals.h>
#include <vtkProbeFilter.h>
#include <vtkProperty.h>
#include <vtkRTAnalyticSource.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkTextProperty.h>

int main(int argc, char* argv[])
{
  // The data: an isosurface, coloured by the magnitude of the gradient.
  vtkNew<vtkRTAnalyticSource> image;
  image->SetWholeExtent(-20, 20, -20, 20, -20, 20);
  image->SetStandardDeviation(0.35);
  image->SetXFreq(18.0);
  image->SetYFreq(12.0);
  image->SetZFreq(15.0);
  image->SetXMag(15.0);
  image->SetYMag(15.0);
  image->SetZMag(15.0);
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(image->GetOutputPort());
  contour->SetValue(0, 120.0);
  vtkNew<vtkImageGradientMagnitude> steepness;
  steepness->SetInputConnection(image->GetOutputPort());
  steepness->SetDimensionality(3);
  vtkNew<vtkProbeFilter> probe;
  probe->SetInputConnection(contour->GetOutputPort());
  probe->SetSourceConnection(steepness->GetOutputPort());
  vtkNew<vtkPolyDataNormals> surface;
  surface->SetInputConnection(probe->GetOutputPort());
  surface->SplittingOff();
  surface->Update();
  double range[2];
  surface->GetOutput()->GetPointData()->GetScalars()->GetRange(range);
  vtkNew<vtkColorTransferFunction> colors;
  colors->AddRGBPoint(range[0], 0.25, 0.1, 0.45);
  colors->AddRGBPoint(0.5 * (range[0] + range[1]), 0.1, 0.6, 0.6);
  colors->AddRGBPoint(range[1], 1.0, 0.9, 0.25);

  // Its light field, under a sky that is brighter at the top.
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(surface->GetOutputPort());
  sampler->SetLookupTable(colors);
  sampler->GetCacheOptions()->SetSamples(256); // few are enough for smooth light
  sampler->GetEnvironment()->SetModeToGradient();
  sampler->GetEnvironment()->SetUp(0.0, 0.0, 1.0);
  example::SetSizes(sampler, argc, argv);

  // The scene.
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.15, 0.16, 0.2);
  renderer->AddActor(example::MakeFieldActor(sampler));
  vtkNew<vtkOutlineFilter> outline;
  outline->SetInputConnection(image->GetOutputPort());
  const auto outlineActor = example::MakeActor(outline);
  outlineActor->GetProperty()->SetLineWidth(2.0);
  renderer->AddActor(outlineActor);
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetTitle("Slope");
  bar->SetNumberOfLabels(4);
  bar->SetLabelFormat("%.0f");
  bar->SetUnconstrainedFontSize(true);
  bar->SetPosition(0.85, 0.2);
  bar->SetWidth(0.12);
  bar->SetHeight(0.6);
  renderer->AddViewProp(bar);
  vtkNew<vtkCubeAxesActor> axes;
  outline->Update();
  axes->SetBounds(outline->GetOutput()->GetBounds());
  axes->SetCamera(renderer->GetActiveCamera());
  axes->SetFlyModeToOuterEdges();
  axes->XAxisMinorTickVisibilityOff();
  axes->YAxisMinorTickVisibilityOff();
  axes->ZAxisMinorTickVisibilityOff();
  for (int axis = 0; axis < 3; ++axis)
  {
    for (vtkTextProperty* text :
      { axes->GetTitleTextProperty(axis), axes->GetLabelTextProperty(axis) })
    {
      text->SetFontSize(12);
    }
  }
  renderer->AddViewProp(axes);

  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetPosition(62.0, -114.0, 66.0);
  camera->SetWindowCenter(0.1, 0.0);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkRenderWindow> window;
  window->SetSize(640, 480);
  window->AddRenderer(renderer);
  return example::SavePicture(window, "Isosurface.png");
}
