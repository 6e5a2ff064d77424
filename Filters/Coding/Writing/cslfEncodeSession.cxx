// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfEncodeSession.h"

#include "Coding/Frames/cslfColorFrames.h"
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Files/cslfFileSystem.h"
#include "Parallel/cslfRanks.h"
#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfPhase.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <utility>

namespace cslf
{
namespace
{
/// The largest size of a slab's samples, in bytes.
constexpr double SlabBytes = 512.0 * 1024 * 1024;

/// Groups coded at once, for each thread. Each has several tracks, which keeps all threads busy.
constexpr int GroupsPerThread = 2;

/// Previews take at most one in this many seconds.
constexpr int SecondsPerPreviewSecond = 50;

/// The share of the progress for joining the groups.
constexpr double JoinShare = 0.05;

/// The progress before viewpoints are coded, if key views are chosen or a geometry is tried.
constexpr double PlannedShare = 0.05;

/// The viewpoints after which two thirds of the choice of key views are done.
constexpr double ExpectedTrials = 100.0;

///@{
/// The progress of some tasks when their viewpoints are there, and when these fit to the geometry.
constexpr double PullShare = 0.6;
constexpr double FitShare = 0.7;
///@}

/// The trials, and the groups that are coded in the end.
std::size_t CountTasks(const std::vector<CodingTask>& tasks)
{
  std::size_t count = 0;
  for (const CodingTask& task : tasks)
  {
    count += task.IsTrial ? task.Factors.size() : 1;
  }
  return count;
}
}

EncodeSession::EncodeSession(EncodeJob job)
  : Job(std::move(job))
  , Peers(this->Job.Controller)
{
}

EncodeSession::~EncodeSession() = default;

bool EncodeSession::Fail(unsigned long code, const std::string& text)
{
  // The first error is the cause.
  if (this->Error.Code == vtkErrorCode::NoError)
  {
    this->Error = { code, text };
  }
  return false;
}

bool EncodeSession::FailWriting(unsigned long code, const std::string& error)
{
  return this->Fail(code, this->Job.FileName + " was not written: " + error + ".");
}

// Does a step of this rank. The other ranks must learn of an exception, so it becomes an error.
bool EncodeSession::Try(const std::function<bool()>& step)
{
  std::string problem;
  const bool isDone = Guard(step, problem);
  return problem.empty() ? isDone : this->FailWriting(vtkErrorCode::UnknownError, problem);
}

// Being stopped is an error.
bool EncodeSession::ContinueIf(bool isAsked)
{
  return isAsked || this->FailWriting(vtkErrorCode::UserError, Stopped);
}

bool EncodeSession::HasNoError() const
{
  return this->Error.Code == vtkErrorCode::NoError;
}

bool EncodeSession::Check(const EncodeError& before)
{
  if (!this->Peers.CanTalk())
  {
    // All ranks know it, so the first one reports it.
    this->Error = { vtkErrorCode::UserError,
      this->Peers.GetRank() == 0 ? "Several ranks can write a file only through a vtkMPIController."
                                 : "" };
    return false;
  }
  this->Error = before;
  if (before.Code == vtkErrorCode::NoError)
  {
    this->Try([this] { return this->CheckHere(); });
  }
  return this->Agree({});
}

bool EncodeSession::CheckGrid()
{
  this->Grid = FindGrid(this->Job.Input);
  if (!this->Grid)
  {
    return this->Fail(vtkErrorCode::UserError,
      "The input is not a whole light field: its extent must be 5 N x N x 6 M^2.");
  }
  const int step = std::max(1, this->Job.Settings.KeyViewStep);
  const std::string fault = KeyViews::FindError(this->Grid->GetViewpoints(), step);
  return fault.empty() || this->Fail(vtkErrorCode::UserError, fault);
}

bool EncodeSession::CheckHere()
{
  if (this->Job.FileName.empty())
  {
    return this->Fail(vtkErrorCode::NoFileNameError, "There is no file name.");
  }
  if (!this->CheckGrid())
  {
    return false;
  }
  // Only rank 0 touches files.
  std::string fault = this->Peers.GetRank() == 0 ? FindError(this->Job.FileName) : std::string();
  if (!fault.empty())
  {
    return this->Fail(vtkErrorCode::CannotOpenFileError, fault);
  }
  std::error_code ignored;
  if (this->Peers.GetRank() == 0 && !this->Job.Overwrite &&
    std::filesystem::exists(std::filesystem::symlink_status(ToPath(this->Job.FileName), ignored)))
  {
    return this->FailWriting(vtkErrorCode::CannotOpenFileError, "it exists");
  }
  fault = FindError(this->Job.Settings, this->Grid->GetResolution());
  if (!fault.empty())
  {
    return this->Fail(vtkErrorCode::UserError, fault);
  }
  this->Input.emplace(this->Job.Connection, *this->Grid);
  this->Assembler.emplace(this->Job.FileName, this->Job.Settings);
  this->Assembler->SetParts(this->Job.Parts);
  this->Assembler->SetCertifier(this->Job.Certify);
  std::string error;
  return this->Peers.GetRank() != 0 || this->Assembler->ReserveFolder(this->Job.Restart, error) ||
    this->FailWriting(vtkErrorCode::CannotOpenFileError, error);
}

PersistentFile EncodeSession::GetCacheFile() const
{
  return this->Peers.GetRank() == 0 ? this->Assembler->GetCacheFile() : PersistentFile();
}

bool EncodeSession::Agree(const std::string& shared, int* fromRoot)
{
  const EncodeRanks::Verdict verdict =
    this->Peers.Agree(this->HasNoError(), shared, fromRoot ? *fromRoot : 0);
  if (fromRoot)
  {
    *fromRoot = verdict.FromRoot;
  }
  if (verdict.Differs)
  {
    this->FailWriting(vtkErrorCode::UserError,
      "the ranks have different fields, settings, versions or kinds of processor");
  }
  if (verdict.Failed >= 0 && verdict.Failed != this->Peers.GetRank())
  {
    this->Error = { vtkErrorCode::UnknownError, "" };
  }
  return verdict.Failed < 0;
}

bool EncodeSession::BeginReading()
{
  std::string error;
  if (!this->Input->Begin(error))
  {
    return this->Fail(vtkErrorCode::FileFormatError, error);
  }
  this->Checksum = this->Input->GetFirstChecksum();
  error = FindError(this->Job.Settings, this->Input->GetField());
  return error.empty() || this->Fail(vtkErrorCode::UserError, error);
}

// Rank 0 chooses for all; the ranks agree on it here.
bool EncodeSession::ChooseKeyViews(bool isReady)
{
  if (isReady && this->Peers.GetRank() == 0)
  {
    this->Try([this] { return this->TryKeyViews(); });
  }
  return this->Agree({}, &this->Choice.Step);
}

bool EncodeSession::TryKeyViews()
{
  std::string error;
  const vtkSmartPointer<vtkPolyData> geometry = this->GeometryBytes.empty()
    ? nullptr
    : DecodeGeometry(this->GeometryBytes, this->Input->GetField().Box, error);
  Phase phase(this->Job.Reporter, "Choosing key views", PlannedShare);
  int views = 0;
  const auto proceed = [&phase, &views]
  { return phase.Report(1.0 - std::exp(-views++ / ExpectedTrials)); };
  const PipelineWatch watch(this->Job.Connection,
    [this, &phase](vtkAlgorithm* producer)
    { return this->ContinueIf(phase.ReportFor(producer, phase.GetShare())); });
  return cslf::ChooseKeyViews(*this->Input, geometry, this->Job.Settings.NovelViewPSNR, proceed,
           this->Choice, error) ||
    this->FailWriting(vtkErrorCode::UserError, error);
}

// Rank 0 chooses for all; the others get its geometry here.
bool EncodeSession::ChooseGeometry(bool isReady)
{
  if (isReady)
  {
    this->Input->SetKeyViewStep(this->Choice.Step);
  }
  if (isReady && this->Peers.GetRank() == 0)
  {
    this->Try([this] { return this->TryGeometry(); });
  }
  const ComputedChannels& chosen = this->Plan.GetComputed();
  int choice = (chosen.HasDepth ? 1 : 0) + (chosen.HasCoverage ? 2 : 0) +
    (chosen.HasColor ? 4 : 0) + (chosen.IsAll ? 8 : 0);
  if (!this->Agree({}, &choice))
  {
    return false;
  }
  if (choice != 0 && this->Peers.GetCount() > 1)
  {
    std::string text;
    if (this->Peers.GetRank() == 0)
    {
      text.assign(this->GeometryBytes.begin(), this->GeometryBytes.end());
    }
    BroadcastText(this->Job.Controller, text, 0);
    if (this->Peers.GetRank() != 0)
    {
      this->Plan = GeometryPlan({ text.begin(), text.end() }, this->Input->GetField(),
        { true, (choice & 2) != 0, (choice & 4) != 0, (choice & 8) != 0 });
    }
  }
  return true;
}

// Only rank 0 has the parts of the file.
bool EncodeSession::AddGeometry()
{
  const auto part = this->Job.GetGeometry
    ? this->Job.GetGeometry(this->Input->GetField(), this->Job.Parts)
    : std::nullopt;
  if (part)
  {
    this->GeometryBytes = part->Bytes;
    this->Job.Parts.push_back(*part);
    this->Assembler->SetParts(this->Job.Parts);
  }
  return true;
}

bool EncodeSession::TryGeometry()
{
  const Description field = this->Input->GetField();
  if (this->GeometryBytes.empty() || !this->Job.Settings.ComputesDepth() ||
    !field.FindChannel(KnownChannel::Depth))
  {
    return true;
  }
  const std::vector<FrameId> frames = GetTriedViewpoints(field.Grid);
  Phase phase(this->Job.Reporter, "Comparing depth with the geometry", PlannedShare);
  const PipelineWatch watch(this->Job.Connection,
    [this, &phase](vtkAlgorithm* producer)
    {
      const double share = this->Input->GetShare(producer->GetProgress());
      return this->ContinueIf(phase.ReportFor(producer, PullShare * share));
    });
  std::string error;
  if (!this->Input->Read(frames, error))
  {
    return this->FailWriting(vtkErrorCode::UnknownError, error);
  }
  const auto report = [this, &phase](double share)
  { return this->ContinueIf(phase.Report(PullShare + (1.0 - PullShare) * share)); };
  this->Plan =
    GeometryPlan::Choose(this->GeometryBytes, field, frames, this->Input->GetSlices(), report);
  return this->HasNoError();
}

bool EncodeSession::BeginWriting()
{
  this->Assembler->Begin(this->Input->GetField(), this->Checksum, this->Plan);
  this->Source.emplace(*this->Input, *this->Assembler, this->Plan, this->CountSlicesThatFit());
  return this->Peers.GetRank() != 0 || this->OpenFolder();
}

bool EncodeSession::OpenFolder()
{
  for (const Channel& channel : this->Input->GetField().Channels)
  {
    if (!FindKnownChannel(channel.Name))
    {
      this->Job.Warn("The channel \"" + channel.Name + "\" is left out of the coded file.");
    }
  }
  std::string warning;
  std::string error;
  if (!this->Assembler->OpenFolder(this->Job.Restart, warning, error))
  {
    return this->FailWriting(vtkErrorCode::CannotOpenFileError, error);
  }
  if (!warning.empty())
  {
    this->Job.Warn(this->Job.FileName + ": " + warning);
  }
  if (this->Job.Resume)
  {
    this->Job.Resume(this->Assembler->CountStored(), this->Assembler->GetGroupCount());
  }
  RateTarget target = this->Job.Settings.Target;
  target.Value = target.Kind == RateTarget::Kinds::Factor ? this->Job.Settings.CRF : target.Value;
  this->Control.emplace(target, this->Assembler->GetRateField());
  this->Control->SetTrials(this->Assembler->ReadTrials());
  if (!this->Assembler->HasRoom(error))
  {
    return this->FailWriting(vtkErrorCode::OutOfDiskSpaceError, error);
  }
  this->Coding.emplace(this->Job.Reporter, "Coding viewpoints", 1.0 - JoinShare);
  return this->ReportProgress();
}

bool EncodeSession::Write(bool hasInput, const std::string& problem)
{
  this->Written = true;
  const AVLogSilence silence;
  if (this->IsStopped)
  {
    hasInput = false;
    this->FailWriting(vtkErrorCode::UserError, Stopped);
  }
  if (!hasInput)
  {
    this->Fail(vtkErrorCode::UnknownError,
      problem.empty() ? "The input failed." : "The input failed: " + problem + ".");
  }
  this->Try(
    [this, hasInput]
    {
      this->WriteField(hasInput);
      return true;
    });
  return this->HasNoError();
}

void EncodeSession::WriteField(bool hasInput)
{
  const bool isSynchronized = !this->Job.Synchronize || this->Job.Synchronize(hasInput);
  // If the input was stopped because another rank failed, that rank reports it.
  bool isReady = isSynchronized && hasInput && this->Try([this] { return this->BeginReading(); });
  if (isReady && this->Peers.GetRank() == 0)
  {
    isReady = this->Try([this] { return this->AddGeometry(); });
  }
  this->Choice.Step = this->Job.Settings.KeyViewStep;
  if ((this->Choice.Step > 0 || this->ChooseKeyViews(isReady)) && this->ChooseGeometry(isReady))
  {
    const bool hasBegun = isReady && this->Try([this] { return this->BeginWriting(); });
    int stored = this->Assembler->CountStored();
    if (this->Agree(hasBegun ? this->Assembler->GetManifest() : std::string(), &stored) &&
      isSynchronized)
    {
      stored = this->CodeGroups();
    }
    this->ReportStored(stored);
  }
  if (!this->HasNoError())
  {
    this->Assembler.reset();
  }
  else if (this->Input->HasClipped())
  {
    this->Job.Warn("Colour that is negative, above " + std::to_string(MaximumRadiance) +
      " or not a number is clipped.");
  }
}

// The rank that reports the error may differ from the one that keeps the groups.
void EncodeSession::ReportStored(int stored)
{
  std::string& text = this->Error.Text;
  if (stored > 0 && !text.empty())
  {
    text.erase(text.find_last_not_of('.') + 1);
    text += this->Assembler->DescribeKept(stored) + ".";
  }
}

int EncodeSession::CodeGroups()
{
  if (this->Peers.GetRank() == 0)
  {
    this->CodeOnRoot();
    this->Try([this] { return this->FinishFile(); });
  }
  else
  {
    this->CodeOnOthers();
  }
  int stored = this->Assembler->CountStored();
  this->Agree({}, &stored);
  return stored;
}

void EncodeSession::CodeOnRoot()
{
  const PipelineWatch watch(this->Job.Connection,
    [this](vtkAlgorithm* producer) { return this->Peers.Serve() && this->ReportInput(producer); });
  bool isDone = false;
  while (!isDone && this->CodeNextTasks(isDone))
  {
  }
  this->Coding.reset();
  this->Peers.ReleaseOthers();
  // Stopping because another rank failed is not an error of this rank.
  if (this->Peers.GetFailedRank() >= 0)
  {
    this->Error = {};
  }
}

bool EncodeSession::CodeNextTasks(bool& isDone)
{
  std::vector<CodingTask> tasks;
  std::string error;
  if (!this->Control->Next(tasks, error))
  {
    this->Assembler->DropTrials();
    return this->FailWriting(vtkErrorCode::UserError, error);
  }
  isDone = tasks.empty();
  std::vector<CodingTask> undone;
  std::copy_if(tasks.begin(), tasks.end(), std::back_inserter(undone),
    [this](const CodingTask& task)
    { return task.IsTrial || this->Assembler->IsMissing(task.Group); });
  return this->Peers.DoTasks(
           std::move(undone), this->GetGroupsAtOnce(),
           [this](const std::vector<CodingTask>& mine, std::vector<CodingResult>& results)
           { return this->Try([&] { return this->CodeTasks(mine, results); }); },
           [this](const std::vector<CodingResult>& results)
           { return this->Try([&] { return this->StoreResults(results); }); }) &&
    this->RecordTasks(tasks);
}

bool EncodeSession::RecordTasks(const std::vector<CodingTask>& tasks)
{
  for (const CodingTask& task : tasks)
  {
    if (task.IsTrial)
    {
      std::string error;
      return this->Assembler->WriteTrials(this->Control->GetTrials(), error) ||
        this->FailWriting(vtkErrorCode::UnknownError, error);
    }
    this->Control->AddCoded(task.Group, this->Assembler->GetStoredCost(task.Group));
  }
  return true;
}

bool EncodeSession::FinishFile()
{
  if (!this->HasNoError() || this->Peers.GetFailedRank() >= 0)
  {
    return false;
  }
  std::string error;
  Phase phase(this->Job.Reporter, "Writing the file");
  const auto report = [&phase](double share) { return phase.Report(share); };
  std::string warning;
  if (!this->Assembler->Finish(this->Job.Overwrite, report, warning, error))
  {
    const bool isTaken = error == NameIsTaken;
    return this->FailWriting(
      isTaken ? vtkErrorCode::CannotOpenFileError : vtkErrorCode::UnknownError, error);
  }
  if (!warning.empty())
  {
    this->Job.Warn(warning);
  }
  std::error_code ignored;
  const double bytes =
    static_cast<double>(std::filesystem::file_size(ToPath(this->Job.FileName), ignored));
  this->Outcome = { this->Control->GetMeanFactor(), bytes, this->Control->GetRawBytes() / bytes,
    this->Plan.TellsAll() ? 0.0 : this->Control->GetPSNR(), this->Choice.Step, this->Choice.PSNR,
    this->Plan.GetComputed().HasDepth, this->Plan.GetFit().GetLoss(),
    this->Plan.GetComputed().HasColor ? this->Plan.GetFit().GetColorShare() : 0.0 };
  return true;
}

void EncodeSession::CodeOnOthers()
{
  const PipelineWatch watch(
    this->Job.Connection, [this](vtkAlgorithm*) { return this->Peers.Serve(); });
  this->Peers.ServeRoot(
    [this](const std::vector<CodingTask>& tasks, std::vector<CodingResult>& results)
    { return this->Try([&] { return this->CodeTasks(tasks, results); }); });
  if (this->Peers.IsStopped())
  {
    this->Error = {};
  }
}

int EncodeSession::CountSlicesThatFit() const
{
  double texelBytes = 0.0;
  for (const Channel& channel : this->Input->GetField().Channels)
  {
    texelBytes += FindKnownChannel(channel.Name) ? channel.GetTexelBytes() : 0;
  }
  const double sliceBytes = texelBytes * this->Grid->GetStripWidth() * this->Grid->GetResolution();
  return static_cast<int>(std::min<double>(SlabBytes / sliceBytes, this->Grid->GetSlices()));
}

int EncodeSession::GetGroupsAtOnce() const
{
  const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
  const int fitting = this->CountSlicesThatFit() / this->Job.Settings.GroupLength;
  return std::max(1, std::min(GroupsPerThread * threads, fitting));
}

bool EncodeSession::CodeTasks(
  const std::vector<CodingTask>& tasks, std::vector<CodingResult>& results)
{
  std::vector<ViewpointSamples> slices;
  std::vector<GroupTracks> coded;
  std::string error;
  this->TasksAtWork = CountTasks(tasks);
  const auto report = [this](double share)
  { return this->Peers.Serve() && this->ReportTasks(share); };
  if (!this->Source->Gather(tasks, Within(report, PullShare, FitShare), slices, error) ||
    !this->Assembler->GetCoder().Encode(tasks, slices, Within(report, FitShare, 1.0), coded, error))
  {
    return this->FailWriting(vtkErrorCode::UnknownError, error);
  }
  this->TasksAtWork = 0;
  auto next = coded.begin();
  for (const CodingTask& task : tasks)
  {
    CodingResult& result = results.emplace_back();
    result.Group = task.Group;
    for (double factor : task.Factors)
    {
      if (task.IsTrial)
      {
        result.Trials.emplace_back(factor, this->Assembler->GetCost(*next));
      }
      else
      {
        result.Tracks = std::move(*next);
        this->Source->Drop(task.Group);
      }
      ++next;
    }
  }
  return true;
}

bool EncodeSession::StoreResults(const std::vector<CodingResult>& results)
{
  if (results.empty())
  {
    return this->FailWriting(
      vtkErrorCode::UnknownError, "a coded group was damaged during transfer");
  }
  std::string error;
  for (const CodingResult& result : results)
  {
    for (const auto& [factor, cost] : result.Trials)
    {
      this->Control->AddTrial(result.Group, factor, cost);
    }
    if (!result.Tracks.empty() && !this->Assembler->StoreGroup(result.Group, result.Tracks, error))
    {
      std::string lack;
      error += this->Assembler->HasRoom(lack) ? "" : "; " + lack;
      return this->FailWriting(vtkErrorCode::CannotOpenFileError, error);
    }
  }
  // The first groups show about how much space all will take.
  const bool isFirst = !this->HasCheckedRoom && this->Assembler->CountStored() > 0;
  this->HasCheckedRoom = this->HasCheckedRoom || isFirst;
  if (isFirst && !this->Assembler->HasRoom(error))
  {
    return this->FailWriting(vtkErrorCode::OutOfDiskSpaceError, error);
  }
  this->WritePreview();
  return this->ReportProgress();
}

// The file does not depend on it, so it is only a warning, given once, if this fails.
void EncodeSession::WritePreview()
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  if (start < this->NextPreview || !this->Assembler->CanPreview())
  {
    return;
  }
  std::string error;
  if (!this->Assembler->WritePreview(error) && !this->HasWarnedOfPreview)
  {
    this->HasWarnedOfPreview = true;
    this->Job.Warn("The preview of " + this->Job.FileName + " cannot be updated: " + error + ".");
  }
  const Clock::time_point end = Clock::now();
  this->NextPreview = end + SecondsPerPreviewSecond * (end - start);
}

double EncodeSession::GetShareAt(double ofTasks) const
{
  const double groups = this->Assembler->GetGroupCount();
  const double missing = static_cast<double>(this->Assembler->GetMissingGroups().size());
  const double trials = this->Control->GetExpectedTrials();
  const double tried = std::min<double>(trials, this->Control->GetTrialCount());
  const double atWork = ofTasks * static_cast<double>(this->TasksAtWork);
  return std::min(1.0, (tried + groups - missing + atWork) / (trials + groups));
}

// Other ranks have nobody to report to.
bool EncodeSession::ReportTasks(double share)
{
  return !this->Coding || this->ContinueIf(this->Coding->Report(this->GetShareAt(share)));
}

bool EncodeSession::ReportInput(vtkAlgorithm* producer)
{
  const double share = PullShare * this->Input->GetShare(producer->GetProgress());
  return this->ContinueIf(this->Coding->ReportFor(producer, this->GetShareAt(share)));
}

bool EncodeSession::ReportProgress()
{
  return this->ReportTasks(0.0);
}
}
