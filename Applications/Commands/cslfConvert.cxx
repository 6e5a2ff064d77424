// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// cslf encode, cslf decode and cslf resample: write a light field to another file.
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfParallel.h"
#include "Fields/cslfFieldFiles.h"
#include "Fields/cslfGeometryFiles.h"
#include "Fields/cslfOutputFiles.h"
#include "Options/cslfTableOptions.h"
#include "cslfCommands.h"

#include "vtkCSLFResample.h"

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <sstream>

namespace cslf::tool
{
namespace
{
struct Options
{
  FieldInput Input;
  std::string Output;
  CodingOptions Coding;
  std::optional<std::string> Part; ///< requested instead of the field
  int ResolutionDivisor = options::ResolutionDivisor.Default;
  int ViewpointStride = options::ViewpointStride.Default;
  int GeometryTriangles = 0; ///< of a geometry made from depth
};

/// The size of all channels, uncoded.
double CountRawBytes(const Description& description)
{
  const Layout& grid = description.Grid;
  double texel = 0.0;
  for (const Channel& channel : description.Channels)
  {
    texel += channel.Components * vtkDataArray::GetDataTypeSize(channel.Type);
  }
  return texel * grid.GetStripWidth() * grid.GetResolution() * grid.GetSlices();
}

/// Writes a part of a video to a file.
Result Extract(const Options& options)
{
  RequireOther(options.Input.FileName, options.Output);
  RequireWritable(options.Output);
  const FieldFile file = OpenField(options.Input.FileName);
  const FieldPart part = FindPart(GetParts(file), *options.Part, options.Input.FileName);
  const vtkIdType bytes = part.Bytes->GetNumberOfValues();
  WriteWholeBytes(part.Bytes->GetPointer(0), static_cast<std::size_t>(bytes), options.Output);
  Result result;
  result.JSON = { { "output", options.Output }, { "name", part.Name }, { "type", part.Type },
    { "bytes", bytes } };
  result.Text =
    options.Output + ": " + std::to_string(bytes) + " bytes of type " + part.Type + "\n";
  return result;
}

/// Writes the field of a connection, with the geometry of a file. Only the first process has a
/// result; `isCoarser` selects its details.
Result Write(const Options& options, const FieldOutput& writer, const FieldFile& file,
  vtkAlgorithmOutput* connection, const char* label, bool isCoarser)
{
  const nlohmann::json coding = writer.Write(connection, file.GetGeometry(), label);
  ThrowOnError();
  WarnOfLoss(file);

  if (!IsFirstRank())
  {
    return {};
  }
  const Description field = OpenField(options.Output).Field;
  Result result;
  result.JSON = Summarize(field);
  result.JSON["output"] = options.Output;
  result.JSON["bytes"] = CountBytes(options.Output);
  result.JSON.update(coding);
  std::ostringstream text;
  text << options.Output << ": ";
  if (isCoarser)
  {
    const int resolution = field.Grid.GetResolution();
    text << field.Grid.GetSlices() << " viewpoints of " << resolution << " x " << resolution
         << " texels, ";
  }
  else
  {
    result.JSON["raw_bytes"] = CountRawBytes(field);
  }
  text << CountBytes(options.Output) << " bytes" << DescribeCoding(coding) << "\n";
  result.Text = text.str();
  return result;
}

Result Convert(const Options& options, bool toVideo)
{
  FieldOutput writer(options.Output, options.Coding);
  if ((writer.GetFormat() == FieldFormat::Video) != toVideo)
  {
    throw Failure(toVideo ? "cslf encode writes .mp4 or .mkv; see cslf decode for other formats."
                          : "cslf decode writes .vti or a folder; see cslf encode for video.");
  }
  RequireOther(options.Input.FileName, options.Output);
  FieldFile file = OpenField(options.Input);
  writer.TakeParts(file);
  MakeGeometry(options.GeometryTriangles, file);
  return Write(
    options, writer, file, file.Reader->GetOutputPort(), toVideo ? "Encoding" : "Decoding", false);
}

Result Resample(const Options& options)
{
  if (options.ResolutionDivisor == 1 && options.ViewpointStride == 1 &&
    options.GeometryTriangles == 0)
  {
    throw Failure("Nothing would change: specify --resolution-divisor, --viewpoint-stride or "
                  "--geometry-triangles. To code a field anew, use cslf encode.");
  }
  FieldOutput writer(options.Output, options.Coding);
  RequireOther(options.Input.FileName, options.Output);
  FieldFile file = OpenField(options.Input);
  writer.TakeParts(file);
  if (options.GeometryTriangles > 0 && writer.GetFormat() == FieldFormat::Folder)
  {
    throw Failure("A folder has no place for the geometry that --geometry-triangles makes.");
  }
  MakeGeometry(options.GeometryTriangles, file);
  vtkNew<vtkCSLFResample> resample;
  resample->SetInputConnection(file.Reader->GetOutputPort());
  resample->SetResolutionDivisor(options.ResolutionDivisor);
  resample->SetViewpointStride(options.ViewpointStride);
  Result result = Write(options, writer, file, resample->GetOutputPort(), "Resampling", true);
  if (IsFirstRank() && writer.GetFormat() == FieldFormat::Video &&
    CountBytes(options.Output) > CountBytes(options.Input.FileName))
  {
    AddWarning(options.Output + " is coarser than " + options.Input.FileName +
      ", but larger: specify --crf or --target-size, or keep the original.");
  }
  return result;
}

/// Adds the option that lets a field without geometry get one.
void AddGeometry(CLI::App& command, Options& options)
{
  AddOption(command, cslf::options::GeometryTriangles, options.GeometryTriangles)
    ->description("make a geometry of at most this many triangles from the depth of a light field "
                  "that has none, for the lookup geometry; 200000 suit most; 0 for none");
}

void Add(CLI::App& app, Command& chosen, const char* name, const char* help, bool toVideo)
{
  CLI::App* command = app.add_subcommand(name, help);
  command->footer(MakeFooter({ toVideo ? "cslf encode box.vti -o box.mp4 --target-size 5MB"
                                       : "cslf decode box.mp4 -o cube-maps" }));
  const auto options = std::make_shared<Options>();
  options->Input.AddTo(*command, "input");
  command
    ->add_option("-o,--output", options->Output,
      toVideo ? "the output: .mp4 or .mkv"
              : "the output: .vti or a folder of cube maps; with --part any file")
    ->type_name(FilePlaceholder)
    ->required();
  if (toVideo)
  {
    AddGeometry(*command, *options);
    options->Coding.AddTo(*command);
  }
  else
  {
    command
      ->add_option("--part", options->Part,
        "write the part of the video with this name (see cslf info) instead of the light field; "
        "NAME=TYPE if names repeat")
      ->type_name("NAME");
  }
  command->callback(
    [=, &chosen]
    {
      SetShared(IsVideo(options->Output) && !options->Part);
      chosen = [options, toVideo]
      { return options->Part ? Extract(*options) : Convert(*options, toVideo); };
    });
}
}

void AddEncode(CLI::App& app, Command& chosen)
{
  Add(app, chosen, "encode", "Encode a light field as video", true);
}

void AddDecode(CLI::App& app, Command& chosen)
{
  Add(app, chosen, "decode", "Decode a light field to image data or cube maps", false);
}

void AddResample(CLI::App& app, Command& chosen)
{
  CLI::App* command =
    app.add_subcommand("resample", "Make a coarser light field with fewer texels or viewpoints");
  command->footer(MakeFooter(
    { "cslf resample box.mp4 -o small.mp4 --resolution-divisor 2 --viewpoint-stride 2" }));
  const auto options = std::make_shared<Options>();
  options->Input.AddTo(*command, "input");
  command
    ->add_option(
      "-o,--output", options->Output, std::string("the coarser light field: ") + FieldFormats)
    ->type_name(FilePlaceholder)
    ->required();
  AddOption(*command, cslf::options::ResolutionDivisor, options->ResolutionDivisor);
  AddOption(*command, cslf::options::ViewpointStride, options->ViewpointStride);
  AddGeometry(*command, *options);
  options->Coding.AddTo(*command);
  command->callback(
    [options, &chosen]
    {
      SetShared(IsVideo(options->Output));
      chosen = [options] { return Resample(*options); };
    });
}
}
