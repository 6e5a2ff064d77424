// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointStore.h"

#include "Pipeline/cslfFieldArrays.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <unordered_set>
#include <utility>

namespace cslf
{
void ViewpointCache::SetCapacity(std::size_t capacity)
{
  this->Capacity = capacity;
  this->Shrink();
}

std::optional<ViewpointSamples> ViewpointCache::Find(int slice)
{
  const auto found = this->Places.find(slice);
  if (found == this->Places.end())
  {
    return std::nullopt;
  }
  this->Entries.splice(this->Entries.begin(), this->Entries, found->second);
  return found->second->Content;
}

void ViewpointCache::Insert(int slice, ViewpointSamples viewpoint)
{
  if (this->Find(slice))
  {
    this->Entries.front().Content = std::move(viewpoint);
    return;
  }
  this->Entries.push_front({ slice, std::move(viewpoint) });
  this->Places[slice] = this->Entries.begin();
  this->Shrink();
}

void ViewpointCache::Shrink()
{
  while (this->Entries.size() > this->Capacity)
  {
    this->Places.erase(this->Entries.back().Slice);
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
  , GroupOfSlice(decoder.GetHeader().Slices.size())
  , Steps([this] { this->FetchNext(); })
{
  const Description& field = decoder.GetHeader().Field;
  for (int group = 0; group < decoder.GetNumberOfGroups(); ++group)
  {
    for (int slice : decoder.GetSlices(group))
    {
      this->GroupOfSlice[slice] = group;
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

bool ViewpointStore::Has(int slice)
{
  this->Steps.PostAgain();
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Cache.Has(slice);
}

std::optional<ViewpointSamples> ViewpointStore::Find(int slice)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return this->Cache.Find(slice);
}

ViewpointSamples ViewpointStore::Get(int slice)
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  this->Changed.wait(lock, [&] { return this->InProgress.count(slice) == 0; });
  if (const auto kept = this->Cache.Find(slice))
  {
    return *kept;
  }
  for (Job& job : this->Pending)
  {
    job.Slices.erase(std::remove(job.Slices.begin(), job.Slices.end(), slice), job.Slices.end());
  }
  lock.unlock();
  constexpr bool alone = false;
  ViewpointSamples viewpoint =
    this->Decode({ this->GroupOfSlice[slice], { slice } }, alone).front();
  lock.lock();
  this->Cache.Insert(slice, viewpoint);
  return viewpoint;
}

void ViewpointStore::Insert(int slice, ViewpointSamples viewpoint)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Cache.Insert(slice, std::move(viewpoint));
}

void ViewpointStore::Prefetch(const std::vector<int>& slices)
{
  std::vector<Job> jobs;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    jobs = this->MakeJobs(slices);
    this->Pending.assign(jobs.begin(), jobs.end());
  }
  this->Changed.notify_all();
  for (std::size_t k = 0; k < jobs.size(); ++k)
  {
    this->Steps.Post();
  }
}

std::vector<ViewpointStore::Job> ViewpointStore::MakeJobs(const std::vector<int>& slices)
{
  std::vector<Job> jobs;
  std::map<int, std::size_t> jobOfGroup;
  std::unordered_set<int> seen;
  std::vector<int> kept;
  for (int slice : slices)
  {
    const int group = this->GroupOfSlice[slice];
    if (seen.size() == this->Cache.GetCapacity())
    {
      // A group begun here would have to be decoded again for the rest.
      if (jobs.size() > 1 && jobs.back().Group == group)
      {
        jobs.pop_back();
      }
      break;
    }
    if (!seen.insert(slice).second || this->InProgress.count(slice) != 0)
    {
      continue;
    }
    if (this->Cache.Has(slice))
    {
      kept.push_back(slice);
      continue;
    }
    const auto place = jobOfGroup.emplace(group, jobs.size());
    if (place.second)
    {
      jobs.push_back({ group, {} });
    }
    jobs[place.first->second].Slices.push_back(slice);
  }
  // Viewpoints that are asked for first are dropped last.
  std::for_each(kept.rbegin(), kept.rend(), [this](int slice) { this->Cache.Find(slice); });
  return jobs;
}

/// Slices are in progress as long as this object exists, however their decoding ends.
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
      for (int slice : this->Slices)
      {
        this->Store.InProgress.erase(slice);
      }
    }
    this->Store.Changed.notify_all();
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The mutex must be locked.
  void Begin(const std::vector<int>& slices)
  {
    std::set<int> added(slices.begin(), slices.end());
    this->Slices = slices;
    this->Store.InProgress.merge(added);
  }

private:
  ViewpointStore& Store;
  std::vector<int> Slices;
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
    const auto isKnown = [this](int slice)
    { return this->Cache.Has(slice) || this->InProgress.count(slice) != 0; };
    job.Slices.erase(
      std::remove_if(job.Slices.begin(), job.Slices.end(), isKnown), job.Slices.end());
    progress.Begin(job.Slices);
  }
  constexpr bool alone = true;
  std::vector<ViewpointSamples> decoded = this->Decode(job, alone);
  for (std::size_t k = 0; k < decoded.size(); ++k)
  {
    this->Insert(job.Slices[k], std::move(decoded[k]));
  }
}

std::vector<ViewpointSamples> ViewpointStore::Decode(const Job& job, bool alone)
{
  std::vector<ViewpointSamples> viewpoints;
  if (job.Slices.empty())
  {
    return viewpoints;
  }
  const AVLogSilence silence;
  const auto packets = this->Decoder.Load(job.Group);
  if (!packets)
  {
    viewpoints.resize(job.Slices.size());
    return viewpoints;
  }
  const Description& field = this->Decoder.GetHeader().Field;
  const std::vector<int> frames = this->Decoder.GetSlices(job.Group);
  GroupRequest request;
  request.Group = job.Group;
  request.Slices.resize(frames.size());
  for (int slice : job.Slices)
  {
    const auto frame = std::find(frames.begin(), frames.end(), slice) - frames.begin();
    viewpoints.push_back(MakeSamples(field, static_cast<vtkIdType>(field.Grid.GetStripTexels())));
    request.Slices[frame] = viewpoints.back();
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

bool ViewpointStore::WaitFor(int first, int last, const std::function<bool()>& goesOn)
{
  this->Steps.PostAgain();
  const auto isAsked = [&](int slice) { return slice >= first && slice <= last; };
  const auto touches = [&](const Job& job)
  { return std::any_of(job.Slices.begin(), job.Slices.end(), isAsked); };
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
