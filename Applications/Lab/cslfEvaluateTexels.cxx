// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf-lab evaluate-texels: compares a light field's texels with path-traced ones.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Console/cslfTable.h"
#include "Fields/cslfFieldFiles.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfLab.h"

#include "vtkCSLFFieldReference.h"

#include <vtkAlgorithm.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <memory>

namespace cslf::tool
{
namespace
{
struct Options
{
  FieldInput Field;
  SceneOptions Scene;
  int Texels = 100000;
  int Samples = 4096;
  int Seed = 0;
};

Result Run(Options options)
{
  const FieldFile file = OpenField(options.Field);
  options.Scene.TakeDefaults(nlohmann::json::parse(file.Field.Sampling, nullptr, false));
  const Scene scene = options.Scene.Read();
  vtkNew<vtkCSLFFieldReference> reference;
  options.Scene.Apply(scene, reference);
  reference->SetInputConnection(1, file.Reader->GetOutputPort());
  reference->SetTexels(options.Texels);
  reference->SetSamples(options.Samples);
  reference->SetSeed(options.Seed);
  {
    const ProgressBar bar(reference, "Tracing the reference");
    reference->Update();
  }
  ThrowOnError();

  Result result;
  result.JSON = { { "field", options.Field.FileName },
    { "bytes", CountBytes(options.Field.FileName) }, { "texels", reference->GetNumberOfTexels() },
    { "reference_spp", options.Samples }, { "seed", options.Seed },
    { "psnr", reference->GetPSNR() }, { "noise_floor", reference->GetNoiseFloor() } };
  result.Text = options.Field.FileName + ": PSNR " + Format(reference->GetPSNR(), 2) + " dB over " +
    std::to_string(reference->GetNumberOfTexels()) +
    " texels\nnoise floor of the reference: " + Format(reference->GetNoiseFloor(), 2) + " dB (" +
    std::to_string(options.Samples) + " samples per texel)\n";
  for (int i = 0;
       reference->GetNumberOfViewExposures() > 1 && i < reference->GetNumberOfViewExposures(); ++i)
  {
    const double exposure = reference->GetViewExposure(i);
    result.JSON["view_exposures"].push_back({ { "exposure", exposure },
      { "psnr", reference->GetPSNR(i) }, { "noise_floor", reference->GetNoiseFloor(i) } });
    result.Text += "displayed at " + Format(exposure, 4) + " times the exposure: PSNR " +
      Format(reference->GetPSNR(i), 2) + " dB\n";
  }
  WarnOfNoise(reference->GetNoiseFloor(), reference->GetPSNR(), "the field", "--reference-spp");
  return result;
}
}

void AddEvaluateTexels(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "evaluate-texels", "Measure texels of a light field against path-traced texels");
  command->footer(MakeFooter({ "cslf-lab evaluate-texels box.mp4 cornell-box" },
    "Prints the PSNR (at most 60 dB) of 8-bit red, green and blue over black, for float fields "
    "also at 1/16, 1/4, 4 and 16 times the exposure. The texels are chosen at random, evenly over "
    "all viewpoints, and path-traced in two halves with different random numbers. The noise floor "
    "is the PSNR of one half against the other plus 6.02 dB, because their mean has a quarter of "
    "the variance of their difference. Specify the scene, light and material that the field was "
    "sampled with."));
  const auto options = std::make_shared<Options>();
  options->Field.AddTo(*command);
  options->Scene.AddTo(*command);
  command->option_defaults()->always_capture_default();
  command->add_option("--texels", options->Texels, "texels to measure, or all if there are fewer")
    ->check(Between(1, 100000000));
  command
    ->add_option("--reference-spp", options->Samples,
      "samples per texel of the reference, in both halves together; rounded up to a multiple of 32")
    ->check(Between(1, 1 << 24));
  command->add_option("--seed", options->Seed, "random seed of texels and the reference");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
