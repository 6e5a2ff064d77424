// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointStore.h"

#include "Pipeline/cslfFieldArrays.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

namespace cslf
{
void ViewpointCache::SetCapacity(std::size_t capacity)
{
  this->Capacity = capacity;
  this->Shrink();
}

std::optional<ViewpointSamples> ViewpointCache::Find(FrameId frame)
{
  const auto found = this->Places.find(frame);
  if (found == this->Places.end())
  {
    return std::nullopt;
  }
  this->Entries.splice(this->Entries.begin(), this->Entries, found->second);
  return found->second->Content;
}

void ViewpointCache::Insert(FrameId frame, ViewpointSamples viewpoint)
{
  if (this->Find(frame))
  {
    this->Entries.front().Content = std::move(viewpoint);
    return;
  }
  this->Entries.push_front({ frame, std::move(viewpoint) });
  this->Places[frame] = this->Entries.begin();
  this->Shrink();
}

void ViewpointCache::Shrink()
{
  while (this->Entries.size() > this->Capacity)
  {
    this->Places.erase(this->Entries.back().Frame);
    this->Entries.pop_back();
  }
}

namespace
{
/// How often a wait asks whether to continue.
constexpr std::chrono::milliseconds AskingInterval{ 50 };
}

ViewpointStore::ViewpointStore(GroupDecoder& decoder)
  : Decoder(decoder)
  , GroupOfFrame(decoder.GetHeader().Frames.size())
  , Steps([this] { this->FetchNext(); })
{
  const Description& field = decoder.GetHeader().Field;
  for (int group = 0; group < decoder.GetNumberOfGroups(); ++group)
  {
    for (const FrameId frame : decoder.GetFrames(group))
    {
      this->GroupOfFrame[field.GetIndex(frame)] = group;
    }
  }
  this->ViewpointBytes = static_cast<std::uint64_t>(field.GetTexelBytes()) *
    field.Grid.GetStripWidth() * field.Grid.GetResolution();
}

ViewpointStore::~ViewpointStore()
{
  // Work in progress ends soon, and the steps, which are destroyed first, wait for it.
  this->Decoder.Stop();
}

void ViewpointStore::SetSize(std::uint64_t bytes)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Cache.SetCapacity(static_cast<std::size_t>(bytes / this->ViewpointBytes));
}

std::size_t ViewpointStore::GetCapacity()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Cache.GetCapacity();
}

bool ViewpointStore::Has(FrameId frame)
{
  this->Steps.PostAgain();
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Cache.Has(frame);
}

std::optional<ViewpointSamples> ViewpointStore::Find(FrameId frame)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Cache.Find(frame);
}

ViewpointSamples ViewpointStore::Get(FrameId frame)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->Changed.wait(lock, [&] { return this->InProgress.count(frame) == 0; });
  if (const auto kept = this->Cache.Find(frame))
  {
    return *kept;
  }
  for (Job& job : this->Pending)
  {
    job.Frames.erase(std::remove(job.Frames.begin(), job.Frames.end(), frame), job.Frames.end());
  }
  lock.unlock();
  constexpr bool alone = false;
  ViewpointSamples viewpoint = this->Decode({ this->GetGroup(frame), { frame } }, alone).front();
  lock.lock();
  this->Cache.Insert(frame, viewpoint);
  return viewpoint;
}

void ViewpointStore::Insert(FrameId frame, ViewpointSamples viewpoint)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Cache.Insert(frame, std::move(viewpoint));
}

void ViewpointStore::Prefetch(const std::vector<FrameId>& frames)
{
  std::vector<Job> jobs;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    jobs = this->MakeJobs(frames);
    this->Pending.assign(jobs.begin(), jobs.end());
  }
  this->Changed.notify_all();
  for (std::size_t k = 0; k < jobs.size(); ++k)
  {
    this->Steps.Post();
  }
}

std::vector<ViewpointStore::Job> ViewpointStore::MakeJobs(const std::vector<FrameId>& frames)
{
  std::vector<Job> jobs;
  std::map<int, std::size_t> jobOfGroup;
  std::set<FrameId> seen;
  std::vector<FrameId> kept;
  for (const FrameId frame : frames)
  {
    const int group = this->GetGroup(frame);
    if (seen.size() == this->Cache.GetCapacity())
    {
      // A group begun here would have to be decoded again for the rest.
      if (jobs.size() > 1 && jobs.back().Group == group)
      {
        jobs.pop_back();
      }
      break;
    }
    if (!seen.insert(frame).second || this->InProgress.count(frame) != 0)
    {
      continue;
    }
    if (this->Cache.Has(frame))
    {
      kept.push_back(frame);
      continue;
    }
    const auto place = jobOfGroup.emplace(group, jobs.size());
    if (place.second)
    {
      jobs.push_back({ group, {} });
    }
    jobs[place.first->second].Frames.push_back(frame);
  }
  // Viewpoints that are asked for first are dropped last.
  std::for_each(kept.rbegin(), kept.rend(), [this](FrameId frame) { this->Cache.Find(frame); });
  return jobs;
}

/// Frames are in progress as long as this object exists, however their decoding ends.
class ViewpointStore::Progress
{
public:
  explicit Progress(ViewpointStore& store)
    : Store(store)
  {
  }
  ~Progress()
  {
    {
      const std::lock_guard<std::mutex> lock(this->Store.Mutex);
      for (const FrameId frame : this->Frames)
      {
        this->Store.InProgress.erase(frame);
      }
    }
    this->Store.Changed.notify_all();
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The mutex must be locked.
  void Begin(const std::vector<FrameId>& frames)
  {
    std::set<FrameId> added(frames.begin(), frames.end());
    this->Frames = frames;
    this->Store.InProgress.merge(added);
  }

private:
  ViewpointStore& Store;
  std::vector<FrameId> Frames;
};

void ViewpointStore::FetchNext()
{
  Job job;
  Progress progress(*this);
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (this->Pending.empty())
    {
      return;
    }
    job = std::move(this->Pending.front());
    this->Pending.pop_front();
    const auto isKnown = [this](FrameId frame)
    { return this->Cache.Has(frame) || this->InProgress.count(frame) != 0; };
    job.Frames.erase(
      std::remove_if(job.Frames.begin(), job.Frames.end(), isKnown), job.Frames.end());
    progress.Begin(job.Frames);
  }
  constexpr bool alone = true;
  std::vector<ViewpointSamples> decoded = this->Decode(job, alone);
  for (std::size_t k = 0; k < decoded.size(); ++k)
  {
    this->Insert(job.Frames[k], std::move(decoded[k]));
  }
}

std::vector<ViewpointSamples> ViewpointStore::Decode(const Job& job, bool alone)
{
  std::vector<ViewpointSamples> viewpoints;
  if (job.Frames.empty())
  {
    return viewpoints;
  }
  const AVLogSilence silence;
  const auto packets = this->Decoder.Load(job.Group);
  if (!packets)
  {
    viewpoints.resize(job.Frames.size());
    return viewpoints;
  }
  const Description& field = this->Decoder.GetHeader().Field;
  const std::vector<FrameId> frames = this->Decoder.GetFrames(job.Group);
  GroupRequest request;
  request.Group = job.Group;
  request.Slices.resize(frames.size());
  for (const FrameId wanted : job.Frames)
  {
    const auto place = std::find(frames.begin(), frames.end(), wanted) - frames.begin();
    viewpoints.push_back(MakeSamples(field, static_cast<vtkIdType>(field.Grid.GetStripTexels())));
    request.Slices[place] = viewpoints.back();
  }
  const bool isWhole = alone ? this->Decoder.DecodeAlone(request, *packets)
                             : this->Decoder.DecodeTracks(request, *packets);
  return isWhole ? viewpoints : std::vector<ViewpointSamples>(viewpoints.size());
}

void ViewpointStore::Wait()
{
  this->Steps.PostAgain();
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->Changed.wait(lock, [this] { return this->Pending.empty() && this->InProgress.empty(); });
}

bool ViewpointStore::WaitFor(int time, int first, int last, const std::function<bool()>& goesOn)
{
  this->Steps.PostAgain();
  const auto isAsked = [&](FrameId frame)
  { return frame.Time == time && frame.Slice >= first && frame.Slice <= last; };
  const auto touches = [&](const Job& job)
  { return std::any_of(job.Frames.begin(), job.Frames.end(), isAsked); };
  const auto isDone = [&]
  {
    return std::none_of(this->Pending.begin(), this->Pending.end(), touches) &&
      std::none_of(this->InProgress.begin(), this->InProgress.end(), isAsked);
  };
  std::unique_lock<std::mutex> lock(this->Mutex);
  std::stable_partition(this->Pending.begin(), this->Pending.end(), touches);
  while (!this->Changed.wait_for(lock, AskingInterval, isDone))
  {
    lock.unlock();
    if (!goesOn())
    {
      return false;
    }
    lock.lock();
  }
  return true;
}
}
