// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfEncodeSession.h"

#include "Coding/cslfPerceptualQuantizer.h"
#include "Pipeline/cslfPipelineWatch.h"

#include <vtkErrorCode.h>
#include <vtkInformation.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
/// What a slab's samples may take, in bytes.
constexpr double SlabBytes = 512.0 * 1024 * 1024;

/// Groups coded at once, for each thread: with several tracks each they keep all threads busy.
constexpr int GroupsPerThread = 2;

/// How much of the progress is left for joining the parts.
constexpr double JoinShare = 0.05;

constexpr std::uint32_t NoRank = 0xffffffffu;

/// What a message is about: its first number.
enum Topic : std::uint32_t
{
  State,   ///< to rank 0: whether all is well, and what all ranks must have in common
  Verdict, ///< from rank 0: the rank that failed, or NoRank
  Ask,     ///< to rank 0: for groups to work on
  Share,   ///< from rank 0: groups to work on, or none: there is nothing left to do
  Groups,  ///< to rank 0: coded groups
  Done,    ///< to rank 0: no more will come
  Failed,  ///< to rank 0: no more will come, for something went wrong
  Stop     ///< from rank 0: what is at work need not go on
};

ByteBuffer MakeMessage(Topic topic)
{
  ByteBuffer buffer;
  buffer.Put(topic);
  return buffer;
}

/// The grid of viewpoints and texels that a whole extent stands for.
std::optional<Layout> FindGrid(const int extent[6])
{
  const double viewpoints = std::sqrt((extent[5] + 1.0) / FaceCount);
  const Layout grid(static_cast<int>(std::lround(viewpoints)), extent[3] + 1);
  int whole[6];
  grid.GetWholeExtent(whole);
  if (!grid.IsValid() || !std::equal(whole, whole + 6, extent))
  {
    return std::nullopt;
  }
  return grid;
}
}

EncodeSession::EncodeSession(EncodeJob job)
  : Job(std::move(job))
  , Team(this->Job.Controller)
{
}

EncodeSession::~EncodeSession() = default;

bool EncodeSession::Fail(unsigned long code, const std::string& text)
{
  // The first fault is the cause.
  if (this->Fault.Code == vtkErrorCode::NoError)
  {
    this->Fault = { code, text };
  }
  return false;
}

bool EncodeSession::FailWriting(unsigned long code, const std::string& error)
{
  return this->Fail(code, this->Job.FileName + " was not written: " + error + ".");
}

bool EncodeSession::Check(const EncodeFault& before)
{
  if (!this->Team.CanTalk())
  {
    // Every rank knows, so the first one tells.
    this->Fault = { vtkErrorCode::UserError,
      this->Team.GetRank() == 0 ? "Several ranks can write a file only through a vtkMPIController."
                                : "" };
    return false;
  }
  this->Fault = before;
  if (before.Code == vtkErrorCode::NoError)
  {
    this->CheckHere();
  }
  return this->Agree({});
}

bool EncodeSession::CheckHere()
{
  if (this->Job.FileName.empty())
  {
    return this->Fail(vtkErrorCode::NoFileNameError, "There is no file name.");
  }
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  this->Job.Input->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  this->Grid = FindGrid(extent);
  if (!this->Grid)
  {
    return this->Fail(vtkErrorCode::UserError,
      "The input is not a whole light field: its extent must be 5 N x N x 6 M^2.");
  }
  // Only rank 0 touches files.
  std::string fault = this->Team.GetRank() == 0 ? FindFault(this->Job.FileName) : std::string();
  fault = fault.empty() ? FindFault(this->Job.Settings, this->Grid->GetResolution()) : fault;
  if (!fault.empty())
  {
    return this->Fail(vtkErrorCode::CannotOpenFileError, fault);
  }
  this->Puller.emplace(this->Job.Input, *this->Grid);
  this->Writer.emplace(this->Job.FileName, this->Job.Settings, *this->Grid);
  std::string error;
  return this->Team.GetRank() != 0 || this->Writer->ReserveParts(this->Job.Restart, error) ||
    this->FailWriting(vtkErrorCode::CannotOpenFileError, error);
}

std::string EncodeSession::GetCacheName() const
{
  return this->Team.GetRank() == 0 ? this->Writer->GetCacheName() : std::string();
}

bool EncodeSession::Agree(const std::string& shared)
{
  if (this->Team.GetCount() == 1)
  {
    return this->Fault.Code == vtkErrorCode::NoError;
  }
  std::uint32_t failed = NoRank;
  if (this->Team.GetRank() == 0)
  {
    failed = static_cast<std::uint32_t>(this->FindFailed(shared));
    for (int rank = 1; rank < this->Team.GetCount(); ++rank)
    {
      ByteBuffer verdict = MakeMessage(Verdict);
      verdict.Put(failed);
      this->Team.Post(rank, verdict.GetBytes());
    }
  }
  else
  {
    ByteBuffer state = MakeMessage(State);
    state.Put(this->Fault.Code == vtkErrorCode::NoError ? 0 : 1);
    state.Put(std::vector<std::uint8_t>(shared.begin(), shared.end()));
    this->Team.Post(0, state.GetBytes());
    // Work that was dealt out before another rank failed may still be on its way.
    for (std::uint32_t topic = State; topic != Verdict;)
    {
      ByteBuffer content(this->Team.Wait().Bytes);
      content.Take(topic);
      content.Take(failed);
    }
  }
  this->Team.Flush();
  if (failed != NoRank && failed != static_cast<std::uint32_t>(this->Team.GetRank()))
  {
    this->Fault = { vtkErrorCode::UnknownError, "" };
  }
  return failed == NoRank;
}

int EncodeSession::FindFailed(const std::string& shared)
{
  const std::vector<std::uint8_t> expected(shared.begin(), shared.end());
  int failed = this->Fault.Code == vtkErrorCode::NoError ? this->FailedRank : 0;
  bool equal = true;
  for (int others = this->Team.GetCount() - 1; others > 0;)
  {
    if (this->States.empty())
    {
      this->Handle(this->Team.Wait());
      continue;
    }
    const Ranks::Message message = std::move(this->States.back());
    this->States.pop_back();
    ByteBuffer content(message.Bytes);
    std::uint32_t topic = State;
    std::uint32_t isBad = 0;
    std::vector<std::uint8_t> theirs;
    if (content.Take(topic) && content.Take(isBad) && content.Take(theirs))
    {
      failed = isBad && (failed < 0 || message.From < failed) ? message.From : failed;
      equal = equal && (isBad || theirs == expected);
      --others;
    }
  }
  if (failed < 0 && !equal)
  {
    this->FailWriting(
      vtkErrorCode::UserError, "the ranks have different fields, settings or versions");
    failed = 0;
  }
  return failed;
}

bool EncodeSession::Begin()
{
  std::string error;
  if (!this->Puller->Begin(error))
  {
    return this->Fail(vtkErrorCode::FileFormatError, error);
  }
  error = FindFault(this->Job.Settings, this->Puller->GetField());
  if (!error.empty())
  {
    return this->Fail(vtkErrorCode::UserError, error);
  }
  this->Writer->Begin(this->Puller->GetField(), this->Puller->GetFirstChecksum());
  if (this->Team.GetRank() != 0)
  {
    return true;
  }
  for (const Channel& channel : this->Puller->GetField().Channels)
  {
    if (channel.Name != ColorName && channel.Name != DepthName)
    {
      this->Job.Warn("The channel \"" + channel.Name + "\" is left out of the coded file.");
    }
  }
  std::string warning;
  if (!this->Writer->OpenParts(this->Job.Restart, warning, error))
  {
    return this->FailWriting(vtkErrorCode::CannotOpenFileError, error);
  }
  if (!warning.empty())
  {
    this->Job.Warn(this->Job.FileName + ": " + warning);
  }
  return this->ReportGroups();
}

bool EncodeSession::Write(bool hasInput)
{
  this->Written = true;
  const AVLogSilence silence;
  const bool isSettled = !this->Job.Settle || this->Job.Settle(hasInput);
  bool ready = false;
  if (!hasInput)
  {
    this->Fail(vtkErrorCode::UnknownError, "The input failed.");
  }
  else if (isSettled)
  {
    ready = this->Begin();
  }
  // Where the input was broken off because another rank failed, that one tells.
  if (this->Agree(ready ? this->Writer->GetManifest() : std::string()) && isSettled)
  {
    if (this->Team.GetRank() == 0)
    {
      this->Lead();
      this->Conclude();
    }
    else
    {
      this->Follow();
    }
    this->Agree({});
  }
  if (this->Fault.Code != vtkErrorCode::NoError)
  {
    this->Writer.reset();
  }
  else if (this->Puller->GetClipped() > 0)
  {
    this->Job.Warn("The colour of " + std::to_string(this->Puller->GetClipped()) +
      " texels is negative or above " + std::to_string(MaximumRadiance) + ": it is clipped.");
  }
  return this->Fault.Code == vtkErrorCode::NoError;
}

void EncodeSession::Lead()
{
  this->Undealt = this->Writer->GetMissingGroups();
  this->Working = this->Team.GetCount() - 1;
  const PipelineWatch watch(this->Job.Connection, [this] { return this->Serve(); });
  while (!this->Stopped && !this->Undealt.empty())
  {
    const std::vector<int> groups = this->Choose();
    this->Undealt.erase(this->Undealt.begin(), this->Undealt.begin() + groups.size());
    std::vector<GroupParts> parts;
    if (!this->MakeGroups(groups, parts) || !this->StoreGroups(groups, parts))
    {
      this->StopOthers();
    }
    this->Serve();
  }
  while (this->Working > 0)
  {
    this->Handle(this->Team.Wait());
  }
  // What was broken off because another rank failed is no fault of this one's.
  if (this->FailedRank >= 0)
  {
    this->Fault = {};
  }
}

void EncodeSession::Conclude()
{
  if (this->Fault.Code != vtkErrorCode::NoError || this->FailedRank >= 0)
  {
    return;
  }
  std::string error;
  const auto report = [this](double share)
  { return this->Job.Progress(1.0 - JoinShare + JoinShare * share); };
  if (!this->Writer->Finish(report, error))
  {
    this->FailWriting(vtkErrorCode::UnknownError, error);
  }
}

void EncodeSession::Follow()
{
  const PipelineWatch watch(this->Job.Connection, [this] { return this->Serve(); });
  const ByteBuffer ask = MakeMessage(Ask);
  this->Team.Post(0, ask.GetBytes());
  while (!this->Stopped)
  {
    while (!this->Dealt && !this->Stopped)
    {
      this->Handle(this->Team.Wait());
    }
    const std::vector<int> groups = this->Dealt.value_or(std::vector<int>());
    this->Dealt.reset();
    if (this->Stopped || groups.empty())
    {
      break;
    }
    this->Team.Post(0, ask.GetBytes());
    std::vector<GroupParts> parts;
    if (!this->MakeGroups(groups, parts))
    {
      break;
    }
    ByteBuffer message = MakeMessage(Groups);
    message.Put(static_cast<std::uint32_t>(groups.size()));
    for (std::size_t place = 0; place < groups.size(); ++place)
    {
      message.Put(static_cast<std::uint32_t>(groups[place]));
      for (const CodedGroup& part : parts[place])
      {
        message.Put(PackPart(part));
      }
    }
    this->Team.Post(0, message.GetBytes());
  }
  if (this->Stopped)
  {
    this->Fault = {};
  }
  const bool good = this->Fault.Code == vtkErrorCode::NoError;
  this->Team.Post(0, MakeMessage(good ? Done : Failed).GetBytes());
}

std::vector<int> EncodeSession::Choose() const
{
  // Less towards the end, so that all ranks end together.
  const int undealt = static_cast<int>(this->Undealt.size());
  const int fair = this->Team.GetCount() > 1 ? undealt / (2 * this->Team.GetCount()) : undealt;
  const int count = std::min(undealt, std::clamp(fair, 1, this->GetGroupsAtOnce()));
  return { this->Undealt.begin(), this->Undealt.begin() + count };
}

int EncodeSession::GetGroupsAtOnce() const
{
  constexpr int texelBytes = 6;
  const double groupBytes = 1.0 * texelBytes * this->Grid->GetStripWidth() *
    this->Grid->GetResolution() * this->Job.Settings.GroupLength;
  const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
  return std::max(
    1, static_cast<int>(std::min<double>(GroupsPerThread * threads, SlabBytes / groupBytes)));
}

bool EncodeSession::MakeGroups(const std::vector<int>& groups, std::vector<GroupParts>& parts)
{
  const auto idle = [this] { this->Serve(); };
  std::string error;
  return (this->Puller->Pull(this->Writer->GetSlices(groups), error) &&
           this->Writer->EncodeGroups(groups, this->Puller->GetSlices(), idle, parts, error)) ||
    this->FailWriting(vtkErrorCode::UnknownError, error);
}

bool EncodeSession::StoreGroups(
  const std::vector<int>& groups, const std::vector<GroupParts>& parts)
{
  std::string error;
  for (std::size_t place = 0; place < groups.size(); ++place)
  {
    if (!this->Writer->StoreGroup(groups[place], parts[place], error))
    {
      return this->FailWriting(vtkErrorCode::UnknownError, error);
    }
  }
  return this->ReportGroups();
}

bool EncodeSession::ReportGroups()
{
  const double missing = static_cast<double>(this->Writer->GetMissingGroups().size());
  const double share = (1.0 - JoinShare) * (1.0 - missing / this->Writer->GetGroupCount());
  return this->Job.Progress(share) || this->FailWriting(vtkErrorCode::UserError, "it was stopped");
}

bool EncodeSession::Serve()
{
  while (auto message = this->Team.Poll())
  {
    this->Handle(*std::move(message));
  }
  return !this->Stopped;
}

void EncodeSession::Handle(Ranks::Message message)
{
  ByteBuffer content(message.Bytes);
  std::uint32_t topic = Stop;
  content.Take(topic);
  switch (topic)
  {
    case Ask:
      this->Deal(message.From);
      break;
    case Groups:
      this->HandleGroups(content);
      break;
    case Done:
      --this->Working;
      break;
    case Failed:
      --this->Working;
      this->FailedRank = this->FailedRank < 0 ? message.From : this->FailedRank;
      this->StopOthers();
      break;
    case Share:
    {
      this->Dealt.emplace();
      for (std::uint32_t group = 0; content.Take(group);)
      {
        this->Dealt->push_back(static_cast<int>(group));
      }
      break;
    }
    case State:
      // From a rank that is done already.
      this->States.push_back(std::move(message));
      break;
    default:
      this->Stopped = true;
      break;
  }
}

void EncodeSession::HandleGroups(ByteBuffer& content)
{
  if (this->Stopped)
  {
    return;
  }
  std::uint32_t count = 0;
  bool good = content.Take(count);
  std::vector<int> groups;
  std::vector<GroupParts> parts;
  for (std::uint32_t place = 0; good && place < count; ++place)
  {
    std::uint32_t group = 0;
    good = content.Take(group);
    groups.push_back(static_cast<int>(group));
    parts.emplace_back(this->Writer->GetTrackCount());
    for (CodedGroup& part : parts.back())
    {
      std::vector<std::uint8_t> bytes;
      good = good && content.Take(bytes) && UnpackPart(std::move(bytes), part);
    }
  }
  if (!good)
  {
    this->FailWriting(vtkErrorCode::UnknownError, "a coded group was damaged on its way");
  }
  if (!good || !this->StoreGroups(groups, parts))
  {
    this->StopOthers();
  }
}

void EncodeSession::Deal(int rank)
{
  ByteBuffer share = MakeMessage(Share);
  if (!this->Stopped && !this->Undealt.empty())
  {
    const std::vector<int> groups = this->Choose();
    this->Undealt.erase(this->Undealt.begin(), this->Undealt.begin() + groups.size());
    for (int group : groups)
    {
      share.Put(static_cast<std::uint32_t>(group));
    }
  }
  this->Team.Post(rank, share.GetBytes());
}

void EncodeSession::StopOthers()
{
  if (!this->Stopped)
  {
    this->Stopped = true;
    for (int rank = 1; rank < this->Team.GetCount(); ++rank)
    {
      this->Team.Post(rank, MakeMessage(Stop).GetBytes());
    }
  }
}
}
