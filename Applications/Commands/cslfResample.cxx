// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf resample: makes a coarser light field from a light field.
#include "Console/cslfMessages.h"
#include "Console/cslfParallel.h"
#include "Fields/cslfFieldFiles.h"
#include "Options/cslfNumberChecks.h"
#include "cslfCommands.h"

#include "vtkCSLFResample.h"

#include <vtkAlgorithm.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <sstream>

namespace cslf::tool
{
namespace
{
struct Options
{
  FieldInput Input;
  std::string Output;
  int ResolutionDivisor = 1;
  int ViewpointStride = 1;
  CodingOptions Coding;
};

Result Run(const Options& options)
{
  FieldWriter writer(options.Output, options.Coding);
  std::error_code failure;
  if (std::filesystem::equivalent(options.Input.FileName, options.Output, failure))
  {
    throw Failure("The input and the output are the same.");
  }
  const FieldFile input = OpenField(options.Input);
  writer.TakeParts(input);
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(input.Reader->GetOutputPort());
  resample->SetResolutionDivisor(options.ResolutionDivisor);
  resample->SetViewpointStride(options.ViewpointStride);
  const nlohmann::json coding = writer.Write(resample->GetOutputPort(), "Resampling");
  ThrowOnError();

  if (!IsFirstRank())
  {
    return {};
  }
  const FieldFile output = OpenField(options.Output);
  Result result;
  result.JSON = Summarize(output.Field);
  result.JSON["output"] = options.Output;
  result.JSON["bytes"] = CountBytes(options.Output);
  result.JSON.update(coding);
  std::ostringstream text;
  text << options.Output << ": " << output.Field.Grid.GetSlices() << " viewpoints of "
       << output.Field.Grid.GetResolution() << " x " << output.Field.Grid.GetResolution()
       << " texels, " << CountBytes(options.Output) << " bytes" << DescribeCoding(coding) << "\n";
  result.Text = text.str();
  return result;
}
}

void AddResample(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("resample", "Make a coarser light field with fewer texels or viewpoints");
  const auto options = std::make_shared<Options>();
  options->Input.AddTo(*command, "input");
  command
    ->add_option(
      "-o,--output", options->Output, std::string("the coarser light field: ") + FieldFormats)
    ->required();
  command
    ->add_option("--resolution-divisor", options->ResolutionDivisor,
      "texels along each side to combine into one; must divide N")
    ->check(Positive())
    ->capture_default_str();
  command
    ->add_option("--viewpoint-stride", options->ViewpointStride,
      "keep every n-th viewpoint along each side; must divide M - 1")
    ->check(Positive())
    ->capture_default_str();
  options->Coding.AddTo(*command);
  command->callback(
    [options, &chosen]
    {
      SetShared(IsVideo(options->Output));
      chosen = [options] { return Run(*options); };
    });
}
}
