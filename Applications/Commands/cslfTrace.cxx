// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf trace: path-traces the reference for a novel view.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Fields/cslfFieldFiles.h"
#include "Options/cslfCameraOptions.h"
#include "Options/cslfIntegratorOptions.h"
#include "Pictures/cslfPictures.h"
#include "Scenes/cslfSceneFiles.h"
#include "cslfCommands.h"

#include "vtkCSLFViewTracer.h"

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
  SceneOptions Scene;
  CameraOptions Camera;
  std::string Output;
  IntegratorOptions Integrator{ vtkCSLFPathTracer::PathTracing };
};

Result Run(const Options& options)
{
  RequirePicture(options.Output);
  options.Scene.RequireOther(options.Output);
  const Scene scene = options.Scene.Read();
  vtkNew<vtkCSLFViewTracer> tracer;
  options.Scene.Apply(scene, tracer);
  double bounds[6];
  scene.GetBounds(bounds);
  tracer->SetCamera(options.Camera.MakeCamera(Cube::FromBounds(bounds, options::Offset.Default)));
  tracer->SetSize(options.Camera.GetWidth(), options.Camera.GetHeight());
  options.Integrator.Apply(tracer);
  {
    const ProgressBar bar(tracer, "Tracing");
    tracer->Update();
  }
  ThrowOnError();
  WritePicture(
    options.Output, DropAlpha(tracer->GetOutput(), options.Camera.GetBackground().data()));
  Result result;
  result.Text = options.Output + "\n";
  result.JSON = IntegratorOptions::GetCost(tracer);
  result.JSON["output"] = options.Output;
  return result;
}
}

void AddTrace(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("trace", "Path-trace a view of a scene, as a reference for light fields");
  command->footer(MakeFooter({ "cslf trace cornell-box -o view.png --spp 64" }));
  const auto options = std::make_shared<Options>();
  options->Scene.AddTo(*command);
  command->add_option("-o,--output", options->Output, std::string("the output: ") + PictureFormats)
    ->type_name(FilePlaceholder)
    ->required();
  options->Integrator.AddTo(*command);
  options->Camera.AddTo(*command);
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
