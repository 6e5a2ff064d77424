// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf-lab render: the speed, memory and quality of each lookup.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Console/cslfTable.h"
#include "Measurements/cslfStatistics.h"
#include "Options/cslfCameraOptions.h"
#include "Pictures/cslfCameraPath.h"
#include "Pictures/cslfPictures.h"
#include "Pipeline/cslfTriangleList.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfChart.h"
#include "cslfCube.h"
#include "cslfLab.h"
#include "cslfSeconds.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>

namespace cslf::tool
{
namespace
{
struct Options : BenchmarkOptions
{
  std::string Mesh;
  std::vector<std::string> Lookups; ///< if empty, all of the field
  int Frames = 72;
  double Rate = 30.0; ///< wanted while the view moves
};

/// Draws a mesh with VTK, to compare its speed with a light field.
class MeshRenderer
{
public:
  /// The triangles of a scene's file, with VTK's defaults: a headlight, and colours if the file has
  /// any. Throws a Failure.
  MeshRenderer(const std::string& fileName, int width, int height)
    : Window(width, height)
  {
    Scene scene;
    scene.Parts.push_back(ReadScenePart(fileName));
    vtkNew<vtkAppendPolyData> append;
    scene.ForEachPolyData([&](vtkPolyData* polyData) { append->AddInputData(polyData); });
    append->Update();
    ThrowOnError();
    this->Mesh = Triangulate(append->GetOutput());
    if (this->GetNumberOfTriangles() == 0)
    {
      throw Failure(fileName + " has no triangles.");
    }
    this->Mapper->SetInputData(this->Mesh);
    this->Actor->SetMapper(this->Mapper);
    this->Window.AddActor(this->Actor);
  }

  /// Draws the view and returns the seconds that it took. Throws a Failure.
  double Draw(vtkCamera* camera) { return this->Window.Draw(camera); }

  vtkIdType GetNumberOfTriangles() const { return this->Mesh->GetNumberOfPolys(); }

  /// The cube of a light field of the mesh.
  Cube GetCube() const
  {
    double bounds[6];
    this->Mesh->GetBounds(bounds);
    return Cube::FromBounds(bounds, options::Offset.Default);
  }

private:
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  OffscreenWindow Window;
};

/// The results of one lookup.
struct Score
{
  LookupName Lookup;
  double FirstSeconds = 0.0; ///< from opening the file to a first picture
  double LoadSeconds = 0.0;  ///< to the complete picture, if nothing is shown before
  std::int64_t TextureBytes = 0;
  std::vector<double> StreamingSeconds; ///< of each frame, the first time along the path
  std::vector<double> Seconds;          ///< of each frame, when everything is loaded
  std::vector<double> StillSeconds;     ///< likewise, of the first picture of a still view
  std::vector<double> RefinedSeconds;   ///< likewise, with all rays of a still view
  std::vector<double> MovingSeconds;    ///< likewise, with as many rays as the time allows
  std::vector<double> MeshSeconds;      ///< of the mesh's frames, drawn alternately with these
  ViewQuality Quality;                  ///< of still views
  ViewQuality MovingQuality;            ///< with as many rays as the time allows
};

/// All results.
struct Findings
{
  std::string Device;
  std::string Path;
  vtkIdType Triangles = 0; ///< of the mesh; 0 without one
  double NoiseFloor = 0.0;
  std::vector<Score> Scores;
};

double FrameRate(const std::vector<double>& seconds)
{
  return 1.0 / Median(seconds);
}

std::vector<vtkSmartPointer<vtkCamera>> MakePath(const Options& options, const Cube& cube)
{
  const vtkSmartPointer<vtkCamera> start = CameraOptions().MakeCamera(cube, MeasuringDistance);
  return options.Scene.HasCornellBox() ? MakeSwing(start, options.Frames)
                                       : MakeOrbit(start, options.Frames);
}

/// Draws the field along the path with one ray per pixel: while its viewpoints are loaded, and when
/// everything is loaded; then once more as still views. The mesh, if there is one, is drawn after
/// each frame of the second run, so that other load on the machine slows both.
void MeasureFrames(const Options& options, const Cube& cube, FieldRenderer& renderer,
  MeshRenderer* mesh, Score& score)
{
  const auto cameras = MakePath(options, cube);
  const auto meshCameras = mesh ? MakePath(options, mesh->GetCube()) : cameras;
  const int lookup = score.Lookup.Lookup;
  const int stillSamples = renderer.GetPixelSamples();
  renderer.SetPixelSamples(1);
  renderer.SetStreaming(true);
  for (const auto& camera : cameras)
  {
    score.StreamingSeconds.push_back(renderer.Draw(camera, lookup));
  }
  // Initialisation in the first drawing does not count as a frame.
  renderer.SetStreaming(false);
  for (const auto& camera : cameras)
  {
    renderer.Draw(camera, lookup);
  }
  if (mesh)
  {
    mesh->Draw(meshCameras.front());
  }
  for (std::size_t frame = 0; frame < cameras.size(); ++frame)
  {
    score.Seconds.push_back(renderer.Draw(cameras[frame], lookup));
    if (mesh)
    {
      score.MeshSeconds.push_back(mesh->Draw(meshCameras[frame]));
    }
  }
  renderer.SetPixelSamples(stillSamples);
  for (const bool isFirst : { true, false })
  {
    renderer.SetStreaming(isFirst);
    for (const auto& camera : cameras)
    {
      (isFirst ? score.StillSeconds : score.RefinedSeconds)
        .push_back(renderer.Draw(camera, lookup));
    }
  }
}

/// Draws the path and then the views at the frame rate of moving views.
void MeasureMoving(const Options& options, const Cube& cube, const std::vector<NovelView>& views,
  FieldRenderer& renderer, Score& score)
{
  const int lookup = score.Lookup.Lookup;
  renderer.SetDesiredUpdateRate(options.Rate);
  for (const auto& camera : MakePath(options, cube))
  {
    score.MovingSeconds.push_back(renderer.Draw(camera, lookup));
  }
  score.MovingQuality = MeasureViews(renderer, lookup, views);
}

/// A separate renderer for a lookup, with only what it needs in graphics memory, and the file
/// opened again. `seconds` is the time for this and the first picture.
std::unique_ptr<FieldRenderer> Open(
  const Options& options, int lookup, bool isStreaming, FieldFile& file, double& seconds)
{
  const auto start = std::chrono::steady_clock::now();
  file = OpenField(options.Field);
  ReadToDraw(file);
  auto renderer = std::make_unique<FieldRenderer>(file, options.Novel.Size, options.Novel.Size);
  renderer->SetStreaming(isStreaming);
  const int stillSamples = renderer->GetPixelSamples();
  renderer->SetPixelSamples(1);
  renderer->Draw(CameraOptions().MakeCamera(file.Field.Box, MeasuringDistance), lookup);
  seconds = SecondsSince(start);
  renderer->SetPixelSamples(stillSamples);
  return renderer;
}

Findings Measure(
  const Options& options, const FieldFile& file, MeshRenderer* mesh, const BenchmarkViews& views)
{
  Findings findings;
  findings.Path = options.Scene.HasCornellBox() ? SwingName : OrbitName;
  findings.Triangles = mesh ? mesh->GetNumberOfTriangles() : 0;
  findings.NoiseFloor = views.NoiseFloor;
  for (const LookupName& lookup : ChooseLookups(options.Lookups, file))
  {
    Score score;
    score.Lookup = lookup;
    FieldFile opened;
    Open(options, lookup.Lookup, true, opened, score.FirstSeconds);
    const auto renderer = Open(options, lookup.Lookup, false, opened, score.LoadSeconds);
    MeasureFrames(options, file.Field.Box, *renderer, mesh, score);
    score.Quality = MeasureViews(*renderer, lookup.Lookup, views.Views);
    MeasureMoving(options, file.Field.Box, views.Views, *renderer, score);
    score.TextureBytes = renderer->GetTextureBytes();
    findings.Device = renderer->GetDeviceName();
    findings.Scores.push_back(score);
  }
  return findings;
}

nlohmann::json ToJSON(const Options& options, const FieldFile& file, const Findings& findings)
{
  nlohmann::json json = { { "field", options.Field }, { "bytes", CountBytes(options.Field) },
    { "viewpoints", file.Field.Grid.GetViewpoints() },
    { "resolution", file.Field.Grid.GetResolution() }, { "size", options.Novel.Size },
    { "path", findings.Path }, { "frames", options.Frames }, { "update_rate", options.Rate },
    { "device", findings.Device } };
  if (findings.Triangles > 0)
  {
    json["mesh"] = { { "file", options.Mesh }, { "triangles", findings.Triangles } };
  }
  for (const Score& score : findings.Scores)
  {
    nlohmann::json& lookup = json["lookups"][score.Lookup.Name];
    lookup = { { "frames_per_second", FrameRate(score.Seconds) },
      { "still_frames_per_second", FrameRate(score.StillSeconds) },
      { "refined_frames_per_second", FrameRate(score.RefinedSeconds) },
      { "moving_frames_per_second", FrameRate(score.MovingSeconds) },
      { "streaming_frames_per_second", FrameRate(score.StreamingSeconds) },
      { "frame_seconds", score.Seconds }, { "still_frame_seconds", score.StillSeconds },
      { "refined_frame_seconds", score.RefinedSeconds },
      { "moving_frame_seconds", score.MovingSeconds },
      { "streaming_frame_seconds", score.StreamingSeconds },
      { "first_picture_seconds", score.FirstSeconds }, { "load_seconds", score.LoadSeconds },
      { "texture_bytes", score.TextureBytes } };
    if (findings.Triangles > 0)
    {
      lookup["mesh_frames_per_second"] = FrameRate(score.MeshSeconds);
      lookup["mesh_ratio"] = FrameRate(score.Seconds) / FrameRate(score.MeshSeconds);
    }
    if (!options.Scene.IsEmpty())
    {
      lookup["psnr"] = Mean(score.Quality.PSNR);
      lookup["lowest_psnr"] = Minimum(score.Quality.PSNR);
      lookup["ssim"] = Mean(score.Quality.SSIM);
      lookup["moving_psnr"] = Mean(score.MovingQuality.PSNR);
    }
  }
  if (!options.Scene.IsEmpty())
  {
    json["views"] = options.DescribeViews(findings.NoiseFloor);
  }
  return json;
}

std::string MakeTable(const Options& options, const Findings& findings)
{
  Table table;
  std::vector<std::string> head = { "lookup", "frames/s", "still, frames/s", "refined, frames/s",
    "moving, frames/s", "streaming, frames/s", "first (s)", "load (s)", "textures (bytes)" };
  if (findings.Triangles > 0)
  {
    head.insert(head.end(), { "mesh, frames/s", "ratio" });
  }
  if (!options.Scene.IsEmpty())
  {
    head.insert(head.end(), { "PSNR (dB)", "lowest", "SSIM", "moving, PSNR" });
  }
  table.AddRow(head);
  for (const Score& score : findings.Scores)
  {
    const double rate = FrameRate(score.Seconds);
    std::vector<std::string> row = { score.Lookup.Name, Format(rate, 1),
      Format(FrameRate(score.StillSeconds), 1), Format(FrameRate(score.RefinedSeconds), 1),
      Format(FrameRate(score.MovingSeconds), 1), Format(FrameRate(score.StreamingSeconds), 1),
      Format(score.FirstSeconds, 2), Format(score.LoadSeconds, 2),
      std::to_string(score.TextureBytes) };
    if (findings.Triangles > 0)
    {
      const double meshRate = FrameRate(score.MeshSeconds);
      row.insert(row.end(), { Format(meshRate, 1), Format(rate / meshRate, 2) });
    }
    if (!options.Scene.IsEmpty())
    {
      row.insert(row.end(),
        { Format(Mean(score.Quality.PSNR), 2), Format(Minimum(score.Quality.PSNR), 2),
          Format(Mean(score.Quality.SSIM), 4), Format(Mean(score.MovingQuality.PSNR), 2) });
    }
    table.AddRow(row);
  }
  return table.ToMarkdown();
}

/// The table and, below it, the setup of its figures.
std::string MakeText(const Options& options, const FieldFile& file, const Findings& findings)
{
  const std::string size = std::to_string(options.Novel.Size);
  std::string text = MakeTable(options, findings) + "\n" + options.Field +
    ", M = " + std::to_string(file.Field.Grid.GetViewpoints()) +
    ", N = " + std::to_string(file.Field.Grid.GetResolution()) + ": medians of " +
    std::to_string(options.Frames) + " frames of " + size + " x " + size + " along the " +
    findings.Path + ", drawn with " + findings.Device +
    ". One ray per pixel; still: as a still view; moving: with an adaptive number of rays for " +
    Format(options.Rate, 1) + " frames per second. PSNR is that of still views.\n";
  if (findings.Triangles > 0)
  {
    text += "\nThe mesh has " + std::to_string(findings.Triangles) + " triangles.\n";
  }
  if (!options.Scene.IsEmpty())
  {
    text += BenchmarkOptions::DescribeNoise(findings.NoiseFloor);
  }
  return text;
}

/// The milliseconds of all frames, one curve.
ChartCurve MakeCurve(const std::string& name, const std::vector<double>& seconds)
{
  ChartCurve curve;
  curve.Name = name;
  for (std::size_t frame = 0; frame < seconds.size(); ++frame)
  {
    curve.X.push_back(static_cast<double>(frame));
    curve.Y.push_back(1000.0 * seconds[frame]);
  }
  return curve;
}

void WriteCharts(const Options& options, const Findings& findings)
{
  Chart times{ "Along the " + findings.Path, "frame", "drawing time (ms)", ChartScale::Linear, {} };
  Chart qualities{ "Novel views", "frames per second", "PSNR (dB)", ChartScale::Linear, {} };
  for (const Score& score : findings.Scores)
  {
    times.Curves.push_back(MakeCurve(score.Lookup.Name, score.Seconds));
    if (!options.Scene.IsEmpty())
    {
      qualities.Curves.push_back(
        { score.Lookup.Name, { FrameRate(score.StillSeconds), FrameRate(score.MovingSeconds) },
          { Mean(score.Quality.PSNR), Mean(score.MovingQuality.PSNR) } });
    }
  }
  if (findings.Triangles > 0)
  {
    const Score& last = findings.Scores.back();
    times.Curves.push_back(
      MakeCurve(std::string("mesh, drawn with ") + last.Lookup.Name, last.MeshSeconds));
  }
  WriteChart(options.Folder + "/frames.png", times);
  if (!options.Scene.IsEmpty())
  {
    WriteChart(options.Folder + "/views.png", qualities);
  }
}

Result Run(Options options)
{
  RequireDisplay();
  const FieldFile file = OpenField(FieldInput{ options.Field });
  std::unique_ptr<MeshRenderer> mesh;
  if (!options.Mesh.empty())
  {
    mesh = std::make_unique<MeshRenderer>(options.Mesh, options.Novel.Size, options.Novel.Size);
  }
  const BenchmarkViews views = options.Begin(file.Field);
  const Findings findings = Measure(options, file, mesh.get(), views);
  WriteCharts(options, findings);
  Result result;
  result.JSON = ToJSON(options, file, findings);
  result.Text = MakeText(options, file, findings);
  if (!views.Views.empty())
  {
    double best = 0.0;
    for (const Score& score : findings.Scores)
    {
      best = std::max(best, Mean(score.Quality.PSNR));
    }
    WarnOfRemovedNoise(findings.NoiseFloor, best, "the best lookup", "--spp");
  }
  options.Write(result, "render");
  return result;
}
}

void AddBenchmarkRender(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "render", "Measure frame rate, memory and quality of every lookup along an orbit");
  command->footer(MakeFooter({ "cslf-lab render box.mp4 cornell-box -o bench" },
    "Writes render.md, render.json and plots into the folder. The camera moves once around the "
    "cube at a distance of two cube edges from the centre, or, if the scene is the Cornell box, "
    "back and forth within 35 degrees of its opening. Frame rates are those of the median frame, "
    "including the time until it is finished. The field is drawn along the path several times: "
    "while viewpoints are loaded (streaming); until all are loaded, which is not counted; with one "
    "ray per pixel (frames/s), as in the previous runs; as a still view, with more rays per pixel "
    "(still); and with as many rays as --update-rate allows (moving). First is the time from "
    "opening the file to the first picture, from the coarsest viewpoints. Loading is the time to "
    "the complete picture without any intermediate picture. With the scene, PSNR and SSIM of novel "
    "views are measured as in cslf evaluate. With --mesh, VTK draws that mesh alternately with "
    "each frame, on the same path around its own cube; the ratio is the field's frame rate divided "
    "by that of the mesh."));
  const auto options = std::make_shared<Options>();
  options->AddTo(*command);
  command->add_option("--frames", options->Frames, "number of pictures along the orbit")
    ->check(Between(1, 1000000))
    ->capture_default_str();
  AddLookups(*command, options->Lookups);
  command
    ->add_option("--update-rate", options->Rate, "frames per second requested while the view moves")
    ->check(Between(1.5, 1000.0))
    ->capture_default_str();
  command->add_option("--mesh", options->Mesh, "a mesh to compare with: a scene file")
    ->type_name(FilePlaceholder);
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
