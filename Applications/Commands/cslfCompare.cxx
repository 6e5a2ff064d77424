// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf compare: measures the difference between two pictures or light fields.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfTable.h"
#include "Fields/cslfFieldFiles.h"
#include "Files/cslfFileSystem.h"
#include "Pictures/cslfPictures.h"
#include "cslfCommands.h"

#include "vtkCSLFFieldQuality.h"
#include "vtkCSLFImageQuality.h"

#include <vtkImageData.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

namespace cslf::tool
{
namespace
{
struct Options
{
  std::string First;
  std::string Second;
  bool AllowMissing = false;
};

bool IsPicture(const std::string& fileName)
{
  std::error_code failure;
  return IsPictureName(fileName) && !std::filesystem::is_directory(ToPath(fileName), failure);
}

Result ComparePictures(const Options& options)
{
  vtkNew<vtkCSLFImageQuality> quality;
  quality->SetInputData(0, ReadPicture(options.First));
  quality->SetInputData(1, ReadPicture(options.Second));
  quality->Update();
  ThrowOnError();
  Result result;
  result.JSON = { { "psnr", quality->GetPSNR() }, { "ssim", quality->GetSSIM() } };
  result.Text =
    "PSNR " + Format(quality->GetPSNR(), 2) + " dB, SSIM " + Format(quality->GetSSIM(), 4) + "\n";
  return result;
}

Result CompareFields(const Options& options)
{
  const FieldFile first = OpenField(FieldInput{ options.First, options.AllowMissing });
  const FieldFile second = OpenField(FieldInput{ options.Second, options.AllowMissing });
  vtkNew<vtkCSLFFieldQuality> quality;
  quality->SetInputConnection(0, first.Reader->GetOutputPort());
  quality->SetInputConnection(1, second.Reader->GetOutputPort());
  {
    const ProgressBar bar(quality, "Comparing");
    quality->Measure();
  }
  ThrowOnError();
  Result result;
  Table table;
  nlohmann::json channels;
  for (int index = 0; index < quality->GetNumberOfFigures(); ++index)
  {
    const std::string name = quality->GetFigureName(index);
    channels[name] = { { "psnr", quality->GetPSNR(index) },
      { "equal", quality->GetIsEqual(index) } };
    table.AddRow(
      { name, quality->GetIsEqual(index) ? "equal" : Format(quality->GetPSNR(index), 2) + " dB" });
  }
  result.JSON = { { "channels", channels } };
  result.Text = table.ToText();
  return result;
}
}

void AddCompare(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("compare", "Measure the difference between two pictures or light fields");
  command->footer(MakeFooter({ "cslf compare render.png trace.png" },
    "Pictures: PSNR (at most 60 dB) of red, green and blue without alpha, and SSIM "
    "of luma. Light fields: PSNR (at most 100 dB) of each channel; for float colours "
    "also as displayed at 1/16, 1/4, 1, 4 and 16 times the exposure."));
  const auto options = std::make_shared<Options>();
  command->add_option("a", options->First, "a picture (.png, .jpg or .webp) or a light field")
    ->type_name(FilePlaceholder)
    ->required();
  command->add_option("b", options->Second, "a picture or light field to compare with")
    ->type_name(FilePlaceholder)
    ->required();
  AddAllowMissing(*command, options->AllowMissing);
  command->callback(
    [options, &chosen]
    {
      const bool arePictures = IsPicture(options->First) && IsPicture(options->Second);
      chosen = [options, arePictures]
      { return arePictures ? ComparePictures(*options) : CompareFields(*options); };
    });
}
}
