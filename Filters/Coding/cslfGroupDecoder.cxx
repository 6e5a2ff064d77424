// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfGroupDecoder.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <utility>

namespace cslf
{
GroupDecoder::GroupDecoder(std::unique_ptr<ContainerReader> container)
  : Container(std::move(container))
  , GroupStarts(this->GetHeader().GetGroupStarts())
  , Idle(this->GetHeader().Tracks.size())
{
}

std::vector<int> GroupDecoder::GetSlices(int group) const
{
  const auto begin = this->GetHeader().Slices.begin();
  return { begin + this->GroupStarts[group], begin + this->GroupStarts[group + 1] };
}

std::vector<bool> GroupDecoder::Decode(const std::vector<GroupRequest>& requests)
{
  if (requests.size() == 1)
  {
    return { this->DecodeTracks(requests.front()) };
  }
  std::vector<char> whole(requests.size(), 0);
  vtkSMPTools::For(0, static_cast<vtkIdType>(requests.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        whole[k] = this->DecodeAlone(requests[k]) ? 1 : 0;
      }
    });
  return { whole.begin(), whole.end() };
}

bool GroupDecoder::DecodeAlone(const GroupRequest& request)
{
  const GroupPackets packets = this->ReadPackets(request.Group);
  Workers workers;
  std::vector<const AVFrame*> frames(packets.Tracks.size());
  bool isGood = true;
  for (std::size_t track = 0; isGood && track < frames.size(); ++track)
  {
    workers.push_back(this->Begin(track, request, packets));
    isGood = workers.back() != nullptr;
  }
  // Frame by frame, so that what a frame becomes is still in the cache when the next track adds to
  // it.
  for (std::size_t place = 0; isGood && place < request.Slices.size(); ++place)
  {
    if (request.Slices[place].Color)
    {
      std::transform(workers.begin(), workers.end(), frames.begin(),
        [](const std::unique_ptr<Worker>& worker) { return worker->Decoder->Next(); });
      isGood = this->Join(workers, frames, static_cast<int>(place), request.Slices[place]);
    }
  }
  if (!isGood)
  {
    this->Clear(request);
    return false;
  }
  this->PutBack(workers);
  return true;
}

bool GroupDecoder::DecodeTracks(const GroupRequest& request)
{
  const GroupPackets packets = this->ReadPackets(request.Group);
  const std::size_t tracks = packets.Tracks.size();
  Workers workers(tracks);
  std::vector<std::vector<AVHandle<AVFrame>>> frames(tracks);
  vtkSMPTools::For(0, static_cast<vtkIdType>(tracks), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType track = begin; track < end; ++track)
      {
        workers[track] = this->Begin(track, request, packets);
        while (const AVFrame* frame = workers[track] ? workers[track]->Decoder->Next() : nullptr)
        {
          frames[track].emplace_back(av_frame_clone(frame));
        }
      }
    });
  std::vector<int> places;
  for (std::size_t place = 0; place < request.Slices.size(); ++place)
  {
    if (request.Slices[place].Color)
    {
      places.push_back(static_cast<int>(place));
    }
  }
  bool isGood = true;
  std::vector<const AVFrame*> parts(tracks);
  for (std::size_t k = 0; isGood && k < places.size(); ++k)
  {
    std::transform(frames.begin(), frames.end(), parts.begin(),
      [k](const std::vector<AVHandle<AVFrame>>& track)
      { return k < track.size() ? track[k].get() : nullptr; });
    isGood = this->Join(workers, parts, places[k], request.Slices[places[k]]);
  }
  if (!isGood)
  {
    this->Clear(request);
    return false;
  }
  this->PutBack(workers);
  return true;
}

bool GroupDecoder::Check(int group)
{
  return this->Container->IsWhole(group, this->ReadPackets(group));
}

std::vector<std::int64_t> GroupDecoder::CountBytes()
{
  const std::lock_guard<std::mutex> lock(this->ContainerMutex);
  return this->Container->CountBytes();
}

GroupPackets GroupDecoder::ReadPackets(int group)
{
  const std::lock_guard<std::mutex> lock(this->ContainerMutex);
  return this->Container->Read(group);
}

std::unique_ptr<GroupDecoder::Worker> GroupDecoder::Begin(
  std::size_t track, const GroupRequest& request, const GroupPackets& packets)
{
  if (!this->Container->IsWhole(request.Group, track, packets))
  {
    return nullptr;
  }
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
    worker.reset(new Worker{ TrackDecoder::Open(this->Container->GetParameters(track)),
      FrameToSlice(header.Tracks[track].Kind, header.Field.Grid.GetResolution()) });
  }
  if (!worker->Decoder)
  {
    return nullptr;
  }
  std::vector<bool> wanted;
  for (const Slice& slice : request.Slices)
  {
    wanted.push_back(slice.Color != nullptr);
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
  int place, const Slice& slice) const
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
  JoinChannels(header.Field.Grid.GetResolution(), header.FindTrack(TrackRole::Coverage), slice);
  return true;
}

void GroupDecoder::Clear(const GroupRequest& request) const
{
  for (const Slice& slice : request.Slices)
  {
    if (slice.Color)
    {
      ClearSlice(this->GetHeader().Field.Grid.GetResolution(), slice);
    }
  }
}
}
