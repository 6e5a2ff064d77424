// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldFiles.h"

#include "Coding/Containers/cslfFileParts.h"
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfParallel.h"
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
#ifdef CSLF_HAS_ENCODER
#include "vtkCSLFEncoder.h"
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
/// Means a choice of key views by quality.
constexpr const char* AutomaticKeyViews = "auto";

/// The smallest targets on the command line. 0 would mean no target.
constexpr double MinimumRatio = 1e-3;
constexpr double MinimumTarget = 1.0;

std::optional<FieldFormat> FindFormat(const std::string& fileName)
{
  const std::string extension = LowerExtension(fileName);
  std::error_code failure;
  if (extension.empty() || fs::is_directory(ToPath(fileName), failure))
  {
    return FieldFormat::Folder;
  }
  if (extension == ".mp4" || extension == ".mkv")
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
      return MakeReader<vtkCSLFDecoder>(fileName);
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

#ifdef CSLF_HAS_ENCODER
/// Tells once what an encoder resumes.
void NoteResumed(vtkObject* caller, unsigned long, void* isTold, void*)
{
  auto* encoder = vtkCSLFEncoder::SafeDownCast(caller);
  if (encoder->GetResumedGroups() > 0 && !*static_cast<bool*>(isTold))
  {
    *static_cast<bool*>(isTold) = true;
    PrintNote("resuming an interrupted run: " + std::to_string(encoder->GetResumedGroups()) +
      " of " + std::to_string(encoder->GetNumberOfGroups()) + " groups of viewpoints are there");
  }
}

void AddParts(vtkCSLFEncoder* encoder, const std::vector<FieldPart>& parts)
{
  for (const FieldPart& part : parts)
  {
    encoder->AddPart(part.Type.c_str(), part.Bytes, part.Name.c_str());
    ThrowOnError();
  }
}
#endif
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

FieldFile OpenField(const std::string& name)
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
  file.Reader->UpdateInformation();
  ThrowOnError();
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
  command.add_option(name, this->FileName, std::string("the light field: ") + FieldFormats)
    ->type_name(FilePlaceholder)
    ->required();
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
  FieldFile file = OpenField(input.FileName);
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

void CodingOptions::AddTargetsTo(CLI::App& command)
{
  using Control = vtkCSLFRateControl;
  Control* rate = this->Rate;
  CLI::Option* factor = AddOption(command, options::CRF, rate, &Control::SetCRF);
  CLI::Option* ratio = AddOption(command, options::TargetRatio, rate, &Control::SetTargetRatio,
    RangeOf(options::TargetRatio, MinimumRatio));
  CLI::Option* size = AddOption(command, options::TargetSize, rate, &Control::SetTargetSize,
    RangeOf(options::TargetSize, MinimumTarget));
  CLI::Option* psnr = AddOption(command, options::TargetPSNR, rate, &Control::SetTargetPSNR,
    RangeOf(options::TargetPSNR, MinimumTarget));
  size->transform(Bytes())
    ->description(options::TargetSize.Help + std::string("; for example 20MB or 1.5GiB"))
    ->type_name(SizePlaceholder);
  factor->group(VideoGroup);
  ratio->group(VideoGroup)->excludes(factor);
  size->group(VideoGroup)->excludes(factor)->excludes(ratio);
  psnr->group(VideoGroup)->excludes(factor)->excludes(ratio)->excludes(size);
}

void CodingOptions::AddKeyViewsTo(CLI::App& command)
{
  vtkCSLFRateControl* rate = this->Rate;
  CLI::Option* keys =
    command
      .add_option_function<std::string>(
        options::KeyViewStep.Flag,
        [rate](const std::string& step)
        {
          rate->SetKeyViewStep(step == AutomaticKeyViews ? vtkCSLFRateControl::AutomaticKeyViews
                                                         : std::stoi(step, nullptr, 0));
        },
        options::KeyViewStep.Help +
          std::string("; or \"auto\": as few as reach --target-novel-psnr"))
      ->check((RangeOf(options::KeyViewStep, 1) | OneOf({ AutomaticKeyViews }))
                .description("1 to 4096, or auto"))
      ->default_str(CLI::detail::to_string(options::KeyViewStep.Default))
      ->group(VideoGroup);
  command
    .add_option_function<double>(
      options::TargetNovelViewPSNR.Flag,
      [rate](const double& psnr)
      {
        // The step is set before, because options are processed in the order of their definition.
        if (rate->GetKeyViewStep() != vtkCSLFRateControl::AutomaticKeyViews)
        {
          throw CLI::ValidationError(options::TargetNovelViewPSNR.Flag, "needs --key-views auto");
        }
        rate->SetTargetNovelViewPSNR(psnr);
      },
      options::TargetNovelViewPSNR.Help + std::string(", for --key-views auto"))
    ->check(RangeOf(options::TargetNovelViewPSNR, MinimumTarget))
    ->default_str(CLI::detail::to_string(options::TargetNovelViewPSNR.Default))
    ->needs(keys)
    ->group(VideoGroup);
}

void CodingOptions::AddTo(CLI::App& command)
{
  const std::string group = VideoGroup;
  AddOption(command, options::Codec, this->Codec)->group(group);
  this->AddTargetsTo(command);
  using Control = vtkCSLFRateControl;
  Control* rate = this->Rate;
  AddOption(command, options::CoverageCRF, rate, &Control::SetCoverageCRF)->group(group);
  AddOption(command, options::DepthCRF, rate, &Control::SetDepthCRF)->group(group);
  this->AddKeyViewsTo(command);
  AddOption(command, options::Preset, this->Preset)->group(group);
  AddOption(command, options::PixelFormat, this->PixelFormat)->group(group);
  AddOption(command, options::GroupLength, this->GroupLength)->group(group);
  AddOption(command, options::Lossless, this->Lossless)->group(group);
  AddOption(command, options::DepthFromGeometry, this->DepthFromGeometry)->group(group);
  AddOption(command, options::Restart, this->Restart)->group(group);
  command
    .add_option("--part", this->Parts,
      "a file to store in the video, for example scene=model/gltf-binary:scene.glb; may be "
      "repeated")
    ->allow_extra_args(false)
    ->option_text("NAME=TYPE:FILE")
    ->check(FindPartError)
    ->group(group);
}

bool CodingOptions::HasTarget() const
{
  return this->Rate->GetTargetRatio() > 0.0 || this->Rate->GetTargetSize() > 0.0 ||
    this->Rate->GetTargetPSNR() > 0.0;
}

#ifdef CSLF_HAS_ENCODER
void CodingOptions::Apply(vtkCSLFEncoder* encoder) const
{
  encoder->SetRateControl(this->Rate);
  encoder->SetCodec(this->Codec.c_str());
  encoder->SetPreset(this->Preset.c_str());
  encoder->SetPixelFormat(this->PixelFormat.c_str());
  encoder->SetGroupLength(this->GroupLength);
  encoder->SetLossless(this->Lossless);
  encoder->SetDepthFromGeometry(this->DepthFromGeometry);
  encoder->SetCertificate(this->Certificate);
  encoder->SetRestart(this->Restart);
  encoder->SetOverwrite(this->Overwrite);
}
#endif

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

FieldOutput::FieldOutput(const std::string& fileName, const CodingOptions& coding)
  : FileName(fileName)
  , Coding(coding)
{
  this->Format = tool::GetFormat(fileName);
  if (this->Format != FieldFormat::Video &&
    (coding.HasTarget() || coding.HasKeyViews() || !coding.Parts.empty()))
  {
    throw Failure("--target-ratio, --target-size, --target-psnr, --key-views and --part need a "
                  "video as output: .mp4 or .mkv.");
  }
#ifndef CSLF_HAS_ENCODER
  if (this->Format == FieldFormat::Video)
  {
    throw Failure(NoEncoder);
  }
#endif
  if (this->Format != FieldFormat::Folder && IsFirstRank())
  {
    RequireWritable(fileName);
  }
#ifdef CSLF_HAS_ENCODER
  if (IsFirstRank())
  {
    // Checked before days of sampling.
    this->Parts = ReadParts(coding.Parts, fileName);
    AddParts(vtkNew<vtkCSLFEncoder>(), this->Parts);
  }
#endif
}

void FieldOutput::TakeParts(const FieldFile& file)
{
  std::vector<FieldPart> parts = GetParts(file);
  parts.erase(std::remove_if(parts.begin(), parts.end(),
                [](const FieldPart& part) { return part.Type == GeometryPartType; }),
    parts.end());
  MergeParts(this->Parts, parts);
}

nlohmann::json FieldOutput::Write(
  vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry, const std::string& label) const
{
  switch (this->Format)
  {
#ifdef CSLF_HAS_ENCODER
    case FieldFormat::Video:
      return this->WriteVideo(connection, geometry, label);
#endif
    case FieldFormat::ImageData:
      WriteImageData(connection, this->FileName, label);
      if (geometry)
      {
        WriteGeometry(connection, geometry, this->FileName);
      }
      break;
    default:
      this->WriteFolder(connection, label);
      break;
  }
  return nlohmann::json::object();
}

#ifdef CSLF_HAS_ENCODER
nlohmann::json FieldOutput::WriteVideo(
  vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry, const std::string& label) const
{
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(0, connection);
  encoder->SetInputConnection(1, geometry);
  encoder->SetFileName(this->FileName.c_str());
  this->Coding.Apply(encoder);
  AddParts(encoder, this->Parts);
  bool isTold = false;
  vtkNew<vtkCallbackCommand> note;
  note->SetCallback(NoteResumed);
  note->SetClientData(&isTold);
  encoder->AddObserver(vtkCommand::ProgressEvent, note);
  const ProgressBar bar(encoder, label);
  bool isWritten = false;
  {
    std::optional<ResumableWork> resumable;
    if (this->Coding.Restart)
    {
      resumable.emplace();
    }
    const SharedWork shared;
    isWritten = encoder->Write() != 0;
  }
  if (!isWritten)
  {
    // If processes share the work, those that failed have reported the reason.
    throw Failure(IsShared() ? GetFirstError() : "Cannot write " + this->FileName + ".");
  }
  nlohmann::json json = { { "ratio", encoder->GetActualRatio() } };
  if (!this->Coding.Lossless)
  {
    json["crf"] = encoder->GetActualCRF();
  }
  if (encoder->GetActualPSNR() > 0.0)
  {
    json["psnr"] = encoder->GetActualPSNR();
  }
  if (encoder->GetNumberOfInputConnections(1) > 0)
  {
    json["depth_from_geometry"] = encoder->GetActualDepthFromGeometry();
    json["geometry_loss"] = encoder->GetActualGeometryLoss();
    json["color_from_geometry"] = encoder->GetActualColorFromGeometry();
  }
  if (encoder->GetResumedGroups() > 0)
  {
    json["groups"] = encoder->GetNumberOfGroups();
    json["resumed_groups"] = encoder->GetResumedGroups();
  }
  if (this->Coding.HasKeyViews())
  {
    json["key_view_step"] = encoder->GetActualKeyViewStep();
  }
  if (encoder->GetActualNovelViewPSNR() > 0.0)
  {
    json["novel_psnr"] = encoder->GetActualNovelViewPSNR();
  }
  return json;
}
#endif

void FieldOutput::WriteFolder(vtkAlgorithmOutput* connection, const std::string& label) const
{
  vtkNew<vtkCSLFImageWriter> writer;
  writer->SetInputConnection(connection);
  writer->SetFileName(this->FileName.c_str());
  const ProgressBar bar(writer, label);
  if (!writer->Write())
  {
    throw Failure("Cannot write " + this->FileName + ".");
  }
}

std::string DescribeCoding(const nlohmann::json& coding)
{
  std::ostringstream text;
  text << std::setprecision(4);
  if (coding.contains("ratio"))
  {
    text << ", 1/" << coding["ratio"].get<double>() << " of the raw colours";
  }
  if (coding.contains("psnr"))
  {
    text << ", " << coding["psnr"].get<double>() << " dB";
  }
  else if (coding.value("color_from_geometry", 0.0) == 1.0)
  {
    text << ", told by its geometry";
  }
  if (coding.contains("psnr") && coding.contains("crf"))
  {
    text << " at a rate factor of " << coding["crf"].get<double>();
  }
  if (coding.contains("key_view_step"))
  {
    text << ", key views of step " << coding["key_view_step"].get<int>();
  }
  if (coding.contains("novel_psnr"))
  {
    text << " with " << coding["novel_psnr"].get<double>() << " dB for the viewpoints between them";
  }
  if (coding.contains("resumed_groups"))
  {
    text << ", with " << coding["resumed_groups"].get<int>() << " of "
         << coding["groups"].get<int>() << " groups of viewpoints from an interrupted run";
  }
  return text.str();
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
