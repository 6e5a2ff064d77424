// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldFiles.h"

#include "Coding/Containers/cslfFileParts.h"
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfNumberChecks.h"
#include "Console/cslfParallel.h"
#include "Files/cslfFileSeries.h"
#include "Files/cslfFileSystem.h"
#include "Files/cslfWorkFolder.h"
#include "Options/cslfTableOptions.h"
#include "Pipeline/cslfFieldArrays.h"
#include "cslfGeometryFiles.h"
#include "cslfImageDataFiles.h"
#include "cslfOutputFiles.h"
#include "cslfSceneChecks.h"

#include "vtkCSLFDecoder.h"
#include "vtkCSLFImageReader.h"
#include "vtkCSLFImageWriter.h"
#include "vtkCSLFSeriesReader.h"
#ifdef CSLF_HAS_ENCODER
#include "vtkCSLFEncoder.h"
#include "vtkCSLFSeriesWriter.h"
#endif

#include <vtkAlgorithmOutput.h>
#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkXMLImageDataReader.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iomanip>
#include <optional>
#include <sstream>
#include <type_traits>

namespace fs = std::filesystem;

namespace cslf::tool
{
namespace
{
std::optional<FieldFormat> FindFormat(const std::string& fileName)
{
  const std::string extension = LowerExtension(fileName);
  std::error_code failure;
  if (extension.empty() || fs::is_directory(ToPath(fileName), failure))
  {
    return FieldFormat::Folder;
  }
  const bool isSeries = extension == FileSeriesExtension;
  const std::string kind = isSeries ? LowerExtension(ToName(ToPath(fileName).stem())) : extension;
  if (kind == ".mp4" || kind == ".mkv")
  {
    return FieldFormat::Video;
  }
  return extension == ".vti" ? std::make_optional(FieldFormat::ImageData) : std::nullopt;
}

template <typename Reader>
vtkSmartPointer<vtkAlgorithm> MakeReader(const std::string& fileName)
{
  vtkNew<Reader> reader;
  reader->SetFileName(fileName.c_str());
  if constexpr (std::is_same_v<Reader, vtkXMLImageDataReader>)
  {
    NameFileInErrors(reader, fileName);
  }
  else
  {
    reader->AllowMissingOff();
  }
  return reader.Get();
}

vtkSmartPointer<vtkAlgorithm> MakeReader(FieldFormat format, const std::string& fileName)
{
  switch (format)
  {
    case FieldFormat::Video:
      return MakeReader<vtkCSLFSeriesReader>(fileName);
    case FieldFormat::ImageData:
      CheckVTKXML(fileName);
      return MakeReader<vtkXMLImageDataReader>(fileName);
    default:
      return MakeReader<vtkCSLFImageReader>(fileName);
  }
}

/// The description that a reader knows before it reads samples.
std::string GetText(vtkAlgorithm* reader)
{
  if (auto* decoder = vtkCSLFDecoder::SafeDownCast(reader))
  {
    return decoder->GetDescription();
  }
  auto* images = vtkCSLFImageReader::SafeDownCast(reader);
  return images ? images->GetDescription() : std::string();
}

/// The description that comes with the first viewpoint.
std::optional<Description> ReadFirst(vtkAlgorithm* reader, std::string& error)
{
  int extent[6];
  vtkStreamingDemandDrivenPipeline::GetWholeExtent(reader->GetOutputInformation(0), extent);
  extent[5] = extent[4];
  if (!reader->UpdateExtent(extent))
  {
    error = "it cannot be read";
    return std::nullopt;
  }
  return Description::ReadFrom(vtkImageData::SafeDownCast(reader->GetOutputDataObject(0)), error);
}

}

FieldFormat GetFormat(const std::string& fileName)
{
  const auto format = FindFormat(fileName);
  if (!format)
  {
    throw Failure("Cannot write " + fileName + ": the formats are " + FieldFormats + ".");
  }
  return *format;
}

bool IsVideo(const std::string& fileName)
{
  return FindFormat(fileName) == FieldFormat::Video;
}

FieldFile OpenField(const std::string& name, std::optional<double> time)
{
  const std::string fileName = LocateField(name);
  // A pipe would block, and cannot be read twice.
  std::error_code failure;
  const fs::file_status status = fs::status(ToPath(fileName), failure);
  const bool isFolder = fs::is_directory(status) && !IsWorkFolder(ResolveTarget(fileName));
  if (!fs::is_regular_file(status) && !isFolder)
  {
    throw Failure(IsBeingWritten(fileName)
        ? fileName + " is unfinished, and there is no preview yet."
        : "There is no file or folder " + fileName + ".");
  }
  if (!isFolder && LowerExtension(fileName).empty())
  {
    throw Failure(fileName +
      " is a file without an extension, which would tell its format: the formats are " +
      FieldFormats + ".");
  }
  const auto format = FindFormat(fileName);
  if (!format)
  {
    throw Failure(fileName + " is not a light field: the formats are " + FieldFormats + ".");
  }
  FieldFile file;
  file.FileName = fileName;
  file.Format = *format;
  file.Reader = MakeReader(*format, fileName);
  auto* series = vtkCSLFSeriesReader::SafeDownCast(file.Reader);
  if (time && series)
  {
    series->SetTime(*time);
  }
  file.Reader->UpdateInformation();
  ThrowOnError();
  if (time && (!series || series->GetNumberOfTimeSteps() == 0))
  {
    throw Failure(fileName + " has no times that " + TimeFlag + " could choose.");
  }
  std::string error;
  const auto description = *format == FieldFormat::ImageData
    ? ReadFirst(file.Reader, error)
    : Description::FromText(GetText(file.Reader), error);
  ThrowOnError();
  if (!description)
  {
    throw Failure(fileName + ": " + error);
  }
  file.Field = *description;
  OpenGeometry(file);
  return file;
}

void FieldInput::AddTo(CLI::App& command, const std::string& name)
{
  command.add_option(name, this->FileName, std::string("the light field: ") + ReadFormats)
    ->type_name(FilePlaceholder)
    ->required();
  command.add_option(TimeFlag, this->Time, TimeHelp)->check(Finite())->type_name("TIME");
  AddAllowMissing(command, this->AllowMissing);
}

void AddAllowMissing(CLI::App& command, bool& isAllowed)
{
  command.add_flag("--allow-missing", isAllowed,
    "continue with a warning if viewpoints are missing from a damaged or unfinished file; "
    "otherwise nothing is written, and the exit code is 2");
}

FieldFile OpenField(const FieldInput& input)
{
  FieldFile file = OpenField(input.FileName, input.Time);
  const auto* series = vtkCSLFSeriesReader::SafeDownCast(file.Reader);
  const int times = series ? series->GetNumberOfTimeSteps() : 0;
  if (times > 1 && !input.Time && !input.HasAllTimes)
  {
    AddWarning(
      input.FileName + " has " + std::to_string(times) + " times, of which the first one is used.");
  }
  if (!input.AllowMissing)
  {
    // Readers report files without any viewpoint.
    const int missing = CountMissing(file);
    const int slices = file.Field.Grid.GetSlices();
    if (missing > 0 && missing < slices)
    {
      throw MissingViewpoints(input.FileName + " is " +
        (IsUnfinished(file) ? "unfinished" : "damaged") + ": " + std::to_string(missing) + " of " +
        std::to_string(slices) +
        " viewpoints are missing (all commands of cslf continue without them if --allow-missing is "
        "given).");
    }
    return file;
  }
  if (auto* decoder = vtkCSLFDecoder::SafeDownCast(file.Reader))
  {
    decoder->AllowMissingOn();
  }
  else if (auto* images = vtkCSLFImageReader::SafeDownCast(file.Reader))
  {
    images->AllowMissingOn();
  }
  return file;
}

void ReadToDraw(const FieldFile& file)
{
  if (file.Format != FieldFormat::Video)
  {
    const ProgressBar bar(file.Reader, "Reading");
    file.Reader->UpdateWholeExtent();
    ThrowOnError();
  }
}

bool IsUnfinished(const FieldFile& file)
{
  const auto* decoder = vtkCSLFDecoder::SafeDownCast(file.Reader);
  return decoder && decoder->IsUnfinished();
}

int CountMissing(const FieldFile& file)
{
  vtkIdType missing = 0;
  if (auto* decoder = vtkCSLFDecoder::SafeDownCast(file.Reader))
  {
    missing = decoder->FindMissingViewpoints();
  }
  else if (auto* images = vtkCSLFImageReader::SafeDownCast(file.Reader))
  {
    missing = images->FindMissingViewpoints();
  }
  else
  {
    auto* image = vtkImageData::SafeDownCast(file.Reader->GetOutputDataObject(0));
    const int slices = file.Field.Grid.GetSlices();
    const std::vector<int> listed = GetMissing(image, slices);
    int extent[6];
    vtkStreamingDemandDrivenPipeline::GetWholeExtent(file.Reader->GetOutputInformation(0), extent);
    for (int slice = 0; slice < slices; ++slice)
    {
      const bool isOutside = slice < extent[4] || slice > extent[5];
      missing += isOutside || std::binary_search(listed.begin(), listed.end(), slice) ? 1 : 0;
    }
  }
  ThrowOnError();
  return static_cast<int>(missing);
}

std::string GetCodecName(const FieldFile& file)
{
  if (auto* decoder = vtkCSLFDecoder::SafeDownCast(file.Reader))
  {
    return decoder->GetCodecName();
  }
  if (file.Format == FieldFormat::ImageData)
  {
    return "none";
  }
  const Channel* color = file.Field.FindChannel(KnownChannel::Color);
  return color && color->Type == VTK_FLOAT ? "exr" : "png";
}

nlohmann::json ListSteps(const FieldFile& file)
{
  nlohmann::json steps = nlohmann::json::array();
  auto* series = vtkCSLFSeriesReader::SafeDownCast(file.Reader);
  for (int step = 0; series && step < series->GetNumberOfTimeSteps(); ++step)
  {
    const std::string name = series->GetStepFileName(step);
    steps.push_back(
      { { "time", series->GetTimeStep(step) }, { "file", name }, { "bytes", CountBytes(name) } });
  }
  return steps;
}

std::uintmax_t CountBytes(const FieldFile& file)
{
  std::uintmax_t bytes = CountBytes(file.FileName);
  for (const nlohmann::json& step : ListSteps(file))
  {
    bytes += step["bytes"].get<std::uintmax_t>();
  }
  return bytes;
}

std::uintmax_t CountBytes(const std::string& fileName)
{
  std::error_code failure;
  if (!fs::is_directory(ToPath(fileName), failure))
  {
    const std::uintmax_t bytes = fs::file_size(ToPath(fileName), failure);
    return failure ? 0 : bytes;
  }
  std::uintmax_t sum = 0;
  for (const auto& entry : fs::directory_iterator(ToPath(fileName), failure))
  {
    const std::uintmax_t bytes = entry.file_size(failure);
    sum += failure ? 0 : bytes;
  }
  return sum;
}

std::string LowerExtension(const std::string& fileName)
{
  std::string extension = ToName(ToPath(fileName).extension());
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

void RequireWritable(const std::string& fileName)
{
  std::error_code failure;
  if (fs::is_directory(ToPath(fileName), failure))
  {
    throw Failure("Cannot write " + fileName + ": it is a folder.");
  }
  const std::string target = ResolveTarget(fileName);
  std::string error;
  if (!IsReplaceableByFile(target, error) || !IsWritableFolder(GetParent(target), error))
  {
    throw Failure("Cannot write " + fileName + ": " + error + ".");
  }
}

nlohmann::json Summarize(const Description& description)
{
  const nlohmann::json whole = description.ToJSON();
  const glm::dvec3& edges = description.Box.Edges;
  const bool isCube = edges.x == edges.y && edges.y == edges.z;
  nlohmann::json json = { { "views", description.Grid.GetViewpoints() },
    { "slices", description.Grid.GetSlices() }, { "resolution", description.Grid.GetResolution() },
    { "center", whole["center"] }, { "edge", isCube ? whole["edges"][0] : whole["edges"] },
    { "channels", whole["channels"] }, { "sampling", whole["sampling"] } };
  if (description.Measured)
  {
    json["certificate"] = description.Measured->ToJSON();
  }
  return json;
}
}
