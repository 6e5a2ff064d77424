// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A bake within a given time: it takes as many samples as fit, shows its progress, and can be
// aborted, after which none of its files remain.
// TimedBake [viewpoints per side] [texels per side] [seconds]
#include "Example.h"

#include <vtkCSLFBakeEstimator.h>
#include <vtkCSLFCornellBoxSource.h>
#include <vtkCSLFDecoder.h>
#include <vtkCSLFEncoder.h>
#include <vtkCSLFEnvironment.h>

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace
{
struct Progress
{
  double AbortAt = 2.0; ///< of [0,1]: never
  int Tenths = 0;
};

/// Prints the progress of a bake, and aborts it at a given progress.
void OnProgress(vtkObject* caller, unsigned long, void* clientData, void*)
{
  auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
  auto* progress = static_cast<Progress*>(clientData);
  const int tenths = static_cast<int>(10.0 * algorithm->GetProgress());
  if (tenths > progress->Tenths)
  {
    progress->Tenths = tenths;
    std::cout << 10 * tenths << " %" << std::endl;
  }
  if (algorithm->GetProgress() >= progress->AbortAt)
  {
    algorithm->SetAbortExecute(1);
  }
}

/// Returns whether the file was written.
bool Bake(vtkCSLFEncoder* encoder, double abortAt)
{
  Progress progress;
  progress.AbortAt = abortAt;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback(OnProgress);
  observer->SetClientData(&progress);
  encoder->SetAbortExecute(0);
  const unsigned long tag = encoder->AddObserver(vtkCommand::ProgressEvent, observer);
  const bool written = encoder->Write() != 0;
  encoder->RemoveObserver(tag);
  return written;
}
}

int main(int argc, char* argv[])
{
  vtkNew<vtkCSLFCornellBoxSource> box;
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputConnection(box->GetOutputPort());
  sampler->SetViewpoints(argc > 1 ? std::atoi(argv[1]) : 9);
  sampler->SetResolution(argc > 2 ? std::atoi(argv[2]) : 128);
  sampler->GetEnvironment()->SetModeToNone(); // the box has a lamp
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(sampler->GetOutputPort());
  encoder->SetFileName("TimedBake.mp4");

  // A short probe predicts the cost of the bake, and how many samples fit.
  vtkNew<vtkCSLFBakeEstimator> estimator;
  estimator->SetSampler(sampler);
  estimator->SetEncoder(encoder);
  estimator->SetProbeSeconds(2.0);
  if (!estimator->ChooseSamples(argc > 3 ? std::atof(argv[3]) : 60.0))
  {
    std::cerr << "Not even one sample for each texel fits.\n";
    return EXIT_FAILURE;
  }
  sampler->SetSamples(std::min(sampler->GetSamples(), 64)); // more make no visible difference
  std::cout << sampler->GetSamples() << " samples, in at most " << estimator->GetSeconds()
            << " s: " << estimator->GetBytes() / 1e3 << " kB\n";

  // Abort the bake, as if a user pressed a button: neither the file nor its parts remain.
  std::filesystem::remove("TimedBake.mp4");
  if (Bake(encoder, 0.3) || std::filesystem::exists("TimedBake.mp4"))
  {
    std::cerr << "The bake was not aborted.\n";
    return EXIT_FAILURE;
  }
  std::cout << "aborted\n";
  if (!Bake(encoder, 2.0))
  {
    return EXIT_FAILURE;
  }

  vtkNew<vtkCSLFDecoder> decoder;
  decoder->SetFileName("TimedBake.mp4");
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(example::MakeFieldActor(decoder));
  renderer->GetActiveCamera()->SetPosition(-0.9, 0.6, 4.2);
  renderer->ResetCameraClippingRange();
  vtkNew<vtkRenderWindow> window;
  window->SetSize(640, 640);
  window->AddRenderer(renderer);
  return example::SavePicture(window, "TimedBake.png");
}
