// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFImageReader.h"

#include "CubeMaps/cslfCubeMapFiles.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <optional>
#include <vector>

class vtkCSLFImageReader::Internals
{
public:
  std::optional<cslf::CubeMapFolder> Folder;
  std::string Text;
  vtkNew<vtkIdTypeArray> Missing;
};

namespace
{
/// Reads a viewpoint's channels into the image, or fills them where one cannot be read.
bool ReadViewpoint(const char* folder, const cslf::Description& description, int slice,
  const std::vector<unsigned char*>& targets, std::size_t texels)
{
  bool isRead = true;
  for (std::size_t c = 0; c < targets.size() && isRead; ++c)
  {
    isRead =
      cslf::ReadCubeMap(folder, description.Grid, description.Channels[c], slice, targets[c]);
  }
  for (std::size_t c = 0; c < targets.size() && !isRead; ++c)
  {
    cslf::FillEmpty(description.Channels[c], targets[c], texels);
  }
  return isRead;
}

/// Whether all images of a viewpoint are there and fit the description.
bool ProbeViewpoint(const char* folder, const cslf::Description& description, int slice)
{
  return std::all_of(description.Channels.begin(), description.Channels.end(),
    [&](const cslf::Channel& channel)
    { return cslf::ProbeCubeMap(folder, description.Grid, channel, slice); });
}

/// Whether any viewpoint of the slab is there, to be known before memory is taken for what the
/// description claims.
bool ProbeSlab(const char* folder, const cslf::Description& description, const cslf::Slab& slab)
{
  for (int slice = slab.First; slice <= slab.Last; ++slice)
  {
    if (ProbeViewpoint(folder, description, slice))
    {
      return true;
    }
  }
  return false;
}

/// The viewpoints of a slab for which `isThere(slice)` does not hold; asked in parallel.
template <typename IsThere>
void CollectMissing(const cslf::Slab& slab, IsThere isThere, vtkIdTypeArray* missing)
{
  std::vector<char> found(slab.GetCount());
  vtkSMPTools::For(slab.First, slab.Last + 1, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int slice = static_cast<int>(begin); slice < end; ++slice)
      {
        found[slice - slab.First] = isThere(slice);
      }
    });
  missing->Reset();
  for (int slice = slab.First; slice <= slab.Last; ++slice)
  {
    if (!found[slice - slab.First])
    {
      missing->InsertNextValue(slice);
    }
  }
}

void Allocate(const cslf::Description& description, const int extent[6], vtkImageData* image)
{
  image->SetExtent(const_cast<int*>(extent));
  image->SetSpacing(1.0, 1.0, 1.0);
  image->SetOrigin(0.0, 0.0, 0.0);
  for (const cslf::Channel& channel : description.Channels)
  {
    auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(channel.Type));
    array->SetName(channel.Name.c_str());
    array->SetNumberOfComponents(channel.Components);
    array->SetNumberOfTuples(image->GetNumberOfPoints());
    image->GetPointData()->AddArray(array);
  }
  if (!description.Channels.empty())
  {
    image->GetPointData()->SetActiveScalars(description.Channels[0].Name.c_str());
  }
  description.WriteTo(image->GetFieldData());
}

/// Reads the slab into the image, which holds just that, and collects what cannot be read.
void ReadSlab(const char* folder, const cslf::Description& description, const cslf::Slab& slab,
  vtkImageData* image, vtkIdTypeArray* missing)
{
  std::vector<unsigned char*> arrays;
  for (const cslf::Channel& channel : description.Channels)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(channel.Name.c_str());
    arrays.push_back(static_cast<unsigned char*>(array->GetVoidPointer(0)));
  }
  const std::size_t texels =
    static_cast<std::size_t>(description.Grid.GetStripWidth()) * description.Grid.GetResolution();
  const auto read = [&](int slice)
  {
    const std::size_t offset = (slice - slab.First) * texels;
    std::vector<unsigned char*> targets;
    for (std::size_t c = 0; c < arrays.size(); ++c)
    {
      targets.push_back(arrays[c] + offset * cslf::TexelBytes(description.Channels[c]));
    }
    return ReadViewpoint(folder, description, slice, targets, texels);
  };
  CollectMissing(slab, read, missing);
}
}

vtkStandardNewMacro(vtkCSLFImageReader);

vtkCSLFImageReader::vtkCSLFImageReader()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
}

vtkCSLFImageReader::~vtkCSLFImageReader()
{
  this->SetFileName(nullptr);
}

int vtkCSLFImageReader::CanReadFile(const char* fileName)
{
  std::string error;
  return fileName && cslf::ReadCubeMapDescription(fileName, error) ? 3 : 0;
}

const char* vtkCSLFImageReader::GetDescription() const
{
  return this->Internal->Text.c_str();
}

vtkIdType vtkCSLFImageReader::GetNumberOfMissingViewpoints() const
{
  return this->Internal->Missing->GetNumberOfValues();
}

vtkIdTypeArray* vtkCSLFImageReader::GetMissingViewpoints() const
{
  return this->Internal->Missing;
}

vtkIdType vtkCSLFImageReader::FindMissingViewpoints()
{
  if (!this->ReadDescription())
  {
    return -1;
  }
  const cslf::CubeMapFolder& folder = *this->Internal->Folder;
  CollectMissing(
    folder.Slices, [&](int slice) { return ProbeViewpoint(this->FileName, folder.Field, slice); },
    this->Internal->Missing);
  return this->GetNumberOfMissingViewpoints();
}

bool vtkCSLFImageReader::ReadDescription()
{
  this->Internal->Folder.reset();
  this->Internal->Text.clear();
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("A file name must be set.");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return false;
  }
  std::string error;
  this->Internal->Folder = cslf::ReadCubeMapDescription(this->FileName, error);
  if (!this->Internal->Folder)
  {
    vtkErrorMacro(<< error);
    this->SetErrorCode(vtkErrorCode::UnrecognizedFileTypeError);
    return false;
  }
  this->Internal->Text = this->Internal->Folder->Field.ToText();
  return true;
}

int vtkCSLFImageReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->ReadDescription())
  {
    return 0;
  }
  const cslf::CubeMapFolder& folder = *this->Internal->Folder;
  int extent[6];
  folder.Field.Grid.GetWholeExtent(extent);
  extent[4] = folder.Slices.First;
  extent[5] = folder.Slices.Last;
  vtkInformation* information = outputVector->GetInformationObject(0);
  information->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  information->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
  information->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  information->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  if (!folder.Field.Channels.empty())
  {
    const cslf::Channel& first = folder.Field.Channels[0];
    vtkDataObject::SetPointDataActiveScalarInfo(information, first.Type, first.Components);
  }
  return 1;
}

int vtkCSLFImageReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  this->Internal->Missing->Reset();
  if (!this->Internal->Folder)
  {
    return 0;
  }
  const cslf::Description& description = this->Internal->Folder->Field;
  vtkInformation* information = outputVector->GetInformationObject(0);
  int extent[6];
  int update[6];
  description.Grid.GetWholeExtent(extent);
  information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), update);
  const cslf::Slab slab{ update[4], update[5] };
  extent[4] = slab.First;
  extent[5] = slab.Last;
  const bool isAnyThere = ProbeSlab(this->FileName, description, slab);
  if (isAnyThere)
  {
    vtkImageData* image = vtkImageData::GetData(outputVector);
    Allocate(description, extent, image);
    ReadSlab(this->FileName, description, slab, image, this->Internal->Missing);
  }
  const vtkIdType missing = this->GetNumberOfMissingViewpoints();
  if (!isAnyThere || missing == slab.GetCount())
  {
    vtkErrorMacro("None of the viewpoints " << slab.First << " to " << slab.Last << " of "
                                            << this->FileName << " can be read.");
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    return 0;
  }
  if (missing > 0)
  {
    vtkWarningMacro(<< missing << " of " << slab.GetCount() << " viewpoints of " << this->FileName
                    << " are missing or damaged, the first of them "
                    << this->GetMissingViewpoints()->GetValue(0) << "; they are left empty.");
  }
  return 1;
}

void vtkCSLFImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Description: " << this->GetDescription() << "\n";
  os << indent << "NumberOfMissingViewpoints: " << this->GetNumberOfMissingViewpoints() << "\n";
}
