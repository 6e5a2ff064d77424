// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFImageReader.h"

#include "CubeMaps/cslfCubeMapFiles.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <optional>
#include <vector>

struct vtkCSLFImageReader::Internal
{
  std::optional<cslf::CubeMapFolder> Folder;
  std::string Text;
  std::vector<int> Missing;
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

/// Whether the images of any viewpoint of the slab fit the description, before memory is taken
/// for what the description claims.
bool ProbeSlab(const char* folder, const cslf::Description& description, const cslf::Slab& slab)
{
  for (int slice = slab.First; slice <= slab.Last; ++slice)
  {
    const auto isThere = [&](const cslf::Channel& channel)
    { return cslf::ProbeCubeMap(folder, description.Grid, channel, slice); };
    if (std::all_of(description.Channels.begin(), description.Channels.end(), isThere))
    {
      return true;
    }
  }
  return false;
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

/// Reads the slab into the image, which holds it; returns the viewpoints that cannot be read.
std::vector<int> ReadSlab(const char* folder, const cslf::Description& description,
  const cslf::Slab& slab, vtkImageData* image)
{
  std::vector<unsigned char*> arrays;
  for (const cslf::Channel& channel : description.Channels)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(channel.Name.c_str());
    arrays.push_back(static_cast<unsigned char*>(array->GetVoidPointer(0)));
  }
  const std::size_t texels =
    static_cast<std::size_t>(description.Grid.GetStripWidth()) * description.Grid.GetResolution();
  std::vector<char> isRead(slab.GetCount());
  vtkSMPTools::For(slab.First, slab.Last + 1, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int slice = static_cast<int>(begin); slice < end; ++slice)
      {
        const std::size_t offset = (slice - slab.First) * texels;
        std::vector<unsigned char*> targets;
        for (std::size_t c = 0; c < arrays.size(); ++c)
        {
          targets.push_back(arrays[c] + offset * cslf::TexelBytes(description.Channels[c]));
        }
        isRead[slice - slab.First] = ReadViewpoint(folder, description, slice, targets, texels);
      }
    });

  std::vector<int> missing;
  for (int slice = slab.First; slice <= slab.Last; ++slice)
  {
    if (!isRead[slice - slab.First])
    {
      missing.push_back(slice);
    }
  }
  return missing;
}
}

vtkStandardNewMacro(vtkCSLFImageReader);

vtkCSLFImageReader::vtkCSLFImageReader()
  : Internals(new Internal)
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
  return fileName && cslf::ReadCubeMapDescription(fileName, error) ? 1 : 0;
}

const char* vtkCSLFImageReader::GetDescription()
{
  return this->Internals->Text.c_str();
}

int vtkCSLFImageReader::GetNumberOfMissingViewpoints()
{
  return static_cast<int>(this->Internals->Missing.size());
}

int vtkCSLFImageReader::GetMissingViewpoint(int index)
{
  const bool isInside = index >= 0 && index < this->GetNumberOfMissingViewpoints();
  return isInside ? this->Internals->Missing[index] : -1;
}

bool vtkCSLFImageReader::ReadDescription()
{
  this->Internals->Folder.reset();
  this->Internals->Text.clear();
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("A file name must be set.");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return false;
  }
  std::string error;
  this->Internals->Folder = cslf::ReadCubeMapDescription(this->FileName, error);
  if (!this->Internals->Folder)
  {
    vtkErrorMacro(<< error);
    this->SetErrorCode(vtkErrorCode::UnrecognizedFileTypeError);
    return false;
  }
  this->Internals->Text = this->Internals->Folder->Field.ToText();
  return true;
}

int vtkCSLFImageReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  if (!this->ReadDescription())
  {
    return 0;
  }
  const cslf::CubeMapFolder& folder = *this->Internals->Folder;
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
  this->Internals->Missing.clear();
  if (!this->Internals->Folder)
  {
    return 0;
  }
  const cslf::Description& description = this->Internals->Folder->Field;
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
    this->Internals->Missing = ReadSlab(this->FileName, description, slab, image);
  }
  const int missing = this->GetNumberOfMissingViewpoints();
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
                    << " are missing or damaged, the first of them " << this->GetMissingViewpoint(0)
                    << "; they are left empty.");
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
