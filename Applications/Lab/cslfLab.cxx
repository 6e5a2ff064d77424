// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf-lab: measures parts of CSLF, with one command per part.
#include "cslfLab.h"

#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfTable.h"
#include "Fields/cslfOutputFiles.h"

#include <vtkAlgorithm.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <system_error>

namespace cslf::tool
{
void WriteResult(const Result& result, const std::string& folder, const std::string& name)
{
  WriteWholeText(result.Text, folder + "/" + name + ".md");
  WriteWholeText(Print(result.JSON), folder + "/" + name + ".json");
}

void BenchmarkOptions::AddTo(CLI::App& command)
{
  command.add_option("field", this->Field, std::string("the light field: ") + FieldFormats)
    ->type_name(FilePlaceholder)
    ->required();
  command.add_option("-o,--output", this->Folder, "folder for the results")
    ->type_name(FolderPlaceholder)
    ->required();
  this->Novel.AddTo(command, "Novel views (with --scene)");
  this->Scene.AddOptionalTo(command);
}

FieldFile BenchmarkOptions::ReadField() const
{
  FieldFile file = OpenField(FieldInput{ this->Field });
  {
    const ProgressBar bar(file.Reader, "Reading");
    file.Reader->UpdateWholeExtent();
  }
  ThrowOnError();
  return file;
}

BenchmarkViews BenchmarkOptions::Begin(const Description& field)
{
  tool::Scene scene;
  if (!this->Scene.IsEmpty())
  {
    this->Scene.TakeDefaults(nlohmann::json::parse(field.Sampling, nullptr, false));
    scene = this->Scene.Read();
  }
  std::error_code failure;
  std::filesystem::create_directories(this->Folder, failure);
  RequireWritable(this->Folder + "/benchmark");

  BenchmarkViews views;
  if (!this->Scene.IsEmpty())
  {
    views.Views = TraceNovelViews(this->Scene, scene, field.Box, this->Novel);
  }
  for (const NovelView& view : views.Views)
  {
    views.NoiseFloor += view.NoiseFloor / static_cast<double>(views.Views.size());
  }
  return views;
}

nlohmann::json BenchmarkOptions::DescribeViews(double noiseFloor) const
{
  return { { "count", this->Novel.Views }, { "size", this->Novel.Size },
    { "spp", this->Novel.Samples }, { "seed", this->Novel.Seed }, { "noise_floor", noiseFloor } };
}

std::string BenchmarkOptions::DescribeNoise(double noiseFloor)
{
  return "\nNoise floor of the novel views' reference: " + Format(noiseFloor, 2) + " dB.\n";
}
}

int main(int argc, char* argv[])
{
  using namespace cslf::tool;
  Program program;
  program.Name = "cslf-lab";
  program.Description = "Measure quality and speed of cube surface light fields";
  program.Footer = MakeFooter(
    { "cslf-lab render box.mp4 -o bench" }, "\"cslf-lab COMMAND --help\" explains a command.");
  program.Commands = { AddBenchmarkRender, AddBenchmarkOpening, AddBenchmarkSampler,
    AddEvaluateTexels };
#ifdef CSLF_HAS_ENCODER
  program.Commands.insert(program.Commands.end(), { AddBenchmarkCodec, AddBenchmarkKeyViews });
#endif
  return RunProgram(program, argc, argv);
}
