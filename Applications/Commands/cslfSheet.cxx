// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf sheet: arranges pictures in one picture.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Fields/cslfFieldFiles.h"
#include "Pictures/cslfContactSheet.h"
#include "Pictures/cslfPictures.h"
#include "cslfCommands.h"

#include <vtkImageData.h>

#include <CLI/CLI.hpp>

#include <memory>

namespace cslf::tool
{
namespace
{
struct Options
{
  std::vector<std::string> Inputs;
  std::vector<std::string> Labels;
  std::string Output;
  int Columns = 1;
};

Result Run(const Options& options)
{
  RequirePicture(options.Output);
  if (options.Labels.size() > options.Inputs.size())
  {
    throw Failure("There are more labels than pictures.");
  }
  std::vector<LabelledPicture> pictures;
  for (std::size_t index = 0; index < options.Inputs.size(); ++index)
  {
    pictures.push_back({ ReadPicture(options.Inputs[index]),
      index < options.Labels.size() ? options.Labels[index] : "" });
  }
  WritePicture(options.Output, MakeContactSheet(pictures, options.Columns));
  Result result;
  result.Text = options.Output + "\n";
  result.JSON = { { "output", options.Output } };
  return result;
}
}

void AddSheet(CLI::App& app, Command& chosen)
{
  CLI::App* command = app.add_subcommand("sheet", "Put pictures side by side");
  command->footer(MakeFooter({ "cslf sheet a.png b.png --columns 2 -o sheet.png" }));
  const auto options = std::make_shared<Options>();
  command->add_option("picture", options->Inputs, "the pictures (.png, .jpg or .webp), row by row")
    ->type_name(FilePlaceholder)
    ->required();
  command->add_option("-o,--output", options->Output, std::string("the output: ") + PictureFormats)
    ->type_name(FilePlaceholder)
    ->required();
  command->add_option("--columns", options->Columns, "pictures per row")
    ->check(Positive())
    ->capture_default_str();
  command
    ->add_option(
      "--label", options->Labels, "a line of text below each picture; one option per picture")
    ->type_name("TEXT");
  command->callback([options, &chosen] { chosen = [options] { return Run(*options); }; });
}
}
