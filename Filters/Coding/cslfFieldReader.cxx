// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfFieldReader.h"

#include "Coding/cslfGroupCodec.h"

#include <vtkSMPTools.h>

#include <algorithm>

namespace cslf
{
namespace
{
/// Groups read at once, for each thread: enough to keep all busy while the packets stay few.
constexpr int GroupsPerThread = 2;

int GetGroupsAtOnce()
{
  return GroupsPerThread * std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
}
}

/// The slices that are asked for and where they go.
struct FieldReader::Request
{
  int First = 0;
  int Last = -1;
  std::size_t Texels = 0; ///< of one slice
  unsigned char* Color = nullptr;
  unsigned short* Depth = nullptr;
  bool IsFloat = false;

  bool Has(int slice) const { return slice >= this->First && slice <= this->Last; }
  Slice Get(int slice) const
  {
    const std::size_t offset = this->Texels * (slice - this->First);
    const std::size_t bytes = this->IsFloat ? 4 * sizeof(float) : 4;
    return { this->Color + bytes * offset, this->Depth ? this->Depth + offset : nullptr,
      this->IsFloat };
  }
};

std::unique_ptr<FieldReader> FieldReader::Open(const std::string& fileName, OpenFailure& failure)
{
  auto container = ContainerReader::Open(fileName, failure);
  if (!container)
  {
    return nullptr;
  }
  auto reader = std::make_unique<FieldReader>();
  reader->Container = std::move(container);
  reader->GroupStarts = reader->GetHeader().GetGroupStarts();
  return reader;
}

std::vector<int> FieldReader::GetSlices(int group) const
{
  const auto begin = this->GetHeader().Slices.begin();
  return { begin + this->GroupStarts[group], begin + this->GroupStarts[group + 1] };
}

std::vector<int> FieldReader::Read(
  int first, int last, unsigned char* color, unsigned short* depth, const Progress& progress)
{
  const int resolution = this->GetHeader().Field.Grid.GetResolution();
  const Request request{ first, last, static_cast<std::size_t>(TileCount) * resolution * resolution,
    color, depth, this->GetHeader().Tracks.front().Kind.IsRadiance };
  const int groups = static_cast<int>(this->GetHeader().Groups.size());
  std::vector<bool> wanted(groups, false);
  for (int group = 0; group < groups; ++group)
  {
    const std::vector<int> slices = this->GetSlices(group);
    wanted[group] =
      std::any_of(slices.begin(), slices.end(), [&](int slice) { return request.Has(slice); });
  }
  std::vector<int> missing;
  const int atOnce = GetGroupsAtOnce();
  for (int group = 0; group < groups && progress(static_cast<double>(group) / groups);)
  {
    int count = 0;
    while (count < atOnce && group + count < groups && wanted[group + count])
    {
      ++count;
    }
    if (count > 0)
    {
      const std::vector<bool> good =
        this->DecodeGroups(group, this->Container->Read(group, count), request);
      for (int k = 0; k < count; ++k)
      {
        for (int slice : this->GetSlices(group + k))
        {
          if (!good[k] && request.Has(slice))
          {
            ClearSlice(resolution, request.Get(slice));
            missing.push_back(slice);
          }
        }
      }
    }
    group += std::max(count, 1);
  }
  std::sort(missing.begin(), missing.end());
  return missing;
}

std::vector<bool> FieldReader::DecodeGroups(
  int firstGroup, const std::vector<GroupPackets>& groups, const Request& request) const
{
  const FileHeader& header = this->GetHeader();
  const std::size_t tracks = header.Tracks.size();
  const auto jobs = static_cast<vtkIdType>(groups.size() * tracks);
  std::vector<char> decoded(jobs, 0);
  vtkSMPTools::For(0, jobs, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType job = begin; job < end; ++job)
      {
        const auto k = static_cast<std::size_t>(job) / tracks;
        const int group = firstGroup + static_cast<int>(k);
        const std::size_t track = job % tracks;
        decoded[job] = this->Container->IsWhole(group, track, groups[k]) &&
            this->DecodeTrack(track, group, groups[k], request)
          ? 1
          : 0;
      }
    });
  const Track* coverage = header.FindTrack(TrackRole::Coverage);
  std::vector<bool> good(groups.size(), false);
  for (std::size_t k = 0; k < groups.size(); ++k)
  {
    const auto from = decoded.begin() + static_cast<std::ptrdiff_t>(k * tracks);
    good[k] = std::all_of(from, from + static_cast<std::ptrdiff_t>(tracks),
      [](char isDecoded) { return isDecoded != 0; });
  }
  vtkSMPTools::For(0, static_cast<vtkIdType>(groups.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        for (int slice : this->GetSlices(firstGroup + static_cast<int>(k)))
        {
          if (good[k] && request.Has(slice))
          {
            JoinChannels(header.Field.Grid.GetResolution(), coverage, request.Get(slice));
          }
        }
      }
    });
  return good;
}

bool FieldReader::DecodeTrack(
  std::size_t track, int group, const GroupPackets& packets, const Request& request) const
{
  const FileHeader& header = this->GetHeader();
  const Track& kind = header.Tracks[track].Kind;
  const std::vector<int> slices = this->GetSlices(group);
  std::size_t left =
    std::count_if(slices.begin(), slices.end(), [&](int slice) { return request.Has(slice); });
  FrameToSlice converter(kind, header.Field.Grid.GetResolution());
  bool good = true;
  const bool decoded = DecodeGroup(this->Container->GetParameters(track), packets.Tracks[track],
    [&](int index, const AVFrame* frame)
    {
      if (index < 0 || static_cast<std::size_t>(index) >= slices.size())
      {
        good = false;
      }
      else if (request.Has(slices[index]))
      {
        good = converter.Convert(frame, request.Get(slices[index]));
        --left;
      }
      return good && left > 0;
    });
  return decoded && good && left == 0;
}

std::vector<int> FieldReader::FindMissing(const Progress& progress)
{
  const int groups = static_cast<int>(this->GetHeader().Groups.size());
  const int atOnce = GetGroupsAtOnce();
  std::vector<int> missing;
  for (int group = 0; group < groups && progress(static_cast<double>(group) / groups);
       group += atOnce)
  {
    const int count = std::min(atOnce, groups - group);
    const std::vector<GroupPackets> packets = this->Container->Read(group, count);
    for (int k = 0; k < count; ++k)
    {
      if (!this->Container->IsWhole(group + k, packets[k]))
      {
        const std::vector<int> slices = this->GetSlices(group + k);
        missing.insert(missing.end(), slices.begin(), slices.end());
      }
    }
  }
  std::sort(missing.begin(), missing.end());
  return missing;
}
}
