// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf sample: samples a scene as a light field.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Console/cslfParallel.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfGeometryFiles.h"
#include "Files/cslfFileSeries.h"
#include "Files/cslfFileSystem.h"
#include "Options/cslfIntegratorOptions.h"
#include "Pictures/cslfPictures.h"
#include "Pictures/cslfScenePicture.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfCommands.h"
#include "vtkCSLFSceneLook.h"

#ifdef CSLF_HAS_ENCODER
#include "vtkCSLFBakeEstimator.h"
#include "vtkCSLFEncoder.h"
#include "vtkCSLFSeriesWriter.h"
#endif
#include "Options/cslfTableOptions.h"
#include "cslfSeconds.h"
#include "vtkCSLFSampler.h"

#include <vtkCallbackCommand.h>
#include <vtkDataArraySelection.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace cslf::tool
{
namespace
{
/// The size of HEVC's smallest picture.
constexpr int MinimumVideo = 16;

struct Options
{
  SceneOptions Scene;
  IntegratorOptions Integrator{ vtkCSLFPathTracer::RadianceCaching };
  CodingOptions Coding;
  std::string Output;
  std::string Picture;              ///< empty for none
  std::vector<std::string> Implied; ///< outputs that the command line does not name
  bool Overwrite = false;           ///< whether these may be replaced

  /// Whether a file of this name may be replaced.
  bool Replaces(const std::string& name) const
  {
    return this->Overwrite ||
      std::find(this->Implied.begin(), this->Implied.end(), name) == this->Implied.end();
  }

  int Viewpoints = options::Viewpoints.Default;
  int Resolution = options::Resolution.Default;
  double Offset = options::Offset.Default;
  bool SurfaceTexels = options::SurfaceTexels.Default;
  int GeometryTriangles = options::GeometryTriangles.Default;
  std::vector<double> Center;
  std::vector<double> Edges;
  double TimeBudget = 0.0;
  double SuggestForPSNR = 0.0;
  double SuggestForSize = 0.0;
  bool Estimate = false;
  std::map<std::string, bool> Channels; ///< whether to sample each
  std::vector<std::string> Arrays;      ///< that surfaces keep
  std::vector<int> TimeSteps;           ///< the first and the last; all if it is empty
  int TimeStepInterval = 1;
  bool Float = false;
};

/// Words in place of arrays.
constexpr const char* AllArrays = "all";
constexpr const char* RangeFlag = "--time-step-range";
constexpr const char* IntervalFlag = "--time-step-interval";
constexpr const char* NoArrays = "none";

void SetCube(const Options& options, vtkCSLFSampler* sampler)
{
  sampler->SetOffset(options.Offset);
  sampler->SetAutomaticCube(options.Edges.empty());
  if (!options.Edges.empty())
  {
    const std::vector<double>& edges = options.Edges;
    const bool isCube = edges.size() == 1;
    sampler->SetCubeEdges(edges[0], isCube ? edges[0] : edges[1], isCube ? edges[0] : edges[2]);
    sampler->SetCubeCenter(options.Center[0], options.Center[1], options.Center[2]);
  }
}

void CheckCube(const Options& options)
{
  if (options.Edges.size() == 2 || options.Edges.empty() != options.Center.empty())
  {
    throw Failure("Specify a cube by --center and one or three --edges.");
  }
}

void CheckFormat(const Options& options, FieldFormat format)
{
  if (format == FieldFormat::Video && options.Resolution < MinimumVideo)
  {
    throw Failure("Video needs a resolution (-N) of at least 16 texels.");
  }
  if (format != FieldFormat::Video &&
    (options.SuggestForPSNR > 0.0 || options.SuggestForSize > 0.0))
  {
    throw Failure(
      "--suggest-for-novel-psnr and --suggest-for-size need a video as output: .mp4 or .mkv.");
  }
}

void SetUp(const Options& options, vtkCSLFSampler* sampler)
{
  sampler->SetViewpoints(options.Viewpoints);
  sampler->SetResolution(options.Resolution);
  options.Integrator.Apply(sampler);
  for (const auto& [name, isSampled] : options.Channels)
  {
    sampler->GetChannelSelection()->SetArraySetting(name.c_str(), isSampled);
  }
  for (const std::string& name : options.Arrays)
  {
    if (name == AllArrays)
    {
      sampler->GetSurfaceArraySelection()->SetUnknownArraySetting(1);
    }
    else if (name != NoArrays)
    {
      sampler->GetSurfaceArraySelection()->EnableArray(name.c_str());
    }
  }
  sampler->SetColorType(options.Float ? VTK_FLOAT : VTK_UNSIGNED_CHAR);
  sampler->SetSurfaceTexels(options.SurfaceTexels);
  sampler->SetGeometryTriangles(options.GeometryTriangles);
  SetCube(options, sampler);
}

#ifdef CSLF_HAS_ENCODER
vtkSmartPointer<vtkCSLFBakeEstimator> MakeEstimator(
  const Options& options, FieldFormat format, vtkCSLFSampler* sampler)
{
  vtkNew<vtkCSLFEncoder> encoder;
  options.Coding.Apply(encoder);
  if (options.GeometryTriangles > 0)
  {
    encoder->SetInputConnection(1, sampler->GetOutputPort(1));
  }
  auto estimator = vtkSmartPointer<vtkCSLFBakeEstimator>::New();
  estimator->SetSampler(sampler);
  estimator->SetEncoder(encoder);
  estimator->SetFormat(format == FieldFormat::Video ? vtkCSLFBakeEstimator::Video
      : format == FieldFormat::ImageData            ? vtkCSLFBakeEstimator::ImageData
                                                    : vtkCSLFBakeEstimator::ImageFolder);
  return estimator;
}

/// Chooses the number of samples that the time allows, or that of an interrupted run. One process
/// does it for all.
void ChooseSamples(const Options& options, FieldFormat format, vtkCSLFSampler* sampler)
{
  if (options.TimeBudget <= 0.0)
  {
    return;
  }
  const SharedWork shared;
  if (IsFirstRank())
  {
    const auto estimator = MakeEstimator(options, format, sampler);
    const bool isRecalled =
      options.Coding.Restart && estimator->RecallSamples(options.Output.c_str());
    if (!isRecalled && !estimator->ChooseSamples(options.TimeBudget * CountProcesses()))
    {
      throw Failure("The time budget cannot be met.");
    }
  }
  sampler->SetSamples(ShareNumber(sampler->GetUsedSamples()));
}

/// Suggests M and N for the requested quality.
void AddSuggestion(
  const Options& options, vtkCSLFBakeEstimator* estimator, nlohmann::json& json, std::ostream& text)
{
  if (options.SuggestForPSNR <= 0.0 && options.SuggestForSize <= 0.0)
  {
    return;
  }
  const bool isFound = options.SuggestForPSNR > 0.0
    ? estimator->SuggestForPSNR(options.SuggestForPSNR)
    : estimator->SuggestForBytes(options.SuggestForSize);
  if (!isFound)
  {
    throw Failure(options.SuggestForPSNR > 0.0
        ? "No field reaches the PSNR of --suggest-for-novel-psnr."
        : "No field is as small as --suggest-for-size.");
  }
  const int viewpoints = estimator->GetSuggestedViewpoints();
  const int resolution = estimator->GetSuggestedResolution();
  const double psnr = estimator->PredictPSNR(viewpoints, resolution);
  const auto bytes = std::llround(estimator->PredictBytes(viewpoints, resolution));
  json["suggestion"] = { { "views", viewpoints }, { "resolution", resolution }, { "psnr", psnr },
    { "bytes", bytes } };
  text << "suggested: -M " << viewpoints << " -N " << resolution << ", about " << psnr << " dB and "
       << bytes << " bytes\n";
}

/// The cost of the field.
Result Estimate(const Options& options)
{
  CheckCube(options);
  const FieldFormat format =
    options.Output.empty() ? FieldFormat::Video : GetFormat(options.Output);
  CheckFormat(options, format);
  const Scene scene = options.Scene.Read();
  vtkNew<vtkCSLFSampler> sampler;
  options.Scene.Apply(scene, sampler);
  SetUp(options, sampler);
  const auto estimator = MakeEstimator(options, format, sampler);
  ChooseSamples(options, format, sampler);
  if (!estimator->Estimate())
  {
    throw Failure("The cost cannot be estimated.");
  }
  ThrowOnError();
  Result result;
  result.JSON = { { "seconds", estimator->GetSeconds() },
    { "scene_seconds", estimator->GetSceneSeconds() },
    { "cache_seconds", estimator->GetCacheSeconds() },
    { "render_seconds", estimator->GetRenderSeconds() },
    { "coding_seconds", estimator->GetCodingSeconds() },
    { "bytes", std::llround(estimator->GetBytes()) }, { "samples", sampler->GetUsedSamples() },
    { "probe_seconds", estimator->GetSecondsTaken() } };
  std::ostringstream text;
  text << "about " << estimator->GetSeconds() << " s (scene " << estimator->GetSceneSeconds()
       << " s, cache " << estimator->GetCacheSeconds() << " s, rendering "
       << estimator->GetRenderSeconds() << " s, coding " << estimator->GetCodingSeconds()
       << " s) and " << std::llround(estimator->GetBytes()) << " bytes\n";
  AddSuggestion(options, estimator, result.JSON, text);
  result.Text = text.str();
  return result;
}

#else
constexpr const char* NoEstimate =
  "This cslf was built without the video encoder, which --estimate and --time-budget need.";

void ChooseSamples(const Options& options, FieldFormat, vtkCSLFSampler*)
{
  if (options.TimeBudget > 0.0)
  {
    throw Failure(NoEstimate);
  }
}

Result Estimate(const Options&)
{
  throw Failure(NoEstimate);
}
#endif

/// Names the field and the picture after the scene, in the current folder.
void NameOutputs(Options& options)
{
  std::filesystem::path path = ToPath(options.Scene.GetFirst());
  path = path.extension() == FileSeriesExtension ? path.stem() : path;
  const std::string name = ToName(path.stem());
  options.Output = name + ".mp4";
  options.Implied.push_back(options.Output);
  if (options.Picture.empty())
  {
    options.Picture = name + ".png";
    options.Implied.push_back(options.Picture);
  }
}

/// Checks that a picture can be written, and that nothing is replaced that the command line does
/// not name.
void CheckOutputs(const Options& options)
{
  if (!options.Picture.empty())
  {
    RequirePicture(options.Picture);
    options.Scene.RequireOther(options.Picture);
  }
  for (const std::string& name : options.Implied)
  {
    if (!options.Replaces(name))
    {
      RequireReplaceable(name);
    }
  }
}

#ifdef CSLF_HAS_ENCODER
/// Tells which step is next.
void NoteStep(vtkObject* caller, unsigned long, void*, void*)
{
  auto* writer = vtkCSLFSeriesWriter::SafeDownCast(caller);
  PrintNote("step " + std::to_string(writer->GetDoneSteps() + 1) + " of " +
    std::to_string(writer->GetNumberOfSteps()) + ": " + writer->GetStepFileName());
}

/// Writes a field for each time.
Result RunSeries(const Options& options, const std::vector<double>& times)
{
  const auto start = std::chrono::steady_clock::now();
  const FieldOutput output(options.Output, options.Coding);
  CheckFormat(options, output.GetFormat());
  if (output.GetFormat() != FieldFormat::Video || options.TimeBudget > 0.0)
  {
    throw Failure("A scene with several times needs a video as output, .mp4 or .mkv, and no "
                  "--time-budget: or choose one by --time.");
  }
  options.Scene.RequireOther(options.Output);
  if (!options.Picture.empty() && IsFirstRank())
  {
    const Scene scene = options.Scene.ReadAt(times.front());
    WriteScenePicture(options.Picture, options.Scene, scene, options.Replaces(options.Picture));
    PrintNote(options.Picture + " is the first picture");
  }
  vtkNew<vtkCSLFSampler> sampler;
  vtkCSLFSceneLook* look = options.Scene.ApplySeries(times, sampler);
  SetUp(options, sampler);
  vtkNew<vtkCSLFSeriesWriter> writer;
  writer->SetSampler(sampler);
  writer->SetLook(look);
  if (!options.TimeSteps.empty())
  {
    writer->SetTimeStepRange(options.TimeSteps.data());
  }
  writer->SetTimeStepInterval(options.TimeStepInterval);
  vtkNew<vtkCallbackCommand> note;
  note->SetCallback(NoteStep);
  writer->AddObserver(vtkCommand::StartEvent, note);
  output.WriteSeries(sampler->GetOutputPort(0),
    options.GeometryTriangles > 0 ? sampler->GetOutputPort(1) : nullptr, writer);
  ThrowOnError();
  if (!IsFirstRank())
  {
    return {};
  }
  Result result;
  const std::string name = options.Output + FileSeriesExtension;
  const FieldFile file = OpenField(name);
  result.JSON = Summarize(file.Field);
  result.JSON["output"] = name;
  result.JSON["steps"] = ListSteps(file);
  result.JSON["kept_steps"] = writer->GetKeptSteps();
  result.JSON["bytes"] = CountBytes(file);
  result.JSON["seconds"] = SecondsSince(start);
  result.JSON["legend"] = options.Scene.GetLook().GetLegend();
  std::ostringstream text;
  text << DescribeLegend(result.JSON["legend"]);
  if (!options.Picture.empty())
  {
    result.JSON["picture"] = options.Picture;
    text << options.Picture << "\n";
  }
  text << name << ": " << writer->GetNumberOfSteps() << " time steps, ";
  if (writer->GetKeptSteps() > 0)
  {
    text << writer->GetKeptSteps() << " of them from an earlier run, ";
  }
  text << result.JSON["bytes"] << " bytes, " << SecondsSince(start) << " s\n";
  result.Text = text.str();
  return result;
}
#endif

Result Run(const Options& options)
{
  const auto start = std::chrono::steady_clock::now();
  CheckCube(options);
  CheckOutputs(options);
  const std::vector<double> times =
    options.Scene.GetTime() ? std::vector<double>() : options.Scene.FindTimes();
  if (times.size() > 1)
  {
#ifdef CSLF_HAS_ENCODER
    return RunSeries(options, times);
#else
    throw Failure(NoEncoder);
#endif
  }
  if (!options.TimeSteps.empty() || options.TimeStepInterval > 1)
  {
    throw Failure("There are no time steps that " +
      std::string(options.TimeSteps.empty() ? IntervalFlag : RangeFlag) + " could choose.");
  }
  const FieldOutput writer(options.Output, options.Coding);
  CheckFormat(options, writer.GetFormat());
  options.Scene.RequireOther(options.Output);
  if (writer.GetFormat() == FieldFormat::ImageData)
  {
    options.Scene.RequireOther(GetGeometryName(options.Output));
  }
  const Scene scene = options.Scene.Read();
  const std::string legend = DescribeLegend(scene.Legend);
  std::istringstream lines(legend);
  for (std::string line; IsFirstRank() && std::getline(lines, line);)
  {
    PrintNote(line); // who waits can stop if this is not right
  }
  if (!options.Picture.empty() && IsFirstRank())
  {
    WriteScenePicture(options.Picture, options.Scene, scene, options.Replaces(options.Picture));
    PrintNote(options.Picture + " is the first picture");
  }
  vtkNew<vtkCSLFSampler> sampler;
  options.Scene.Apply(scene, sampler);
  SetUp(options, sampler);
  ChooseSamples(options, writer.GetFormat(), sampler);
  vtkAlgorithmOutput* geometry =
    options.GeometryTriangles > 0 ? sampler->GetOutputPort(1) : nullptr;
  const nlohmann::json coding = writer.Write(sampler->GetOutputPort(0), geometry, "Sampling");
  ThrowOnError();

  if (!IsFirstRank())
  {
    return {};
  }
  const FieldFile file = OpenField(options.Output);
  const double seconds = SecondsSince(start);
  Result result;
  result.JSON = Summarize(file.Field);
  result.JSON["cost"] = IntegratorOptions::GetCost(sampler);
  result.JSON["output"] = options.Output;
  result.JSON["bytes"] = CountBytes(options.Output);
  result.JSON["seconds"] = seconds;
  result.JSON.update(coding);
  result.JSON["legend"] = scene.Legend;
  std::ostringstream text;
  text << legend;
  if (!options.Picture.empty())
  {
    result.JSON["picture"] = options.Picture;
    text << options.Picture << "\n";
  }
  text << options.Output << ": " << file.Field.Grid.GetSlices() << " viewpoints, "
       << CountBytes(options.Output) << " bytes" << DescribeCoding(coding) << ", " << seconds
       << " s\n";
  result.Text = text.str();
  return result;
}

/// Adds a flag for each channel that can be sampled besides colour.
void AddChannels(CLI::App& command, Options& options, const std::string& group)
{
  vtkNew<vtkCSLFSampler> sampler;
  vtkDataArraySelection* channels = sampler->GetChannelSelection();
  for (int i = 0; i < channels->GetNumberOfArrays(); ++i)
  {
    const char* name = channels->GetArrayName(i);
    const bool isDefault = channels->GetArraySetting(i) != 0;
    std::string flag = name;
    std::transform(flag.begin(), flag.end(), flag.begin(),
      [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    bool& isSampled = options.Channels.emplace(name, isDefault).first->second;
    command
      .add_flag("--" + flag + ",--no-" + flag + "{false}", isSampled,
        std::string("whether to sample the channel ") + name + (isDefault ? " (default: yes)" : ""))
      ->group(group);
  }
}

void AddField(CLI::App& command, Options& options)
{
  command
    .add_option("-o,--output", options.Output,
      std::string("the light field: ") + FieldFormats +
        " (default: the name of the scene with .mp4, and a picture, .png, in the current folder)")
    ->type_name(FilePlaceholder);
  command
    .add_option("--picture", options.Picture,
      std::string("also write a picture of the scene before the light field is sampled: ") +
        PictureFormats)
    ->type_name(FilePlaceholder);
  command.add_flag("--overwrite", options.Overwrite,
    "replace existing files that have the default names (those that -o and --picture name are "
    "always replaced)");
  command.add_flag("--estimate", options.Estimate,
    "predict the time and file size by a short probe, and write nothing");
  command
    .add_option("--time-budget", options.TimeBudget,
      "take as many samples per texel as fit into this time, instead of --spp: a number of "
      "seconds, or for example 30min or 2h")
    ->check(Positive())
    ->transform(Seconds())
    ->type_name(TimePlaceholder);
  CLI::Option* psnr = command.add_option("--suggest-for-novel-psnr", options.SuggestForPSNR,
    "with --estimate: suggest -M and -N of the smallest video whose novel views reach this PSNR in "
    "dB");
  psnr->check(Positive());
  command
    .add_option("--suggest-for-size", options.SuggestForSize,
      "with --estimate: suggest -M and -N of the best video of at most this size, for example 20MB")
    ->check(Positive())
    ->transform(Bytes())
    ->type_name(SizePlaceholder)
    ->excludes(psnr);
  const std::string field = "Light field";
  AddOption(command, cslf::options::Viewpoints, options.Viewpoints)->group(field);
  AddOption(command, cslf::options::Resolution, options.Resolution)->group(field);
  AddOption(command, cslf::options::Offset, options.Offset)->group(field);
  command
    .add_flag("--surface-texels,--no-surface-texels{false}", options.SurfaceTexels,
      std::string(cslf::options::SurfaceTexels.Help) + " (default: yes)")
    ->group(field);
  AddOption(command, cslf::options::GeometryTriangles, options.GeometryTriangles)->group(field);
  command
    .add_option("--arrays", options.Arrays,
      "arrays of points or cells that the field's surfaces keep besides the one that colours them, "
      "so that they can be coloured by these later; all: all arrays (default: none)")
    ->delimiter(',')
    ->allow_extra_args(false)
    ->type_name("NAME,...")
    ->group(field);
  command
    .add_option("--center", options.Center,
      "centre of the cube, with --edges (default: a cube around the scene)")
    ->expected(3)
    ->check(Finite())
    ->type_name("X Y Z")
    ->group(field);
  command
    .add_option("--edges", options.Edges,
      "edges of the cube, with --center: one length, or three along X, Y, Z")
    ->expected(1, 3)
    ->check(Positive())
    ->type_name("LENGTH")
    ->group(field);
  const std::string time = "Scenes with several times";
  command.get_option(TimeFlag)->group(time)->description(
    "bake one time only: the last one of the scene that is not later (default: all, each in a file "
    "of its own)");
  command
    .add_option(RangeFlag, options.TimeSteps,
      "the first and the last time step to bake, from 0 on (default: all)")
    ->expected(2)
    ->check(Between(0, std::numeric_limits<int>::max()))
    ->excludes(command.get_option(TimeFlag))
    ->type_name("FIRST LAST")
    ->group(time);
  command.add_option(IntervalFlag, options.TimeStepInterval, "bake every so many of these steps")
    ->check(Between(1, std::numeric_limits<int>::max()))
    ->excludes(command.get_option(TimeFlag))
    ->capture_default_str()
    ->group(time);
  AddChannels(command, options, field);
  command.add_flag("--float", options.Float, "store linear float colours instead of sRGB bytes")
    ->group(field);
}
}

void AddSample(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand("sample", "Sample a light field from a scene");
  command->footer(MakeFooter(
    { "cslf sample dragon.ply --quality preview", "cslf sample cornell-box -M 9 -N 128 -o box.mp4",
      "cslf sample wave.vtp.series -o wave.mp4" },
    "A scene that has several times, in a .pvd, .vtp.series, .vtm.series or another file with time "
    "steps, becomes a video for each, wave_0000.mp4 and so on, and their index wave.mp4.series. "
    "They "
    "have one cube and one range of colours. If the run is interrupted, the next one keeps the "
    "finished ones."));
  const auto options = std::make_shared<Options>();
  options->Scene.AddTo(*command);
  AddField(*command, *options);
  options->Integrator.AddTo(*command);
  options->Coding.AddTo(*command);
  AddOption(*command, cslf::options::Certificate, options->Coding.Certificate)->group(VideoGroup);
  command->callback(
    [options, &chosen]
    {
      const bool suggests = options->SuggestForPSNR > 0.0 || options->SuggestForSize > 0.0;
      if (suggests && !options->Estimate)
      {
        throw CLI::RequiredError("--estimate");
      }
      if (options->Estimate && (options->Coding.HasTarget() || options->Coding.HasKeyViews()))
      {
        throw CLI::ValidationError(
          "--estimate", "supports only a given --crf and all viewpoints, no targets or key views");
      }
      if (options->Output.empty() && !options->Estimate)
      {
        NameOutputs(*options);
        options->Coding.Overwrite = options->Replaces(options->Output);
      }
      SetShared(!options->Estimate && IsVideo(options->Output));
      chosen = [options] { return options->Estimate ? Estimate(*options) : Run(*options); };
    });
}
}
