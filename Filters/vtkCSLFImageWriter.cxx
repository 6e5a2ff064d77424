// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFImageWriter.h"

#include "CubeMaps/cslfCubeMapFiles.h"
#include "Pipeline/cslfSlabs.h"

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>

#include <filesystem>
#include <mutex>

namespace fs = std::filesystem;

namespace
{
/// Whether a folder may be replaced: it is not there, is empty, or is a light field.
bool CheckReplaceable(const fs::path& folder, std::string& error)
{
  std::error_code failure;
  if (!fs::exists(folder, failure))
  {
    return true;
  }
  if (!fs::is_directory(folder, failure))
  {
    error = folder.string() + " is there already and is no folder.";
    return false;
  }
  std::string ignored;
  if (fs::is_empty(folder, failure) || cslf::ReadCubeMapDescription(folder.string(), ignored))
  {
    return true;
  }
  error = "The folder " + folder.string() + " holds other things than a light field.";
  return false;
}

bool MakePartial(const fs::path& partial, std::string& error)
{
  std::error_code failure;
  fs::remove_all(partial, failure);
  if (!fs::create_directory(partial, failure))
  {
    error = "Cannot make the folder " + partial.string() + ": " + failure.message() + ".";
    return false;
  }
  return true;
}

/// Puts the finished folder in the place of an earlier one.
bool Replace(const fs::path& partial, const fs::path& folder, std::string& error)
{
  std::error_code failure;
  fs::path replaced = folder;
  replaced += ".replaced";
  fs::remove_all(replaced, failure);
  if (fs::exists(folder, failure))
  {
    fs::rename(folder, replaced, failure);
  }
  if (!failure)
  {
    fs::rename(partial, folder, failure);
  }
  if (failure)
  {
    error = "Cannot rename " + partial.string() + " to " + folder.string() + ": " +
      failure.message() + ".";
    return false;
  }
  fs::remove_all(replaced, failure);
  return true;
}

bool WriteSlab(
  const cslf::SlabStream& stream, const cslf::Slab& slab, const char* folder, std::string& error)
{
  const cslf::Description& description = stream.GetDescription();
  std::mutex errorMutex;
  vtkSMPTools::For(slab.First, slab.Last + 1, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int slice = static_cast<int>(begin); slice < end; ++slice)
      {
        for (const cslf::Channel& channel : description.Channels)
        {
          std::string failure;
          if (!cslf::WriteCubeMap(
                folder, description.Grid, channel, slice, stream.GetSlice(channel, slice), failure))
          {
            const std::lock_guard<std::mutex> lock(errorMutex);
            error = failure;
          }
        }
      }
    });
  return error.empty();
}
}

vtkStandardNewMacro(vtkCSLFImageWriter);

vtkCSLFImageWriter::vtkCSLFImageWriter()
{
  this->SetNumberOfOutputPorts(0);
}

vtkCSLFImageWriter::~vtkCSLFImageWriter()
{
  this->SetFileName(nullptr);
}

int vtkCSLFImageWriter::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  this->AbortExecute = 0;
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("A file name must be set.");
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    return 0;
  }
  if (this->GetNumberOfInputConnections(0) == 0)
  {
    vtkErrorMacro("There is no input.");
    this->SetErrorCode(vtkErrorCode::UnknownError);
    return 0;
  }
  // Without a separator at the end, which would put the partial folder inside.
  const fs::path name = fs::path(this->FileName).lexically_normal();
  const fs::path folder = name.has_filename() ? name : name.parent_path();
  fs::path partial = folder;
  partial += ".partial";
  std::string error;
  if (!CheckReplaceable(folder, error) || !CheckReplaceable(partial, error) ||
    !MakePartial(partial, error))
  {
    vtkErrorMacro(<< error);
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    return 0;
  }

  this->InvokeEvent(vtkCommand::StartEvent);
  bool isWritten = this->WriteSlabs(partial.string().c_str());
  if (isWritten && !Replace(partial, folder, error))
  {
    vtkErrorMacro(<< error);
    isWritten = false;
  }
  this->InvokeEvent(vtkCommand::EndEvent);
  if (!isWritten)
  {
    std::error_code failure;
    fs::remove_all(partial, failure);
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
  return isWritten ? 1 : 0;
}

bool vtkCSLFImageWriter::WriteSlabs(const char* folder)
{
  cslf::SlabStream stream(this->GetInputConnection(0, 0));
  std::string error;
  bool isGood = stream.Open();
  const cslf::Slab& whole = stream.GetWhole();
  std::vector<cslf::Slab> slabs;
  if (isGood)
  {
    slabs = stream.PlanSlabs([](int) { return true; });
    stream.Announce(slabs);
  }
  for (std::size_t k = 0; isGood && k < slabs.size(); ++k)
  {
    isGood = stream.Read(slabs[k]);
    if (isGood && k == 0)
    {
      const cslf::Description& description = stream.GetDescription();
      isGood = cslf::CheckCubeMapChannels(description, error) &&
        cslf::WriteCubeMapDescription(folder, { description, whole }, error);
    }
    isGood = isGood && WriteSlab(stream, slabs[k], folder, error);
    this->UpdateProgress((k + 1.0) / static_cast<double>(slabs.size()));
    isGood = isGood && !this->AbortExecute;
  }
  if (!isGood)
  {
    error = error.empty() ? stream.GetError() : error;
    if (!error.empty())
    {
      vtkErrorMacro(<< error);
    }
  }
  return isGood;
}

void vtkCSLFImageWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
