// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Bakes the Cornell box into a video file, reads it back, and saves a view of it:
// BakeCornellBox [viewpoints a side] [texels a side] [samples]
#include <vtkCSLFCornellBoxSource.h>
#include <vtkCSLFDecoder.h>
#include <vtkCSLFEncoder.h>
#include <vtkCSLFMapper.h>
#include <vtkCSLFSampler.h>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>

int main(int argc, char* argv[])
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->SetViewpoints(argc > 1 ? std::atoi(argv[1]) : 5);
  sampler->SetResolution(argc > 2 ? std::atoi(argv[2]) : 64);
  sampler->SetSamples(argc > 3 ? std::atoi(argv[3]) : 16);
  sampler->SetEnvironmentModeToNone(); // the box has a lamp

  vtkNew<vtkCSLFEncoder> encoder; // pulls viewpoints from the sampler, a few at a time
  encoder->SetInputConnection(sampler->GetOutputPort());
  encoder->SetFileName("CornellBox.mp4");
  if (!encoder->Write())
  {
    return EXIT_FAILURE;
  }

  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName("CornellBox.mp4");
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(decoder->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->SetPosition(0.7, 0.5, 6.0);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkRenderWindow> window;
  window->SetSize(320, 320);
  window->AddRenderer(renderer);
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName("CornellBox.png");
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
