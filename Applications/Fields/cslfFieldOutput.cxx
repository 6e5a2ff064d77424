// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// How fields are written: the settings of video coding, and the destinations.
#include "cslfFieldFiles.h"

#include "Coding/Containers/cslfFileParts.h"
#include "Console/cslfHelp.h"
#include "Console/cslfMessages.h"
#include "Console/cslfParallel.h"
#include "Options/cslfTableOptions.h"
#include "cslfGeometryFiles.h"
#include "cslfImageDataFiles.h"

#include "vtkCSLFImageWriter.h"
#ifdef CSLF_HAS_ENCODER
#include "vtkCSLFEncoder.h"
#include "vtkCSLFSeriesWriter.h"
#endif

#include <vtkAlgorithmOutput.h>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>

namespace cslf::tool
{
namespace
{
/// Means a choice of key views by quality.
constexpr const char* AutomaticKeyViews = "auto";

/// The smallest targets on the command line. 0 would mean no target.
constexpr double MinimumRatio = 1e-3;
constexpr double MinimumTarget = 1.0;

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
/// Connects an encoder to a field.
void FieldOutput::SetUp(
  vtkCSLFEncoder* encoder, vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry) const
{
  encoder->SetInputConnection(0, connection);
  encoder->SetInputConnection(1, geometry);
  encoder->SetFileName(this->FileName.c_str());
  this->Coding.Apply(encoder);
  AddParts(encoder, this->Parts);
}

/// Does the work of writing, which can be resumed. Throws a Failure if it returns 0.
void FieldOutput::Write(
  vtkCSLFEncoder* encoder, const std::string& label, const std::function<int()>& write) const
{
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
    isWritten = write() != 0;
  }
  if (!isWritten)
  {
    // If processes share the work, those that failed have reported the reason.
    throw Failure(IsShared() ? GetFirstError() : "Cannot write " + this->FileName + ".");
  }
}

void FieldOutput::WriteSeries(
  vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry, vtkCSLFSeriesWriter* writer) const
{
  vtkNew<vtkCSLFEncoder> encoder;
  this->SetUp(encoder, connection, geometry);
  writer->SetEncoder(encoder);
  this->Write(encoder, "Sampling", [writer] { return writer->Write(); });
}

nlohmann::json FieldOutput::WriteVideo(
  vtkAlgorithmOutput* connection, vtkAlgorithmOutput* geometry, const std::string& label) const
{
  vtkNew<vtkCSLFEncoder> encoder;
  this->SetUp(encoder, connection, geometry);
  this->Write(encoder, label, [&encoder] { return encoder->Write(); });
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
}
