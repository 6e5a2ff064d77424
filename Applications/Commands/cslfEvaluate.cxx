// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf evaluate: novel views looked up in a light field, measured against path-traced ones.
#include "cslfCameraOptions.h"
#include "cslfCommands.h"
#include "cslfContactSheet.h"
#include "cslfFieldFiles.h"
#include "cslfMessages.h"
#include "cslfNovelViewOptions.h"
#include "cslfNovelViews.h"
#include "cslfPictures.h"
#include "cslfSceneFiles.h"
#include "cslfStatistics.h"
#include "cslfTable.h"
#include "cslfToneOptions.h"

#include "vtkCSLFImageQuality.h"

#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace cslf
{
namespace tool
{
namespace
{
struct Options
{
  std::string Field;
  SceneOptions Scene;
  std::string OutputFolder;
  std::string ContactSheet;
  std::string Title;
  NovelViewOptions Novel;
  ToneOptions Tone;
};

/// A lookup's figures, one for each view.
struct Score
{
  LookupName Lookup;
  std::vector<double> PSNR;
  std::vector<double> SSIM;
  double FrameRate = 0.0;
};

void CheckOutputs(const Options& options)
{
  std::error_code failure;
  if (!options.OutputFolder.empty())
  {
    std::filesystem::create_directories(options.OutputFolder, failure);
    RequireWritable(options.OutputFolder + "/view-0-truth.png");
  }
  if (!options.ContactSheet.empty())
  {
    RequireWritable(options.ContactSheet);
  }
}

void SaveView(const Options& options, int view, const std::string& name, vtkImageData* picture)
{
  if (!options.OutputFolder.empty())
  {
    WritePicture(
      options.OutputFolder + "/view-" + std::to_string(view) + "-" + name + ".png", picture);
  }
}

std::vector<Score> MakeScores(const Description& description)
{
  std::vector<Score> scores;
  for (const LookupName& lookup : GetLookups(description))
  {
    scores.push_back({ lookup, {}, {}, 0.0 });
  }
  return scores;
}

Result Report(
  const Options& options, const std::vector<Score>& scores, const std::vector<double>& noiseFloors)
{
  const double noiseFloor = Mean(noiseFloors);
  Result result;
  result.JSON = { { "field", options.Field }, { "bytes", CountBytes(options.Field) },
    { "views", options.Novel.Views }, { "size", options.Novel.Size },
    { "spp", options.Novel.Samples }, { "seed", options.Novel.Seed },
    { "noise_floor", noiseFloor } };
  Table table;
  table.AddRow({ "lookup", "PSNR (dB)", "lowest", "SSIM", "frames/s" });
  double best = 0.0;
  for (const Score& score : scores)
  {
    result.JSON["lookups"][score.Lookup.Name] = { { "psnr", Mean(score.PSNR) },
      { "lowest_psnr", Minimum(score.PSNR) }, { "psnr_of_views", score.PSNR },
      { "ssim", Mean(score.SSIM) }, { "frames_per_second", score.FrameRate } };
    table.AddRow({ score.Lookup.Name, Format(Mean(score.PSNR), 2), Format(Minimum(score.PSNR), 2),
      Format(Mean(score.SSIM), 4), Format(score.FrameRate, 1) });
    best = std::max(best, Mean(score.PSNR));
  }
  result.Text = options.Field + ": " + std::to_string(CountBytes(options.Field)) + " bytes, " +
    std::to_string(options.Novel.Views) + " views of " + std::to_string(options.Novel.Size) +
    " x " + std::to_string(options.Novel.Size) + "\n" + table.ToText() +
    "noise floor of the truth: " + Format(noiseFloor, 2) + " dB (" +
    std::to_string(options.Novel.Samples) + " samples per pixel)\n";
  WarnOfNoise(noiseFloor, best, "the best lookup", "--spp");
  return result;
}

Result Run(Options options)
{
  CheckOutputs(options);
  const FieldFile file = OpenField(options.Field);
  RequireDisplay();
  options.Scene.TakeDefaults(nlohmann::json::parse(file.Field.Sampling, nullptr, false));
  const Scene scene = options.Scene.Read();
  ReadToDraw(file);

  FieldRenderer renderer(file.Reader->GetOutputPort(), options.Novel.Size, options.Novel.Size);
  renderer.SetToneMapping(options.Tone.Get());
  const auto cameras = MakeNovelViews(
    file.Field.Box, options.Novel.Views, options.Novel.Seed, options.Scene.HasCornellBox());
  std::vector<Score> scores = MakeScores(file.Field);
  std::vector<double> noiseFloors;
  std::vector<LabelledPicture> sheet;
  for (int view = 0; view < options.Novel.Views; ++view)
  {
    const Truth truth = TraceTruth(options.Scene, scene, cameras[view], options.Novel.Size,
      options.Novel.Samples, options.Novel.Seed + view, options.Tone.Get());
    const auto stencil =
      MakeCubeStencil(file.Field.Box, cameras[view], options.Novel.Size, options.Novel.Size);
    noiseFloors.push_back(ComputeNoiseFloor(truth, stencil));
    SaveView(options, view, "truth", truth.Picture);
    sheet.push_back({ truth.Picture,
      (options.Title.empty() ? "" : options.Title + ", ") + "view " + std::to_string(view) +
        ", truth" });
    for (Score& score : scores)
    {
      const auto picture = renderer.Render(cameras[view], score.Lookup.Lookup);
      vtkNew<vtkCSLFImageQuality> quality;
      quality->SetInputData(0, truth.Picture);
      quality->SetInputData(1, picture);
      quality->SetStencilData(stencil);
      quality->Update();
      ThrowOnError();
      score.PSNR.push_back(quality->GetPSNR());
      score.SSIM.push_back(quality->GetSSIM());
      SaveView(options, view, score.Lookup.Name, picture);
      sheet.push_back(
        { picture, std::string(score.Lookup.Name) + ", " + Format(quality->GetPSNR(), 1) + " dB" });
    }
  }
  for (Score& score : scores)
  {
    score.FrameRate = renderer.MeasureFrameRate(cameras[0], score.Lookup.Lookup);
  }
  if (!options.ContactSheet.empty())
  {
    WritePicture(
      options.ContactSheet, MakeContactSheet(sheet, static_cast<int>(scores.size()) + 1));
  }
  return Report(options, scores, noiseFloors);
}
}

void AddEvaluate(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "evaluate", "Measure novel views of a light field, in every lookup, against path-traced ones");
  command->footer(
    "Cameras stand two cube edges from the centre, with a view angle of 40 degrees; for the "
    "Cornell box within 35 degrees of its opening. PSNR of red, green and blue over black, in "
    "the pixels whose ray meets the cube: the mean of the views' dB, each at most 60. The truth "
    "is the mean of two halves traced with different seeds; its noise floor is the PSNR of one "
    "half against the other plus 6.02 dB, as the mean has a quarter of their difference's "
    "variance. Give the scene, light and material that the field was sampled with.");
  const auto options = std::make_shared<Options>();
  command->add_option("field", options->Field, std::string("the light field: ") + FieldFormats)
    ->required();
  options->Scene.AddTo(*command);
  options->Novel.AddTo(*command);
  options->Tone.AddTo(*command);
  command->add_option("-o,--output", options->OutputFolder, "a folder for the views' pictures");
  command->add_option("--contact-sheet", options->ContactSheet, "a .png of all of them");
  command->add_option("--title", options->Title, "the scene's name on the contact sheet");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
}
