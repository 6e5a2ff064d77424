// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFDecoder.h"

#include "Coding/cslfFieldReader.h"
#include "Pipeline/cslfSlabs.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>
#include <vector>

vtkStandardNewMacro(vtkCSLFDecoder);

class vtkCSLFDecoder::Internals
{
public:
  std::unique_ptr<cslf::FieldReader> Reader;
  std::string Description;
  std::string PixelFormat;
  vtkNew<vtkFieldData> Field;           ///< of every output
  std::vector<std::int64_t> TrackBytes; ///< empty until asked for
  vtkNew<vtkIdTypeArray> Missing;
  std::optional<std::vector<int>> Damage; ///< the file's missing viewpoints, once any is met

  void SetReader(std::unique_ptr<cslf::FieldReader> reader)
  {
    this->Reader = std::move(reader);
    this->Description.clear();
    this->PixelFormat.clear();
    this->Field->Initialize();
    this->TrackBytes.clear();
    this->Damage.reset();
    if (this->Reader)
    {
      const cslf::FileHeader& header = this->Reader->GetHeader();
      header.Field.WriteTo(this->Field);
      this->Description = header.Field.ToText();
      this->PixelFormat = cslf::NameOfFormat(header.Tracks.front().Kind.Format);
    }
  }

  bool HasViewpoint(vtkIdType z) const
  {
    return this->Reader && z >= 0 && z < this->Reader->GetHeader().Field.Grid.GetSlices();
  }

  /// The extent of the whole field but for z.
  void GetExtent(vtkIdType first, vtkIdType last, int extent[6]) const
  {
    this->Reader->GetHeader().Field.Grid.GetWholeExtent(extent);
    extent[4] = static_cast<int>(first);
    extent[5] = static_cast<int>(last);
  }

  void SetMissing(const std::vector<int>& slices)
  {
    this->Missing->Reset();
    for (int slice : slices)
    {
      this->Missing->InsertNextValue(slice);
    }
  }
};

vtkCSLFDecoder::vtkCSLFDecoder()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
}

vtkCSLFDecoder::~vtkCSLFDecoder()
{
  this->SetFileName(nullptr);
}

int vtkCSLFDecoder::CanReadFile(const char* fileName)
{
  const cslf::AVLogSilence silence;
  cslf::OpenFailure ignored;
  constexpr int certainly = 3;
  return fileName && cslf::FieldReader::Open(fileName, ignored) ? certainly : 0;
}

const char* vtkCSLFDecoder::GetDescription() const
{
  return this->Internal->Description.c_str();
}

const char* vtkCSLFDecoder::GetCodecName() const
{
  const auto& reader = this->Internal->Reader;
  return reader ? cslf::NameOfCodec(reader->GetHeader().Tracks.front().Kind.Coding) : "";
}

const char* vtkCSLFDecoder::GetPixelFormat() const
{
  return this->Internal->PixelFormat.c_str();
}

int vtkCSLFDecoder::GetNumberOfTracks() const
{
  const auto& reader = this->Internal->Reader;
  return reader ? static_cast<int>(reader->GetHeader().Tracks.size()) : 0;
}

const char* vtkCSLFDecoder::GetTrackName(int track) const
{
  return track >= 0 && track < this->GetNumberOfTracks()
    ? cslf::NameOfRole(this->Internal->Reader->GetHeader().Tracks[track].Kind.Role)
    : nullptr;
}

vtkTypeInt64 vtkCSLFDecoder::GetTrackBytes(int track)
{
  if (track < 0 || track >= this->GetNumberOfTracks())
  {
    return 0;
  }
  if (this->Internal->TrackBytes.empty())
  {
    const cslf::AVLogSilence silence;
    this->Internal->TrackBytes = this->Internal->Reader->CountBytes();
  }
  return this->Internal->TrackBytes[track];
}

vtkIdType vtkCSLFDecoder::GetNumberOfMissingViewpoints() const
{
  return this->Internal->Missing->GetNumberOfValues();
}

vtkIdTypeArray* vtkCSLFDecoder::GetMissingViewpoints() const
{
  return this->Internal->Missing;
}

bool vtkCSLFDecoder::ReportProgress(double progress)
{
  this->UpdateProgress(progress);
  return !this->GetAbortExecute();
}

int vtkCSLFDecoder::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->Internal->SetReader(nullptr);
  this->Internal->SetMissing({});
  if (!this->FileName || !*this->FileName)
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("There is no file name.");
    return 0;
  }
  const cslf::AVLogSilence silence;
  cslf::OpenFailure failure;
  this->Internal->SetReader(cslf::FieldReader::Open(this->FileName, failure));
  if (!this->Internal->Reader)
  {
    this->SetErrorCode(failure.Code);
    vtkErrorMacro("Cannot read " << this->FileName << ": " << failure.Text << ".");
    return 0;
  }
  this->Internal->Reader->GetViewpoints().SetSize(this->CacheSize);
  int extent[6];
  this->Internal->Reader->GetHeader().Field.Grid.GetWholeExtent(extent);
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  outInfo->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  outInfo->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
  outInfo->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  outInfo->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  cslf::SplitAlongZ(outInfo);
  const cslf::Description& field = this->Internal->Reader->GetHeader().Field;
  vtkDataObject::SetPointDataActiveScalarInfo(outInfo, field.FindChannel(cslf::ColorName)->Type, 4);
  return 1;
}

int vtkCSLFDecoder::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->Internal->SetMissing({});
  if (!this->Internal->Reader)
  {
    return 0;
  }
  const cslf::Description& field = this->Internal->Reader->GetHeader().Field;
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);
  int asked[6];
  int extent[6];
  outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), asked);
  this->Internal->GetExtent(asked[4], asked[5], extent);
  output->SetExtent(extent);

  const auto color =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(field.FindChannel(cslf::ColorName)->Type));
  color->SetName(cslf::ColorName);
  color->SetNumberOfComponents(4);
  color->SetNumberOfTuples(output->GetNumberOfPoints());
  output->GetPointData()->SetScalars(color);
  vtkNew<vtkUnsignedShortArray> depth;
  const bool hasDepth = field.FindChannel(cslf::DepthName) != nullptr;
  if (hasDepth)
  {
    depth->SetName(cslf::DepthName);
    depth->SetNumberOfTuples(output->GetNumberOfPoints());
    output->GetPointData()->AddArray(depth);
  }
  output->GetFieldData()->PassData(this->Internal->Field);

  const cslf::AVLogSilence silence;
  this->Internal->SetMissing(this->Internal->Reader->Read(extent[4], extent[5],
    static_cast<unsigned char*>(color->GetVoidPointer(0)),
    hasDepth ? depth->GetPointer(0) : nullptr,
    [this](double progress) { return this->ReportProgress(progress); }));
  if (this->GetAbortExecute())
  {
    output->Initialize();
    return 1;
  }
  if (this->GetNumberOfMissingViewpoints() > 0 && !this->ReportDamage())
  {
    output->Initialize();
    return 0;
  }
  return 1;
}

bool vtkCSLFDecoder::ReportDamage()
{
  const int slices = this->Internal->Reader->GetHeader().Field.Grid.GetSlices();
  const bool isKnown = this->Internal->Damage.has_value();
  if (!isKnown)
  {
    this->Internal->Damage =
      this->Internal->Reader->FindMissing([this](double) { return !this->GetAbortExecute(); });
  }
  // What the checksums let pass may still be found when it is decoded.
  const vtkIdType* missing = this->Internal->Missing->GetPointer(0);
  std::vector<int> all;
  std::set_union(this->Internal->Damage->begin(), this->Internal->Damage->end(), missing,
    missing + this->GetNumberOfMissingViewpoints(), std::back_inserter(all));
  const bool isNew = !isKnown || all.size() > this->Internal->Damage->size();
  this->Internal->Damage = all;
  if (static_cast<int>(all.size()) == slices)
  {
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    vtkErrorMacro("Cannot read " << this->FileName
                                 << ": its video is damaged or cut short, none of the " << slices
                                 << " viewpoints can be read.");
    return false;
  }
  if (isNew)
  {
    this->WarnOfDamage();
  }
  return true;
}

void vtkCSLFDecoder::WarnOfDamage()
{
  constexpr std::size_t named = 5;
  const std::vector<int>& missing = *this->Internal->Damage;
  std::ostringstream list;
  for (std::size_t k = 0; k < std::min(missing.size(), named); ++k)
  {
    list << (k > 0 ? ", " : "") << missing[k];
  }
  vtkWarningMacro(<< this->FileName << " is damaged: " << missing.size() << " of "
                  << this->Internal->Reader->GetHeader().Field.Grid.GetSlices()
                  << " viewpoints are missing and left empty (z = " << list.str()
                  << (missing.size() > named ? ", ..." : "") << ").");
}

bool vtkCSLFDecoder::UpdateReader()
{
  this->UpdateInformation();
  return this->Internal->Reader != nullptr;
}

vtkIdType vtkCSLFDecoder::FindMissingViewpoints()
{
  if (!this->UpdateReader())
  {
    return -1;
  }
  this->SetAbortExecute(0);
  const cslf::AVLogSilence silence;
  this->Internal->SetMissing(this->Internal->Reader->FindMissing(
    [this](double progress) { return this->ReportProgress(progress); }));
  return this->GetAbortExecute() ? -1 : this->GetNumberOfMissingViewpoints();
}

void vtkCSLFDecoder::SetCacheSize(vtkTypeInt64 bytes)
{
  this->CacheSize = std::max<vtkTypeInt64>(bytes, 0);
  if (this->Internal->Reader)
  {
    this->Internal->Reader->GetViewpoints().SetSize(this->CacheSize);
  }
}

bool vtkCSLFDecoder::RequireViewpoint(vtkIdType z)
{
  if (!this->UpdateReader())
  {
    return false;
  }
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->Internal->HasViewpoint(z))
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro("There is no viewpoint " << z << " in " << this->FileName << ".");
    return false;
  }
  return true;
}

bool vtkCSLFDecoder::IsViewpointDamaged(vtkIdType z)
{
  return !this->RequireViewpoint(z) ||
    this->Internal->Reader->GetViewpoints().Get(static_cast<int>(z))->IsMissing;
}

bool vtkCSLFDecoder::GetViewpoint(vtkIdType z, vtkImageData* image)
{
  image->Initialize();
  if (!this->RequireViewpoint(z))
  {
    return false;
  }
  const auto viewpoint = this->Internal->Reader->GetViewpoints().Get(static_cast<int>(z));
  if (viewpoint->IsMissing)
  {
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    vtkErrorMacro("Viewpoint " << z << " of " << this->FileName << " is damaged.");
    return false;
  }
  int extent[6];
  this->Internal->GetExtent(z, z, extent);
  image->SetExtent(extent);
  image->GetPointData()->SetScalars(viewpoint->Color);
  if (viewpoint->Depth)
  {
    image->GetPointData()->AddArray(viewpoint->Depth);
  }
  image->GetFieldData()->PassData(this->Internal->Field);
  return true;
}

void vtkCSLFDecoder::Prefetch(vtkIdTypeArray* viewpoints)
{
  if (!this->UpdateReader())
  {
    return;
  }
  std::vector<int> slices;
  for (vtkIdType k = 0; viewpoints && k < viewpoints->GetNumberOfValues(); ++k)
  {
    const vtkIdType z = viewpoints->GetValue(k);
    if (this->Internal->HasViewpoint(z))
    {
      slices.push_back(static_cast<int>(z));
    }
  }
  this->Internal->Reader->GetViewpoints().Prefetch(slices);
}

bool vtkCSLFDecoder::IsViewpointReady(vtkIdType z)
{
  return this->Internal->HasViewpoint(z) &&
    this->Internal->Reader->GetViewpoints().Has(static_cast<int>(z));
}

void vtkCSLFDecoder::WaitForPrefetch()
{
  if (this->Internal->Reader)
  {
    this->Internal->Reader->GetViewpoints().Wait();
  }
}

void vtkCSLFDecoder::GetViewpointsInFileOrder(vtkIdTypeArray* viewpoints)
{
  viewpoints->Reset();
  if (this->UpdateReader())
  {
    for (int slice : this->Internal->Reader->GetHeader().Slices)
    {
      viewpoints->InsertNextValue(slice);
    }
  }
}

void vtkCSLFDecoder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "CacheSize: " << this->CacheSize << "\n";
  os << indent << "Description: " << this->GetDescription() << "\n";
  os << indent << "MissingViewpoints: " << this->GetNumberOfMissingViewpoints() << "\n";
}
