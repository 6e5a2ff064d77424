// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf render: novel views of a light field, single or along a camera path.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Console/cslfTable.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfOutputFiles.h"
#include "Measurements/cslfStatistics.h"
#include "Options/cslfCameraOptions.h"
#include "Pictures/cslfCameraPath.h"
#include "Pictures/cslfFieldColors.h"
#include "Pictures/cslfFrameFiles.h"
#include "Pictures/cslfPictures.h"
#include "cslfCommands.h"

#include "vtkCSLFMapper.h"

#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
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
  std::string Output;
  std::string Lookup;
  FieldColorOptions Colors;
  ToneOptions Tone;
  int PixelSamples = options::PixelSamples.Default;
  CameraOptions Camera;
  CameraPathOptions Path;
  double FrameRate = 25.0;
};

/// The colours of scalars with a lookup of that name. Throws a Failure.
FieldColors ChooseColors(const Options& options, const FieldFile& file, const std::string& lookup)
{
  if (options.Colors.IsEmpty())
  {
    return {};
  }
  const FieldColors colors(options.Colors, file);
  if (FindLookup(lookup) != vtkCSLFMapper::GEOMETRY)
  {
    throw Failure("Scalars are shown by the lookup geometry, not by " + lookup + ".");
  }
  return colors;
}

std::unique_ptr<FieldRenderer> MakeRenderer(
  const Options& options, const FieldFile& file, const FieldColors& colors)
{
  ReadToDraw(file);
  auto renderer =
    std::make_unique<FieldRenderer>(file, options.Camera.GetWidth(), options.Camera.GetHeight());
  renderer->SetBackground(options.Camera.GetBackground().data());
  renderer->SetToneMapping(options.Tone.Get());
  renderer->SetPixelSamples(options.PixelSamples);
  renderer->SetColors(colors);
  if (options.Colors.HasBar)
  {
    renderer->AddScalarBar(colors.GetTitle());
  }
  return renderer;
}

Result RunView(const Options& options)
{
  if (!IsPictureName(options.Output))
  {
    throw Failure(std::string("A picture is written as ") + PictureFormats +
      ", and several pictures along a --path to " + FrameFormats + ".");
  }
  RequirePicture(options.Output);
  const FieldFile file = OpenField(options.Field);
  const std::string lookup = ChooseLookup(options.Lookup, file);
  const vtkSmartPointer<vtkCamera> camera = options.Camera.MakeCamera(file.Field.Box);
  const FieldColors colors = ChooseColors(options, file, lookup);
  RequireDisplay();
  const auto renderer = MakeRenderer(options, file, colors);
  WritePicture(options.Output, renderer->Render(camera, FindLookup(lookup)));
  Result result;
  result.Text = options.Output + "\n";
  result.JSON = { { "output", options.Output }, { "lookup", lookup } };
  return result;
}

Result RunPath(const Options& options)
{
  const FieldFile file = OpenField(options.Field);
  const std::string name = ChooseLookup(options.Lookup, file);
  const auto cameras = options.Path.MakeCameras(options.Camera.MakeCamera(file.Field.Box));
  const FieldColors colors = ChooseColors(options, file, name);
  RequireDisplay();
  const auto writer = MakeFrameWriter(
    options.Output, options.Camera.GetWidth(), options.Camera.GetHeight(), options.FrameRate);
  const auto renderer = MakeRenderer(options, file, colors);
  const int lookup = FindLookup(name);
  // The first picture uploads the field to graphics memory, so its time does not count as a frame.
  renderer->Draw(cameras.front(), lookup);
  vtkNew<vtkAlgorithm> drawing;
  const ProgressBar bar(drawing, "Drawing");
  std::vector<double> seconds;
  for (const auto& camera : cameras)
  {
    seconds.push_back(renderer->Draw(camera, lookup));
    writer->Add(renderer->Grab(), 1);
    drawing->UpdateProgress(
      static_cast<double>(seconds.size()) / static_cast<double>(cameras.size()));
  }
  writer->Finish();
  Result result;
  result.Text = options.Output + ": " + std::to_string(cameras.size()) + " frames, " +
    Format(1000.0 * Median(seconds), 2) + " ms drawing time per picture (median)\n";
  result.JSON = { { "output", options.Output }, { "lookup", name }, { "frames", cameras.size() },
    { "path", options.Path.GetPath() }, { "device", renderer->GetDeviceName() },
    { "median_frame_seconds", Median(seconds) }, { "frame_seconds", seconds } };
  return result;
}

Result Run(const Options& options)
{
  RequireOther(options.Field.FileName, options.Output);
  return options.Path.IsEmpty() ? RunView(options) : RunPath(options);
}
}

void AddRender(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand(
    "render", "Draw a novel view of a light field, or the views along a camera path");
  command->footer(MakeFooter({ "cslf render box.mp4 -o view.png --position 0.6 0.3 4.4",
    "cslf render box.mp4 --path swing --frames 100 -o swing.mp4",
    "cslf render flow.mp4 -o x.png --color-map viridis --range 0 5 --scalar-bar",
    "cslf render wave.mp4.series -o x.png --time 0.5" }));
  const auto options = std::make_shared<Options>();
  options->Field.AddTo(*command);
  command
    ->add_option("-o,--output", options->Output,
      std::string("the output: ") + PictureFormats + "; with --path " + FrameFormats)
    ->type_name(FilePlaceholder)
    ->required();
  AddLookup(*command, options->Lookup, "the lookup");
  AddPixelSamples(*command, options->PixelSamples);
  options->Colors.AddTo(*command);
  options->Tone.AddTo(*command);
  options->Camera.AddTo(*command);
  options->Path.AddTo(*command);
  command->add_option("--frame-rate", options->FrameRate, "frames per second of a video")
    ->check(Between(1.0, 1000.0))
    ->capture_default_str()
    ->group("Camera path");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
