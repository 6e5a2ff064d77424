// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf render: a novel view looked up in a light field.
#include "cslfCameraOptions.h"
#include "cslfCommands.h"
#include "cslfFieldFiles.h"
#include "cslfMessages.h"
#include "cslfPictures.h"

#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkImageData.h>

#include <CLI/CLI.hpp>

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
  std::string Output;
  std::string Lookup = "depth";
  CameraOptions Camera;
};

Result Run(const Options& options)
{
  RequireWritable(options.Output);
  const FieldFile file = OpenField(options.Field);
  const vtkSmartPointer<vtkCamera> camera = options.Camera.MakeCamera(file.Field.Box);
  RequireDisplay();
  {
    const ProgressBar bar(file.Reader, "Reading");
    file.Reader->UpdateWholeExtent();
  }
  ThrowOnError();
  FieldRenderer renderer(
    file.Reader->GetOutputPort(), options.Camera.GetWidth(), options.Camera.GetHeight());
  const std::string lookup = ChooseLookup(options.Lookup, file.Field);
  WritePicture(options.Output, renderer.Render(camera, FindLookup(lookup)));
  Result result;
  result.Text = options.Output + "\n";
  result.JSON = { { "output", options.Output }, { "lookup", lookup } };
  return result;
}
}

void AddRender(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("render", "Look a novel view up in a light field, over black");
  const auto options = std::make_shared<Options>();
  command->add_option("field", options->Field, std::string("the light field: ") + FieldFormats)
    ->required();
  command->add_option("-o,--output", options->Output, "the picture, .png")->required();
  command
    ->add_option("--lookup", options->Lookup,
      "nearest, linear, bilinear, focal or depth; without depth in the field, depth is focal")
    ->check(CLI::IsMember(GetLookupNames()))
    ->capture_default_str();
  options->Camera.AddTo(*command);
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
}
