// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The shortest complete program: the Cornell box is sampled into a video
// file, and a view of it is drawn from that file.
// HelloLightField [viewpoints per side] [texels per side] [samples]
#include <vtkCSLFCornellBoxSource.h>
#include <vtkCSLFDecoder.h>
#include <vtkCSLFEncoder.h>
#include <vtkCSLFEnvironment.h>
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
  // Sample the scene: viewpoints and texels along each side, rays for each texel.
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->SetViewpoints(argc > 1 ? std::atoi(argv[1]) : 9);
  sampler->SetResolution(argc > 2 ? std::atoi(argv[2]) : 128);
  sampler->SetSamples(argc > 3 ? std::atoi(argv[3]) : 16);
  sampler->GetEnvironment()->SetModeToNone(); // the box has a lamp

  // Write the field; the encoder requests a few viewpoints at a time from the sampler.
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(0, sampler->GetOutputPort(0));
  encoder->SetInputConnection(1, sampler->GetOutputPort(1)); // where surfaces are
  encoder->SetFileName("HelloLightField.mp4");
  if (!encoder->Write())
  {
    return EXIT_FAILURE;
  }

  // Draw the field in the file.
  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName("HelloLightField.mp4");
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(0, decoder->GetOutputPort(0));
  mapper->SetInputConnection(1, decoder->GetOutputPort(1));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  renderer->GetActiveCamera()->SetPosition(0.7, 0.5, 4.6);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkRenderWindow> window;
  window->SetSize(640, 640);
  window->AddRenderer(renderer);

  // Save the picture.
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName("HelloLightField.png");
  writer->Write();
  return writer->GetErrorCode() == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
