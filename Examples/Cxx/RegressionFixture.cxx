// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A baked light field as the baseline of another project's tests: one file replaces pictures of a
// pipeline's result from all around. Documentation/RegressionTests.md explains it.
// RegressionFixture --bake    writes the fixture; do this once
// RegressionFixture           tests the pipeline against it
#include <vtkCSLFDecoder.h>
#include <vtkCSLFEncoder.h>
#include <vtkCSLFFieldReference.h>
#include <vtkCSLFRateControl.h>
#include <vtkCSLFSampler.h>

#include <vtkActor.h>
#include <vtkContourFilter.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRTAnalyticSource.h>
#include <vtkRenderer.h>

#include <cstdlib>
#include <iostream>
#include <string>

namespace
{
const char* const Fixture = "RegressionFixture.mp4";

/// The object of the test: the project's own pipeline and the actors that show it.
void FillRenderer(vtkRenderer* renderer, double isovalue)
{
  vtkNew<vtkRTAnalyticSource> image;
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(image->GetOutputPort());
  contour->SetValue(0, isovalue);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(contour->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.6, 0.3);
  renderer->AddActor(actor);
}

/// Writes the fixture from the current pipeline.
bool Bake()
{
  vtkNew<vtkRenderer> renderer;
  FillRenderer(renderer, 150.0);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetRenderer(renderer);
  sampler->SetViewpoints(3);
  sampler->SetResolution(32);
  sampler->SetSamples(64);
  sampler->SetIntegratorToPathTracing(); // as the comparison does
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(sampler->GetOutputPort());
  encoder->SetFileName(Fixture);
  encoder->GetRateControl()->SetCRF(12.0);
  return encoder->Write() != 0;
}

/// The fixture's PSNR in dB against the pipeline with an isovalue, at 2000 texels.
double Compare(double isovalue)
{
  vtkNew<vtkRenderer> renderer;
  FillRenderer(renderer, isovalue);
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName(Fixture);
  vtkNew<vtkCSLFFieldReference> reference;
  reference->SetRenderer(renderer);
  reference->SetInputConnection(1, decoder->GetOutputPort());
  reference->SetTexels(2000);
  reference->SetSamples(64);
  vtkObject::GlobalWarningDisplayOff(); // that the scene is not the one that was baked
  reference->Update();
  vtkObject::GlobalWarningDisplayOn();
  return reference->GetPSNR();
}
}

int main(int argc, char* argv[])
{
  if (argc > 1 && std::string(argv[1]) == "--bake" && !Bake())
  {
    return EXIT_FAILURE;
  }
  const double same = Compare(150.0);
  const double changed = Compare(160.0); // what a single camera might not see
  std::cout << "as it was: " << same << " dB, with another isovalue: " << changed << " dB\n";
  return same > 30.0 && changed < 25.0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
