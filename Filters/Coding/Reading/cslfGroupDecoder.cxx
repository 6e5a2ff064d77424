// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGroupDecoder.h"

#include "Coding/Geometry/cslfGeometryFit.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfParallelFor.h"

#include <algorithm>
#include <utility>

namespace cslf
{
GroupDecoder::GroupDecoder(
  std::unique_ptr<ContainerReader> container, std::unique_ptr<GeometryTexels> texels)
  : Container(std::move(container))
  , Texels(std::move(texels))
  , GroupStarts(this->GetHeader().GetGroupStarts())
  , Idle(this->GetHeader().Tracks.size())
  , Conditions(this->GetHeader().Groups.size(), Condition::Unknown)
{
  for (int group : this->GetHeader().Missing)
  {
    this->Conditions[group] = Condition::Missing;
  }
  if (this->IsAllComputed())
  {
    std::fill(this->Conditions.begin(), this->Conditions.end(), Condition::Whole);
  }
}

std::vector<FrameId> GroupDecoder::GetFrames(int group) const
{
  const auto begin = this->GetHeader().Frames.begin();
  return { begin + this->GroupStarts[group], begin + this->GroupStarts[group + 1] };
}

GroupDecoder::Condition GroupDecoder::GetCondition(int group)
{
  const std::lock_guard<std::mutex> lock(this->ConditionMutex);
  return this->Conditions[group];
}

void GroupDecoder::SetCondition(int group, bool isWhole)
{
  const std::lock_guard<std::mutex> lock(this->ConditionMutex);
  this->Conditions[group] = isWhole ? Condition::Whole : Condition::Damaged;
}

bool GroupDecoder::Check(int group)
{
  const Condition condition = this->GetCondition(group);
  return condition == Condition::Unknown ? this->Load(group) != nullptr
                                         : condition == Condition::Whole;
}

std::unique_ptr<const GroupPackets> GroupDecoder::Load(int group)
{
  const Condition condition = this->GetCondition(group);
  if (condition == Condition::Missing || condition == Condition::Damaged)
  {
    return nullptr;
  }
  auto packets = std::make_unique<GroupPackets>();
  if (this->IsAllComputed())
  {
    return packets;
  }
  {
    const std::lock_guard<std::mutex> lock(this->ContainerMutex);
    *packets = this->Container->Read(group);
  }
  const bool isWhole = this->Container->IsWhole(group, *packets);
  this->SetCondition(group, isWhole);
  return isWhole ? std::move(packets) : nullptr;
}

std::vector<bool> GroupDecoder::Decode(const std::vector<GroupRequest>& requests)
{
  if (requests.size() == 1)
  {
    constexpr bool alone = false;
    return { this->LoadAndDecode(requests.front(), alone) };
  }
  std::vector<char> whole(requests.size(), 0);
  ParallelFor(0, static_cast<vtkIdType>(requests.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      constexpr bool alone = true;
      for (vtkIdType k = begin; k < end; ++k)
      {
        whole[k] = this->LoadAndDecode(requests[k], alone) ? 1 : 0;
      }
    });
  return { whole.begin(), whole.end() };
}

bool GroupDecoder::LoadAndDecode(const GroupRequest& request, bool alone)
{
  const auto packets = this->Load(request.Group);
  if (!packets)
  {
    this->Clear(request);
    return false;
  }
  return alone || this->IsAllComputed() ? this->DecodeAlone(request, *packets)
                                        : this->DecodeTracks(request, *packets);
}

bool GroupDecoder::ComputeAll(const GroupRequest& request)
{
  this->Clear(request);
  std::atomic<bool> isComputed{ true };
  ParallelFor(0, static_cast<vtkIdType>(request.Slices.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType place = begin; place < end; ++place)
      {
        if (!request.Slices[place].IsEmpty() && !this->Compute(request, static_cast<int>(place)))
        {
          isComputed = false;
        }
      }
    });
  if (!isComputed)
  {
    this->Clear(request);
  }
  return isComputed;
}

bool GroupDecoder::DecodeAlone(const GroupRequest& request, const GroupPackets& packets)
{
  if (this->IsAllComputed())
  {
    return this->ComputeAll(request);
  }
  Workers workers;
  std::vector<const AVFrame*> frames(packets.Tracks.size());
  bool isGood = true;
  for (std::size_t track = 0; isGood && track < frames.size(); ++track)
  {
    workers.push_back(this->Begin(track, request, packets));
    isGood = workers.back() != nullptr;
  }
  // Frame by frame, so that a frame's texels are still in the cache when the next track adds to
  // them.
  for (std::size_t place = 0; isGood && place < request.Slices.size(); ++place)
  {
    if (!request.Slices[place].IsEmpty())
    {
      std::transform(workers.begin(), workers.end(), frames.begin(),
        [](const std::unique_ptr<Worker>& worker) { return worker->Decoder->Next(); });
      isGood = this->Join(workers, frames, static_cast<int>(place), request.Slices[place]) &&
        this->Compute(request, static_cast<int>(place));
    }
  }
  return this->Finish(request, isGood, workers);
}

bool GroupDecoder::DecodeTracks(const GroupRequest& request, const GroupPackets& packets)
{
  std::vector<int> places;
  for (std::size_t place = 0; place < request.Slices.size(); ++place)
  {
    if (!request.Slices[place].IsEmpty())
    {
      places.push_back(static_cast<int>(place));
    }
  }
  const std::size_t tracks = packets.Tracks.size();
  Workers workers(tracks);
  std::vector<std::vector<AVHandle<AVFrame>>> frames(tracks);
  ParallelFor(0, static_cast<vtkIdType>(tracks), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType track = begin; track < end; ++track)
      {
        workers[track] = this->Begin(track, request, packets);
        const AVFrame* frame = nullptr;
        // A damaged track may contain more frames than the group has.
        while (workers[track] && frames[track].size() < places.size() &&
          (frame = workers[track]->Decoder->Next()) != nullptr)
        {
          frames[track].emplace_back(RequireMemory(av_frame_clone(frame)));
        }
      }
    });
  bool isGood = true;
  std::vector<const AVFrame*> parts(tracks);
  for (std::size_t k = 0; isGood && k < places.size(); ++k)
  {
    std::transform(frames.begin(), frames.end(), parts.begin(),
      [k](const std::vector<AVHandle<AVFrame>>& track)
      { return k < track.size() ? track[k].get() : nullptr; });
    isGood = this->Join(workers, parts, places[k], request.Slices[places[k]]);
  }
  std::atomic<bool> isComputed{ true };
  ParallelFor(0, isGood ? static_cast<vtkIdType>(places.size()) : 0, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        if (!this->Compute(request, places[k]))
        {
          isComputed = false;
        }
      }
    });
  return this->Finish(request, isGood && isComputed, workers);
}

bool GroupDecoder::Finish(const GroupRequest& request, bool isGood, Workers& workers)
{
  if (isGood)
  {
    this->PutBack(workers);
    return true;
  }
  if (!this->IsStopped)
  {
    this->SetCondition(request.Group, false);
  }
  this->Clear(request);
  return false;
}

std::vector<std::int64_t> GroupDecoder::CountBytes()
{
  const std::lock_guard<std::mutex> lock(this->ContainerMutex);
  return this->Container->CountBytes();
}

std::unique_ptr<GroupDecoder::Worker> GroupDecoder::Begin(
  std::size_t track, const GroupRequest& request, const GroupPackets& packets)
{
  std::unique_ptr<Worker> worker;
  {
    const std::lock_guard<std::mutex> lock(this->IdleMutex);
    if (!this->Idle[track].empty())
    {
      worker = std::move(this->Idle[track].back());
      this->Idle[track].pop_back();
    }
  }
  if (!worker)
  {
    const FileHeader& header = this->GetHeader();
    const int resolution = header.Field.Grid.GetResolution();
    worker.reset(new Worker{ TrackDecoder::Open(this->Container->GetParameters(track), resolution),
      FrameToSlice(header.Tracks[track].Kind, resolution) });
  }
  if (!worker->Decoder)
  {
    return nullptr;
  }
  std::vector<bool> wanted;
  for (const ViewpointSamples& slice : request.Slices)
  {
    wanted.push_back(!slice.IsEmpty());
  }
  worker->Decoder->Begin(packets.Tracks[track], wanted);
  return worker;
}

void GroupDecoder::PutBack(Workers& workers)
{
  const std::lock_guard<std::mutex> lock(this->IdleMutex);
  for (std::size_t track = 0; track < workers.size(); ++track)
  {
    this->Idle[track].push_back(std::move(workers[track]));
  }
}

bool GroupDecoder::Join(const Workers& workers, const std::vector<const AVFrame*>& frames,
  int place, const ViewpointSamples& slice) const
{
  for (std::size_t track = 0; track < frames.size(); ++track)
  {
    if (this->IsStopped || !frames[track] || frames[track]->pts != place ||
      !workers[track]->Converter.Convert(frames[track], slice))
    {
      return false;
    }
  }
  const FileHeader& header = this->GetHeader();
  JoinChannels(
    header.Field.Grid.GetResolution(), [&header](TrackRole role) { return header.FindTrack(role); },
    slice);
  return true;
}

// What the geometry tells about a slice. False if decoding was stopped.
bool GroupDecoder::Compute(const GroupRequest& request, int place) const
{
  const FileHeader& header = this->GetHeader();
  const ViewpointSamples& slice = request.Slices[place];
  if (!this->Texels)
  {
    return true;
  }
  DrawnTexels drawn(header.Field.Grid.GetStripTexels(), header.Computed.HasColor);
  if (!this->Texels->Draw(
        header.Frames[this->GroupStarts[request.Group] + place].Slice, drawn, this->IsStopped))
  {
    return false;
  }
  ApplyGeometry(drawn, header.Computed.HasCoverage, slice);
  return true;
}

void GroupDecoder::Clear(const GroupRequest& request) const
{
  for (const ViewpointSamples& slice : request.Slices)
  {
    if (!slice.IsEmpty())
    {
      cslf::Clear(this->GetHeader().Field, slice);
    }
  }
}
}
