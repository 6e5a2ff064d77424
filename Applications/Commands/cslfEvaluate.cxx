// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf evaluate: compares novel views of a light field with path-traced ones.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfTable.h"
#include "Fields/cslfFieldFiles.h"
#include "Measurements/cslfNovelViews.h"
#include "Measurements/cslfStatistics.h"
#include "Options/cslfCameraOptions.h"
#include "Pictures/cslfCameraPath.h"
#include "Pictures/cslfContactSheet.h"
#include "Pictures/cslfPictures.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfCommands.h"

#include "vtkCSLFImageQuality.h"

#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

namespace cslf::tool
{
namespace
{
struct Options
{
  FieldInput Field;
  SceneOptions Scene;
  std::string OutputFolder;
  std::string ContactSheet;
  std::string Title;
  int PixelSamples = options::PixelSamples.Default;
  std::vector<std::string> Lookups; ///< if empty, all of the field
  NovelViewOptions Novel;
  CameraPathOptions Path;
  ToneOptions Tone;
};

/// A lookup's figures, one for each view. Along a path also one for each step to the next view.
struct Score
{
  LookupName Lookup;
  std::vector<double> PSNR;
  std::vector<double> SSIM;
  std::vector<double> ChangePSNR;
  double FrameRate = 0.0;
  vtkSmartPointer<vtkImageData> Picture; ///< of the last view
};

/// The results.
struct Findings
{
  std::vector<Score> Scores;
  std::vector<double> NoiseFloors; ///< one for each view
  std::vector<LabelledPicture> Sheet;
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
    RequirePicture(options.ContactSheet);
    options.Scene.RequireOther(options.ContactSheet);
  }
}

/// One score for each lookup. Throws a Failure if the field lacks what it needs.
std::vector<Score> MakeScores(const Options& options, const FieldFile& file)
{
  std::vector<Score> scores;
  for (const LookupName& lookup : ChooseLookups(options.Lookups, file))
  {
    scores.emplace_back();
    scores.back().Lookup = lookup;
  }
  return scores;
}

std::vector<vtkSmartPointer<vtkCamera>> MakeCameras(const Options& options, const Cube& cube)
{
  return options.Path.IsEmpty()
    ? MakeNovelViews(cube, options.Novel.Views, options.Novel.Seed, options.Scene.HasCornellBox())
    : options.Path.MakeCameras(CameraOptions().MakeCamera(cube, MeasuringDistance));
}

/// The number of a view, with leading zeros if there are many.
std::string ToNumber(std::size_t view, std::size_t views)
{
  const std::string number = std::to_string(view);
  return std::string(std::to_string(views - 1).size() - number.size(), '0') + number;
}

void SaveView(
  const Options& options, const std::string& number, const std::string& name, vtkImageData* picture)
{
  if (!options.OutputFolder.empty())
  {
    WritePicture(options.OutputFolder + "/view-" + number + "-" + name + ".png", picture);
  }
}

/// Draws one view in every lookup and compares it with the reference. `previous` is the reference
/// of the view before, or null.
void MeasureView(const Options& options, const NovelView& view, vtkImageData* previous,
  const std::string& number, FieldRenderer& renderer, Findings& findings)
{
  SaveView(options, number, "truth", view.Picture);
  const std::string title = options.Title.empty() ? "" : options.Title + ", ";
  findings.Sheet.push_back({ view.Picture, title + "view " + number + ", reference" });
  for (Score& score : findings.Scores)
  {
    const auto picture = renderer.Render(view.Camera, score.Lookup.Lookup);
    vtkNew<vtkCSLFImageQuality> quality;
    quality->SetInputData(0, view.Picture);
    quality->SetInputData(1, picture);
    quality->SetStencilData(view.Stencil);
    quality->SetMaximumPSNR(100.0);
    quality->Update();
    ThrowOnError();
    const double psnr = SubtractNoise(quality->GetPSNR(), view.NoiseFloor);
    score.PSNR.push_back(psnr);
    score.SSIM.push_back(quality->GetSSIM());
    if (previous)
    {
      score.ChangePSNR.push_back(
        ComputeChangePSNR(previous, score.Picture, view.Picture, picture, view.Stencil));
    }
    score.Picture = picture;
    SaveView(options, number, score.Lookup.Name, picture);
    findings.Sheet.push_back(
      { picture, std::string(score.Lookup.Name) + ", " + Format(psnr, 1) + " dB" });
  }
}

/// One row for each view or, for views of a path, rows that make the sheet about square.
int CountColumns(const Options& options, const Findings& findings)
{
  const std::size_t pictures = findings.Scores.size() + 1;
  const std::size_t views = findings.Sheet.size() / pictures;
  const double side = std::sqrt(static_cast<double>(findings.Sheet.size()));
  const auto across = static_cast<std::size_t>(std::lround(side / static_cast<double>(pictures)));
  return static_cast<int>(
    pictures * (options.Path.IsEmpty() ? 1 : std::clamp<std::size_t>(across, 1, views)));
}

/// The index of the lowest value.
std::size_t FindLowest(const std::vector<double>& values)
{
  return std::min_element(values.begin(), values.end()) - values.begin();
}

nlohmann::json ToJSON(const Score& score)
{
  nlohmann::json json = { { "psnr", Mean(score.PSNR) }, { "lowest_psnr", Minimum(score.PSNR) },
    { "psnr_of_views", score.PSNR }, { "ssim", Mean(score.SSIM) },
    { "frames_per_second", score.FrameRate } };
  if (!score.ChangePSNR.empty())
  {
    json["median_psnr"] = Median(score.PSNR);
    json["median_change_psnr"] = Median(score.ChangePSNR);
    json["lowest_change_psnr"] = Minimum(score.ChangePSNR);
    json["change_psnr_of_steps"] = score.ChangePSNR;
  }
  return json;
}

std::string MakeTable(const std::vector<Score>& scores)
{
  const bool isPath = !scores.front().ChangePSNR.empty();
  Table table;
  std::vector<std::string> head = { "lookup", "PSNR (dB)", "lowest", "SSIM", "frames/s" };
  if (isPath)
  {
    head.insert(head.end(),
      { "median (dB)", "lowest, of view", "below it (dB)", "changes: median (dB)",
        "lowest, to view", "below it (dB)" });
  }
  table.AddRow(head);
  for (const Score& score : scores)
  {
    std::vector<std::string> row = { score.Lookup.Name, Format(Mean(score.PSNR), 2),
      Format(Minimum(score.PSNR), 2), Format(Mean(score.SSIM), 4), Format(score.FrameRate, 1) };
    if (isPath)
    {
      row.insert(row.end(),
        { Format(Median(score.PSNR), 2), std::to_string(FindLowest(score.PSNR)),
          Format(Median(score.PSNR) - Minimum(score.PSNR), 2), Format(Median(score.ChangePSNR), 2),
          std::to_string(FindLowest(score.ChangePSNR) + 1),
          Format(Median(score.ChangePSNR) - Minimum(score.ChangePSNR), 2) });
    }
    table.AddRow(row);
  }
  return table.ToText();
}

/// The PSNR of each view of a path, and of the change that leads to it.
std::string MakePathTable(const std::vector<Score>& scores)
{
  Table table;
  std::vector<std::string> head = { "view" };
  for (const Score& score : scores)
  {
    head.insert(head.end(), { std::string(score.Lookup.Name) + " (dB)", "change" });
  }
  table.AddRow(head);
  for (std::size_t view = 0; view < scores.front().PSNR.size(); ++view)
  {
    std::vector<std::string> row = { std::to_string(view) };
    for (const Score& score : scores)
    {
      row.push_back(Format(score.PSNR[view], 2));
      row.push_back(view > 0 ? Format(score.ChangePSNR[view - 1], 2) : "");
    }
    table.AddRow(row);
  }
  return table.ToText();
}

Result Report(const Options& options, const Findings& findings)
{
  const double noiseFloor = Mean(findings.NoiseFloors);
  Result result;
  result.JSON = { { "field", options.Field.FileName },
    { "bytes", CountBytes(options.Field.FileName) }, { "views", findings.NoiseFloors.size() },
    { "size", options.Novel.Size }, { "spp", options.Novel.Samples },
    { "seed", options.Novel.Seed }, { "noise_floor", noiseFloor },
    { "pixel_samples", options.PixelSamples } };
  if (!options.Path.IsEmpty())
  {
    result.JSON["path"] = options.Path.GetPath();
  }
  double best = 0.0;
  for (const Score& score : findings.Scores)
  {
    result.JSON["lookups"][score.Lookup.Name] = ToJSON(score);
    best = std::max(best, Mean(score.PSNR));
  }
  const std::string size = std::to_string(options.Novel.Size);
  result.Text = options.Field.FileName + ": " + std::to_string(CountBytes(options.Field.FileName)) +
    " bytes, " + std::to_string(findings.NoiseFloors.size()) + " views of " + size + " x " + size +
    "\n" + (options.Path.IsEmpty() ? "" : MakePathTable(findings.Scores)) +
    MakeTable(findings.Scores) + "noise floor of the reference: " + Format(noiseFloor, 2) +
    " dB (" + std::to_string(options.Novel.Samples) + " samples per pixel)\n";
  WarnOfRemovedNoise(noiseFloor, best, "the best lookup", "--spp");
  return result;
}

Result Run(Options options)
{
  CheckOutputs(options);
  const FieldFile file = OpenField(options.Field);
  RequireDisplay();
  Findings findings;
  findings.Scores = MakeScores(options, file);
  const auto cameras = MakeCameras(options, file.Field.Box);
  options.Scene.TakeDefaults(nlohmann::json::parse(file.Field.Sampling, nullptr, false));
  const Scene scene = options.Scene.Read();
  ReadToDraw(file);

  const int size = options.Novel.Size;
  FieldRenderer renderer(file, size, size);
  renderer.SetToneMapping(options.Tone.Get());
  renderer.SetPixelSamples(options.PixelSamples);
  TruthTracer tracer(options.Scene, scene, options.Novel.TruthFolder);
  vtkSmartPointer<vtkImageData> previous;
  for (std::size_t number = 0; number < cameras.size(); ++number)
  {
    const auto& camera = cameras[number];
    const Truth truth = tracer.Trace(camera, size, options.Novel.Samples,
      options.Novel.Seed + static_cast<int>(number), options.Tone.Get());
    NovelView view{ camera, truth.Picture, MakeCubeStencil(file.Field.Box, camera, size, size) };
    view.NoiseFloor = ComputeNoiseFloor(truth, view.Stencil);
    findings.NoiseFloors.push_back(view.NoiseFloor);
    MeasureView(options, view, options.Path.IsEmpty() ? nullptr : previous.Get(),
      ToNumber(number, cameras.size()), renderer, findings);
    previous = view.Picture;
  }
  for (Score& score : findings.Scores)
  {
    score.FrameRate = renderer.MeasureFrameRate(cameras[0], score.Lookup.Lookup);
  }
  if (!options.ContactSheet.empty())
  {
    WritePicture(
      options.ContactSheet, MakeContactSheet(findings.Sheet, CountColumns(options, findings)));
  }
  return Report(options, findings);
}
}

void AddEvaluate(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "evaluate", "Measure novel views of a light field with every lookup against path-traced views");
  command->footer(MakeFooter(
    { "cslf evaluate box.mp4 cornell-box --views 3 --contact-sheet sheet.png" },
    "Cameras are two cube edges from the centre, with a view angle of 40 degrees, and for the "
    "Cornell box within 35 degrees of its opening. PSNR is measured for red, green and blue over "
    "black, in the pixels whose ray meets the cube, and averaged over the views in dB, each at "
    "most 60. The reference is the mean of two halves traced with different seeds. Its noise floor "
    "is the PSNR of one half against the other plus 6.02 dB, because the mean has a quarter of the "
    "variance of their difference. This noise is subtracted from the squared errors, so it does "
    "not lower the PSNR; it does lower SSIM and the figures of changes. Specify the scene, light "
    "and material that the field was "
    "sampled with. With --path, the views are those along a camera path that begins two edges in "
    "front of the cube. Each view then has its own row, and the changes from view to view are "
    "measured as well: their PSNR is that of the difference between the errors of a view and of "
    "the previous one, which distinguishes flicker from constant errors."));
  const auto options = std::make_shared<Options>();
  options->Field.AddTo(*command);
  options->Scene.AddTo(*command);
  options->Novel.AddTo(*command);
  options->Path.AddTo(*command);
  command->get_option("--path")->excludes("--views");
  options->Tone.AddTo(*command);
  AddLookups(*command, options->Lookups);
  AddPixelSamples(*command, options->PixelSamples);
  command->add_option("-o,--output", options->OutputFolder, "folder for the pictures of the views")
    ->type_name(FolderPlaceholder);
  command
    ->add_option(
      "--contact-sheet", options->ContactSheet, "a file with all pictures: .png, .jpg or .webp")
    ->type_name(FilePlaceholder);
  command->add_option("--title", options->Title, "name of the scene on the contact sheet")
    ->type_name("TEXT");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
