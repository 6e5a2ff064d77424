// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFEncoder.h"

#include "Coding/cslfFieldWriter.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationExecutivePortKey.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
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
    , InInfo(inInfo)
    , Grid(grid)
    , Writer(self->FileName, settings, grid)
    , Texels(static_cast<std::size_t>(grid.GetStripWidth()) * grid.GetResolution())
  {
  }

  bool Run()
  {
    const cslf::AVLogSilence silence;
    const int groups = static_cast<int>(this->Writer.GetGroups().size());
    const int atOnce = this->GetGroupsAtOnce();
    for (int group = 0; group < groups; group += atOnce)
    {
      const int count = std::min(atOnce, groups - group);
      if (!this->Pull(this->Writer.GetSlices(group, count)))
      {
        return false;
      }
      std::string error;
      if (!this->Writer.WriteGroups(group, count, this->GetFrames(), error))
      {
        return this->Fail(vtkErrorCode::UnknownError, error);
      }
      if (!this->Report((1.0 - JoinShare) * (group + count) / groups))
      {
        return this->Fail(vtkErrorCode::UserError, "it was stopped");
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

  int GetGroupsAtOnce() const
  {
    constexpr int texelBytes = 6;
    const double groupBytes = 1.0 * texelBytes * this->Texels * this->Self->GroupLength;
    const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
    return std::max(
      1, static_cast<int>(std::min<double>(GroupsPerThread * threads, SlabBytes / groupBytes)));
  }

  /// Pulls slices, given in coding order, in as few slabs as possible.
  bool Pull(const std::vector<int>& slices)
  {
    this->Color.resize(4 * this->Texels * slices.size());
    std::vector<std::pair<int, std::size_t>> sorted; // slice, place
    for (std::size_t place = 0; place < slices.size(); ++place)
    {
      sorted.emplace_back(slices[place], place);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t begin = 0; begin < sorted.size();)
    {
      std::size_t end = begin + 1;
      while (end < sorted.size() && sorted[end].first == sorted[end - 1].first + 1)
      {
        ++end;
      }
      vtkImageData* image = this->Update(sorted[begin].first, sorted[end - 1].first);
      if (!image || !this->Check(image))
      {
        return false;
      }
      this->Depth.resize(this->HasDepth ? this->Texels * slices.size() : 0);
      for (; begin < end; ++begin)
      {
        this->Copy(image, sorted[begin].first, sorted[begin].second);
      }
    }
    return true;
  }

  vtkImageData* Update(int first, int last)
  {
    int extent[6];
    this->Grid.GetWholeExtent(extent);
    extent[4] = first;
    extent[5] = last;
    this->InInfo->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
    auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(
      vtkExecutive::PRODUCER()->GetExecutive(this->InInfo));
    auto* image = executive && executive->Update(vtkExecutive::PRODUCER()->GetPort(this->InInfo))
      ? vtkImageData::GetData(this->InInfo)
      : nullptr;
    if (!image || image->GetExtent()[4] > first || image->GetExtent()[5] < last)
    {
      this->Fail(vtkErrorCode::UnknownError,
        "the input did not give the viewpoints " + std::to_string(first) + " to " +
          std::to_string(last));
      return nullptr;
    }
    return image;
  }

  /// Checks a slab's description; the first one is the file's.
  bool Check(vtkImageData* image)
  {
    std::string error;
    const auto field = cslf::Description::ReadFrom(image, error);
    if (!field)
    {
      return this->Self->Fail(vtkErrorCode::FileFormatError, error);
    }
    const std::string text = field->ToText();
    if (!this->Text.empty())
    {
      return text == this->Text ||
        this->Fail(vtkErrorCode::UnknownError, "the input changed between two slabs");
    }
    this->Text = text;
    error = cslf::FindFault(*field);
    if (!error.empty())
    {
      return this->Self->Fail(vtkErrorCode::FileFormatError, error);
    }
    for (const cslf::Channel& channel : field->Channels)
    {
      if (channel.Name != cslf::ColorName && channel.Name != cslf::DepthName)
      {
        vtkWarningWithObjectMacro(
          this->Self, "The channel \"" << channel.Name << "\" is left out of the coded file.");
      }
    }
    this->HasDepth = field->FindChannel(cslf::DepthName) != nullptr;
    return this->Writer.Begin(*field, error) ||
      this->Fail(vtkErrorCode::CannotOpenFileError, error);
  }

  void Copy(vtkImageData* image, int slice, std::size_t place)
  {
    vtkPointData* data = image->GetPointData();
    const std::size_t offset = this->Texels * (slice - image->GetExtent()[4]);
    const auto* color =
      static_cast<unsigned char*>(data->GetArray(cslf::ColorName)->GetVoidPointer(0));
    std::copy_n(
      color + 4 * offset, 4 * this->Texels, this->Color.begin() + 4 * this->Texels * place);
    if (this->HasDepth)
    {
      const auto* depth =
        static_cast<unsigned short*>(data->GetArray(cslf::DepthName)->GetVoidPointer(0));
      std::copy_n(depth + offset, this->Texels, this->Depth.begin() + this->Texels * place);
    }
  }

  std::vector<cslf::ConstSlice> GetFrames() const
  {
    std::vector<cslf::ConstSlice> frames(this->Color.size() / (4 * this->Texels));
    for (std::size_t place = 0; place < frames.size(); ++place)
    {
      frames[place].Color = this->Color.data() + 4 * this->Texels * place;
      frames[place].Depth = this->HasDepth ? this->Depth.data() + this->Texels * place : nullptr;
    }
    return frames;
  }

  vtkCSLFEncoder* Self;
  vtkInformation* InInfo;
  cslf::Layout Grid;
  cslf::FieldWriter Writer;
  std::size_t Texels; ///< of one slice
  std::string Text;   ///< the description
  bool HasDepth = false;
  std::vector<unsigned char> Color; ///< of the slab, in coding order
  std::vector<unsigned short> Depth;
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
}
