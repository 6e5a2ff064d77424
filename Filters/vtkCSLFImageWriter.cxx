// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFImageWriter.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfParallelFor.h"

#include "CubeMaps/cslfCubeMapFiles.h"
#include "Files/cslfAtomicFile.h"
#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfVTKCompatibility.h"

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkObjectFactory.h>

#include <filesystem>
#include <mutex>
#include <system_error>

namespace
{
/// The share of reading the input in the progress.
constexpr double ReadShare = 0.5;

/// The size of the files in a folder, in bytes.
double CountBytes(const std::string& folder)
{
  double bytes = 0.0;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
  {
    bytes += static_cast<double>(entry.file_size(ignored));
  }
  return bytes;
}

/// Whether the disk has enough space for the remaining viewpoints, judged by the first ones. Others
/// may take less, so half of that is enough.
bool HasRoom(const std::string& folder, int done, int all, std::string& error)
{
  const double bytes = CountBytes(folder) / done * (all - done);
  return cslf::HasRoom(folder, bytes, 0.5 * bytes, error);
}

/// False after an error, and if `progress` returns false.
bool WriteSlab(const cslf::FieldStream& stream, const cslf::Slab& slab, const std::string& folder,
  const cslf::Progress& progress, std::string& error)
{
  const cslf::Description& description = stream.GetDescription();
  std::mutex errorMutex;
  const bool isDone = cslf::ParallelFor(slab.First, slab.Last + 1, progress,
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
  return isDone && error.empty();
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
  cslf::ResetAbort(this);
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
  const std::string name = this->FileName;
  cslf::AtomicFolder whole(name, cslf::ListCubeMapFiles);
  std::string error;
  if (!cslf::Guard([&] { return whole.Open("a light field", error); }, error))
  {
    vtkErrorMacro(<< name << " was not written: " << error << ".");
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    return 0;
  }
  this->InvokeEvent(vtkCommand::StartEvent);
  this->UpdateProgress(0.0);
  std::string warning;
  const bool isWritten = cslf::Guard([&]
    { return this->WriteSlabs(whole.GetTemporaryName(), error) && whole.Publish(warning, error); },
    error);
  if (!isWritten && !error.empty())
  {
    error.erase(error.find_last_not_of('.') + 1);
    vtkErrorMacro(<< name << " was not written: " << error << cslf::DescribeShortage(name) << ".");
  }
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  this->InvokeEvent(vtkCommand::EndEvent);
  this->SetErrorCode(isWritten ? vtkErrorCode::NoError : vtkErrorCode::UnknownError);
  return isWritten ? 1 : 0;
}

bool vtkCSLFImageWriter::WriteSlabs(const std::string& folder, std::string& error)
{
  cslf::Phase phase(this, "Writing images");
  double done = 0.0;
  double next = 0.0;
  const cslf::PipelineWatch watch(this->GetInputConnection(0, 0),
    [&](vtkAlgorithm* producer)
    {
      const double read = ReadShare * producer->GetProgress();
      return phase.ReportFor(producer, done + (next - done) * read);
    });
  const auto report = [&](double share)
  { return phase.Report(done + (next - done) * (ReadShare + (1.0 - ReadShare) * share)); };
  cslf::FieldStream stream(this->GetInputConnection(0, 0));
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
    done = static_cast<double>(k) / static_cast<double>(slabs.size());
    next = static_cast<double>(k + 1) / static_cast<double>(slabs.size());
    isGood = stream.Read(slabs[k]);
    if (isGood && k == 0)
    {
      cslf::Description description = stream.GetDescription();
      description.Measured.reset(); // with the geometry, which folders do not have
      isGood = cslf::CheckCubeMapChannels(description, error) &&
        cslf::WriteCubeMapDescription(folder, { description, whole }, error);
    }
    isGood = isGood && WriteSlab(stream, slabs[k], folder, report, error) &&
      (k > 0 || HasRoom(folder, slabs[k].GetCount(), whole.GetCount(), error));
  }
  if (!isGood && error.empty() && !cslf::IsAborted(this))
  {
    error = stream.GetError();
  }
  return isGood;
}

void vtkCSLFImageWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}
