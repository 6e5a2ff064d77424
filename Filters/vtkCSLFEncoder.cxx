// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFEncoder.h"

#include "Coding/cslfFieldWriter.h"
#include "Pipeline/cslfSlicePuller.h"

#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

vtkStandardNewMacro(vtkCSLFEncoder);

namespace
{
/// What a slab's samples may take, in bytes.
constexpr double SlabBytes = 512.0 * 1024 * 1024;

/// Groups coded at once, for each thread: with several tracks each they keep all threads busy.
constexpr int GroupsPerThread = 2;

/// How much of the progress is left for joining the parts.
constexpr double JoinShare = 0.05;

/// The grid of viewpoints and texels that a whole extent stands for.
std::optional<cslf::Layout> FindGrid(const int extent[6])
{
  const double viewpoints = std::sqrt((extent[5] + 1.0) / cslf::FaceCount);
  const cslf::Layout grid(static_cast<int>(std::lround(viewpoints)), extent[3] + 1);
  int whole[6];
  grid.GetWholeExtent(whole);
  if (!grid.IsValid() || !std::equal(whole, whole + 6, extent))
  {
    return std::nullopt;
  }
  return grid;
}
}

/// Writes one file: pulls slabs from the input and hands them to the writer of the field.
class vtkCSLFEncoder::Session
{
public:
  /// Checks everything that can be checked before the input works. Null on failure.
  static std::unique_ptr<Session> Make(vtkCSLFEncoder* self, vtkInformation* inInfo)
  {
    if (!self->FileName || !*self->FileName)
    {
      self->Fail(vtkErrorCode::NoFileNameError, "There is no file name.");
      return nullptr;
    }
    int extent[6] = { 0, -1, 0, -1, 0, -1 };
    inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
    const auto grid = FindGrid(extent);
    if (!grid)
    {
      self->Fail(vtkErrorCode::UserError,
        "The input is not a whole light field: its extent must be 5 N x N x 6 M^2.");
      return nullptr;
    }
    const cslf::EncodeSettings settings{ self->Preset ? self->Preset : "",
      self->PixelFormat ? self->PixelFormat : "", self->CRF, self->CoverageCRF, self->DepthCRF,
      self->GroupLength, self->Lossless };
    const std::string fault = cslf::FindFault(self->FileName, settings, grid->GetResolution());
    if (!fault.empty())
    {
      self->Fail(vtkErrorCode::CannotOpenFileError, fault);
      return nullptr;
    }
    return std::make_unique<Session>(self, inInfo, settings, *grid);
  }

  Session(vtkCSLFEncoder* self, vtkInformation* inInfo, const cslf::EncodeSettings& settings,
    const cslf::Layout& grid)
    : Self(self)
    , Grid(grid)
    , Puller(inInfo, grid)
    , Writer(self->FileName, settings, grid)
  {
  }

  bool Run()
  {
    const cslf::AVLogSilence silence;
    if (!this->Begin())
    {
      return false;
    }
    while (!this->Writer.GetMissingGroups().empty())
    {
      const std::vector<int> groups = this->ChooseGroups();
      std::vector<cslf::GroupParts> parts;
      if (!this->MakeGroups(groups, parts) || !this->StoreGroups(groups, parts))
      {
        return false;
      }
    }
    std::string error;
    const auto report = [this](double share)
    { return this->Report(1.0 - JoinShare + JoinShare * share); };
    return this->Writer.Finish(report, error) || this->Fail(vtkErrorCode::UnknownError, error);
  }

private:
  bool Fail(unsigned long code, const std::string& error)
  {
    return this->Self->Fail(
      code, std::string(this->Self->FileName) + " was not written: " + error + ".");
  }

  bool Report(double progress)
  {
    this->Self->UpdateProgress(progress);
    return !this->Self->GetAbortExecute();
  }

  /// Progress is that of the groups that are stored.
  bool ReportGroups()
  {
    const double missing = static_cast<double>(this->Writer.GetMissingGroups().size());
    return this->Report((1.0 - JoinShare) * (1.0 - missing / this->Writer.GetGroupCount())) ||
      this->Fail(vtkErrorCode::UserError, "it was stopped");
  }

  /// The input holds its first viewpoint, which tells what the field is.
  bool Begin()
  {
    std::string error;
    if (!this->Puller.Begin(error))
    {
      return this->Self->Fail(vtkErrorCode::FileFormatError, error);
    }
    for (const cslf::Channel& channel : this->Puller.GetField().Channels)
    {
      if (channel.Name != cslf::ColorName && channel.Name != cslf::DepthName)
      {
        vtkWarningWithObjectMacro(
          this->Self, "The channel \"" << channel.Name << "\" is left out of the coded file.");
      }
    }
    this->Writer.Begin(this->Puller.GetField());
    std::string warning;
    if (!this->Writer.OpenParts(
          this->Self->Restart, this->Puller.GetFirstChecksum(), warning, error))
    {
      return this->Fail(vtkErrorCode::CannotOpenFileError, error);
    }
    if (!warning.empty())
    {
      vtkWarningWithObjectMacro(this->Self, << this->Self->FileName << ": " << warning);
    }
    return this->ReportGroups();
  }

  std::vector<int> ChooseGroups() const
  {
    const std::vector<int>& missing = this->Writer.GetMissingGroups();
    const int count = std::min(this->GetGroupsAtOnce(), static_cast<int>(missing.size()));
    return { missing.begin(), missing.begin() + count };
  }

  int GetGroupsAtOnce() const
  {
    constexpr int texelBytes = 6;
    const double groupBytes = 1.0 * texelBytes * this->Grid.GetStripWidth() *
      this->Grid.GetResolution() * this->Self->GroupLength;
    const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
    return std::max(
      1, static_cast<int>(std::min<double>(GroupsPerThread * threads, SlabBytes / groupBytes)));
  }

  bool MakeGroups(const std::vector<int>& groups, std::vector<cslf::GroupParts>& parts)
  {
    std::string error;
    return (this->Puller.Pull(this->Writer.GetSlices(groups), error) &&
             this->Writer.EncodeGroups(
               groups, this->Puller.GetSlices(), [] {}, parts, error)) ||
      this->Fail(vtkErrorCode::UnknownError, error);
  }

  bool StoreGroups(const std::vector<int>& groups, const std::vector<cslf::GroupParts>& parts)
  {
    std::string error;
    for (std::size_t place = 0; place < groups.size(); ++place)
    {
      if (!this->Writer.StoreGroup(groups[place], parts[place], error))
      {
        return this->Fail(vtkErrorCode::UnknownError, error);
      }
    }
    return this->ReportGroups();
  }

  vtkCSLFEncoder* Self;
  cslf::Layout Grid;
  cslf::SlicePuller Puller;
  cslf::FieldWriter Writer;
};

vtkCSLFEncoder::vtkCSLFEncoder()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(0);
  this->SetPreset("medium");
  this->SetPixelFormat("yuv444p");
}

vtkCSLFEncoder::~vtkCSLFEncoder()
{
  this->SetFileName(nullptr);
  this->SetPreset(nullptr);
  this->SetPixelFormat(nullptr);
}

int vtkCSLFEncoder::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

void vtkCSLFEncoder::SetInputData(vtkImageData* input)
{
  this->SetInputDataInternal(0, input);
}

vtkImageData* vtkCSLFEncoder::GetInput()
{
  return this->GetNumberOfInputConnections(0) > 0
    ? vtkImageData::SafeDownCast(this->GetInputDataObject(0, 0))
    : nullptr;
}

bool vtkCSLFEncoder::Fail(unsigned long code, const std::string& text)
{
  this->SetErrorCode(code);
  vtkErrorMacro(<< text);
  return false;
}

int vtkCSLFEncoder::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (this->GetNumberOfInputConnections(0) < 1)
  {
    this->Fail(vtkErrorCode::UnknownError, "There is no input to write.");
    return 0;
  }
  // Everything that the whole extent tells is checked before the input works.
  if (!this->GetInputAlgorithm()->GetExecutive()->UpdateInformation())
  {
    this->Fail(vtkErrorCode::UnknownError, "The input could not tell what it is.");
    return 0;
  }
  if (!Session::Make(this, this->GetInputInformation(0, 0)))
  {
    return 0;
  }
  // Writing always writes, whether or not something changed.
  this->Modified();
  const bool executed = this->GetExecutive()->Update() != 0;
  if (!executed && this->GetErrorCode() == vtkErrorCode::NoError)
  {
    this->Fail(vtkErrorCode::UnknownError, "The input failed.");
  }
  return this->GetErrorCode() == vtkErrorCode::NoError ? 1 : 0;
}

vtkTypeBool vtkCSLFEncoder::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    // One viewpoint is enough to begin with: the session asks for what it needs.
    vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
    int extent[6];
    inInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
    extent[5] = extent[4];
    inInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
    return 1;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    // The error code tells of failures: a failed request would only add the executive's message.
    this->SetErrorCode(vtkErrorCode::NoError);
    if (const auto session = Session::Make(this, inputVector[0]->GetInformationObject(0)))
    {
      session->Run();
    }
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

void vtkCSLFEncoder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "CRF: " << this->CRF << "\n";
  os << indent << "CoverageCRF: " << this->CoverageCRF << "\n";
  os << indent << "DepthCRF: " << this->DepthCRF << "\n";
  os << indent << "Preset: " << (this->Preset ? this->Preset : "(none)") << "\n";
  os << indent << "PixelFormat: " << (this->PixelFormat ? this->PixelFormat : "(none)") << "\n";
  os << indent << "GroupLength: " << this->GroupLength << "\n";
  os << indent << "Lossless: " << (this->Lossless ? "On" : "Off") << "\n";
  os << indent << "Restart: " << (this->Restart ? "On" : "Off") << "\n";
}
