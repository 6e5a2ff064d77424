// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFImageReader.h"

#include "CubeMaps/cslfCubeMapFiles.h"
#include "Files/cslfFileSystem.h"
#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfParallelFor.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "cslfJoin.h"

#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <optional>
#include <sstream>
#include <vector>

class vtkCSLFImageReader::Internals
{
public:
  std::optional<cslf::CubeMapFolder> Folder;
  std::string Text;

  /// Those of the last update. Never changed, because callers keep it.
  vtkSmartPointer<vtkIdTypeArray> Missing = vtkSmartPointer<vtkIdTypeArray>::New();
};

namespace
{
/// Reads a viewpoint's channels into the image, or fills them if one cannot be read.
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

/// Whether all images of a viewpoint exist and fit the description.
bool ProbeViewpoint(const char* folder, const cslf::Description& description, int slice)
{
  return std::all_of(description.Channels.begin(), description.Channels.end(),
    [&](const cslf::Channel& channel)
    { return cslf::ProbeCubeMap(folder, description.Grid, channel, slice); });
}

/// The number of the slab's viewpoints that have images. It is checked before memory is allocated
/// for what the description claims. 0 if none of them can be read.
vtkIdType CountImages(
  const char* folder, const cslf::Description& description, const cslf::Slab& slab)
{
  vtkIdType count = 0;
  bool isAnyThere = false;
  for (int slice = slab.First; slice <= slab.Last; ++slice)
  {
    const bool exists = std::all_of(description.Channels.begin(), description.Channels.end(),
      [&](const cslf::Channel& channel)
      {
        std::error_code ignored;
        return std::filesystem::exists(
          cslf::ToPath(cslf::CubeMapFileName(folder, channel, slice)), ignored);
      });
    count += exists ? 1 : 0;
    isAnyThere = isAnyThere || (exists && ProbeViewpoint(folder, description, slice));
  }
  return isAnyThere ? count : 0;
}

/// The viewpoints of a slab for which `isThere(slice)` is false. Calls it in parallel. Throws
/// Aborted.
template <typename IsThere>
vtkSmartPointer<vtkIdTypeArray> CollectMissing(
  const cslf::Slab& slab, const cslf::Progress& progress, IsThere isThere)
{
  std::vector<char> found(slab.GetCount());
  cslf::ParallelFor(slab.First, slab.Last + 1, cslf::OrAbort(progress),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int slice = static_cast<int>(begin); slice < end; ++slice)
      {
        found[slice - slab.First] = isThere(slice);
      }
    });
  auto missing = vtkSmartPointer<vtkIdTypeArray>::New();
  for (int slice = slab.First; slice <= slab.Last; ++slice)
  {
    if (!found[slice - slab.First])
    {
      missing->InsertNextValue(slice);
    }
  }
  return missing;
}

/// Reads the slab into the image, which contains only the slab. Returns the unreadable viewpoints.
/// Throws Aborted.
vtkSmartPointer<vtkIdTypeArray> ReadSlab(const char* folder, const cslf::Description& description,
  const cslf::Slab& slab, const cslf::Progress& progress, vtkImageData* image)
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
      targets.push_back(arrays[c] + offset * description.Channels[c].GetTexelBytes());
    }
    return ReadViewpoint(folder, description, slice, targets, texels);
  };
  return CollectMissing(slab, progress, read);
}
}

vtkStandardNewMacro(vtkCSLFImageReader);
cslfGuardedRequestMacro(vtkCSLFImageReader);

vtkCSLFImageReader::vtkCSLFImageReader()
  : AllowMissing(cslf::options::AllowMissing.Default)
  , Internal(new Internals)
{
  this->SetNumberOfInputPorts(0);
}

vtkCSLFImageReader::~vtkCSLFImageReader()
{
  this->SetFileName(nullptr);
}

int vtkCSLFImageReader::CanReadFile(const char* fileName)
{
  try
  {
    std::string error;
    return fileName && cslf::ReadCubeMapDescription(fileName, error) ? 3 : 0;
  }
  catch (const std::exception&)
  {
    return 0;
  }
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

// Does work that may run out of memory. No exception leaves VTK's methods: it becomes one error.
// False without an error if aborted.
bool vtkCSLFImageReader::Guard(const std::function<bool()>& work)
{
  std::string problem;
  const bool isDone = cslf::Guard(
    [&work]
    {
      try
      {
        return work();
      }
      catch (const cslf::Aborted&)
      {
        return false;
      }
    },
    problem);
  return problem.empty() ? isDone
                         : this->Fail(vtkErrorCode::UnknownError,
                             "Cannot read " + std::string(this->FileName) + ": " + problem + ".");
}

bool vtkCSLFImageReader::Fail(unsigned long code, const std::string& text)
{
  this->SetErrorCode(code);
  vtkErrorMacro(<< text);
  return false;
}

vtkIdType vtkCSLFImageReader::FindMissingViewpoints()
{
  cslf::ResetAbort(this);
  this->UpdateProgress(0.0);
  const bool isChecked = this->ReadDescription() &&
    this->Guard(
      [this]
      {
        const cslf::CubeMapFolder& folder = *this->Internal->Folder;
        cslf::Phase phase(this, "Checking viewpoints");
        this->Internal->Missing = CollectMissing(
          folder.Slices, [&phase](double share) { return phase.Report(share); },
          [&](int slice) { return ProbeViewpoint(this->FileName, folder.Field, slice); });
        return true;
      });
  return isChecked ? this->GetNumberOfMissingViewpoints() : -1;
}

bool vtkCSLFImageReader::ReadDescription()
{
  this->Internal->Folder.reset();
  this->Internal->Text.clear();
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->FileName || !*this->FileName)
  {
    return this->Fail(vtkErrorCode::NoFileNameError, "A file name must be set.");
  }
  return this->Guard(
    [this]
    {
      std::string error;
      this->Internal->Folder = cslf::ReadCubeMapDescription(this->FileName, error);
      if (!this->Internal->Folder)
      {
        return this->Fail(vtkErrorCode::UnrecognizedFileTypeError, error);
      }
      for (const std::string& name : this->Internal->Folder->Field.Unknown)
      {
        vtkWarningMacro("The channel \""
          << cslf::MakePrintable(name) << "\" of " << this->FileName
          << " has a type that this version does not support, and is left out.");
      }
      this->Internal->Text = this->Internal->Folder->Field.ToText();
      return true;
    });
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
  cslf::SetFieldInformation(information, extent);
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
  this->SetErrorCode(vtkErrorCode::NoError);
  this->Internal->Missing = vtkSmartPointer<vtkIdTypeArray>::New();
  if (!this->Internal->Folder)
  {
    return 0;
  }
  int update[6];
  outputVector->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), update);
  vtkImageData* image = vtkImageData::GetData(outputVector);
  const bool isRead = this->Guard([&] { return this->ReadRange(update[4], update[5], image); });
  if (!isRead)
  {
    image->Initialize();
  }
  return isRead || cslf::IsAborted(this) ? 1 : 0;
}

bool vtkCSLFImageReader::ReadRange(int first, int last, vtkImageData* image)
{
  const cslf::Description& field = this->Internal->Folder->Field;
  std::string error;
  const auto now = cslf::ReadCubeMapDescription(this->FileName, error);
  if (!now || now->Field.ToText() != field.ToText())
  {
    return this->Fail(vtkErrorCode::FileFormatError,
      std::string("The folder ") + this->FileName +
        " was replaced while it was being read. Call Modified to read it from the beginning.");
  }
  const cslf::Slab slab{ first, last };
  const vtkIdType there = CountImages(this->FileName, field, slab);
  if (there > 0 && cslf::AreEnough(field, there, slab.GetCount()))
  {
    cslf::AllocateSlices(field, first, last, image);
    field.WriteTo(image->GetFieldData());
    cslf::Phase phase(this, "Reading viewpoints");
    this->Internal->Missing = ReadSlab(
      this->FileName, field, slab, [&phase](double share) { return phase.Report(share); }, image);
    cslf::SetMissing(this->Internal->Missing, image);
  }
  else
  {
    this->Internal->Missing = CollectMissing(
      slab, [](double) { return true; }, [](int) { return false; });
  }
  const vtkIdType missing = this->GetNumberOfMissingViewpoints();
  std::ostringstream text;
  if (missing == slab.GetCount())
  {
    text << (there > 0 && there < slab.GetCount() ? "Too few" : "None") << " of the viewpoints "
         << first << " to " << last << " of " << this->FileName << " can be read.";
    return this->Fail(vtkErrorCode::FileFormatError, text.str());
  }
  if (missing > 0)
  {
    text << missing << " of " << slab.GetCount() << " viewpoints of " << this->FileName
         << " are missing or damaged, the first of them "
         << this->GetMissingViewpoints()->GetValue(0);
    if (!this->AllowMissing)
    {
      return this->Fail(vtkErrorCode::PrematureEndOfFileError, text.str() + ".");
    }
    vtkWarningMacro(<< text.str() << "; they are left empty.");
  }
  return true;
}

void vtkCSLFImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "AllowMissing: " << this->AllowMissing << "\n";
  os << indent << "Description: " << this->GetDescription() << "\n";
  os << indent << "NumberOfMissingViewpoints: " << this->GetNumberOfMissingViewpoints() << "\n";
}
