// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointReader.h"

#include "Pipeline/cslfFieldArrays.h"

#include "Coding/Frames/cslfColorFrames.h"
#include "cslfEncodeSettings.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace cslf
{
std::optional<Layout> FindGrid(vtkInformation* information)
{
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  const double viewpoints = std::sqrt((extent[5] + 1.0) / FaceCount);
  const int resolution = std::clamp(extent[3], -1, MaximumResolution) + 1;
  const Layout grid(static_cast<int>(std::lround(viewpoints)), resolution);
  if (!grid.IsValid())
  {
    return std::nullopt;
  }
  int whole[6];
  grid.GetWholeExtent(whole);
  return std::equal(whole, whole + 6, extent) ? std::make_optional(grid) : std::nullopt;
}

ViewpointReader::ViewpointReader(vtkAlgorithmOutput* connection, const Layout& grid)
  : Input(connection)
  , Grid(grid)
  , Keys(grid.GetViewpoints(), 1)
{
}

bool ViewpointReader::Begin(std::string& error)
{
  if (!this->Input.OpenUpdated() || !this->Input.Read({ 0, 0 }))
  {
    error = this->Input.GetError();
    error = error.empty() ? "The input failed." : error;
    return false;
  }
  error = FindError(this->Input.GetDescription());
  return error.empty();
}

std::uint32_t ViewpointReader::GetFirstChecksum() const
{
  uLong checksum = 0;
  for (const ChannelId id : ChannelIds)
  {
    if (const Channel* channel = this->Input.GetDescription().FindChannel(id))
    {
      checksum = ::crc32(checksum, this->Input.GetSlice(*channel, 0),
        static_cast<uInt>(channel->GetTexelBytes() * this->Grid.GetStripTexels()));
    }
  }
  return static_cast<std::uint32_t>(checksum);
}

bool ViewpointReader::Read(const std::vector<FrameId>& frames, std::string& error)
{
  this->Slices.clear();
  const auto texels = static_cast<vtkIdType>(this->Grid.GetStripTexels());
  const ViewpointSamples all =
    MakeSamples(this->Input.GetDescription(), texels * static_cast<vtkIdType>(frames.size()));
  for (std::size_t place = 0; place < frames.size(); ++place)
  {
    this->Slices.push_back(all.At(texels * static_cast<vtkIdType>(place)));
  }
  std::vector<std::pair<FrameId, std::size_t>> sorted; // frame of the input, place
  for (std::size_t place = 0; place < frames.size(); ++place)
  {
    sorted.emplace_back(
      FrameId(this->Keys.ToWhole(frames[place].Slice), frames[place].Time), place);
  }
  std::sort(sorted.begin(), sorted.end());
  this->Wanted = sorted.size();
  for (std::size_t begin = 0; begin < sorted.size();)
  {
    std::size_t end = begin + 1;
    const auto isNext = [](FrameId frame, FrameId before)
    { return frame == FrameId(before.Slice + 1, before.Time); };
    while (end < sorted.size() && isNext(sorted[end].first, sorted[end - 1].first))
    {
      ++end;
    }
    this->Done = begin;
    this->Awaited = end - begin;
    if (!this->ReadRange(sorted[begin].first, sorted[end - 1].first.Slice, error))
    {
      return false;
    }
    for (; begin < end; ++begin)
    {
      this->Copy(sorted[begin].first.Slice, this->Slices[sorted[begin].second]);
    }
  }
  return true;
}

double ViewpointReader::GetShare(double ofInput) const
{
  const double done =
    static_cast<double>(this->Done) + ofInput * static_cast<double>(this->Awaited);
  return done / static_cast<double>(std::max<std::size_t>(this->Wanted, 1));
}

// Up to the slice `last` of the same time.
bool ViewpointReader::ReadRange(FrameId first, int last, std::string& error)
{
  if (this->Input.Read({ first.Slice, last }, first.Time))
  {
    return true;
  }
  error = this->Input.GetError();
  if (error.empty())
  {
    error = "the input did not deliver the viewpoints " + std::to_string(first.Slice) + " to " +
      std::to_string(last);
    return false;
  }
  // A sentence becomes part of one.
  error.erase(error.find_last_not_of('.') + 1);
  error.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(error.front())));
  return false;
}

void ViewpointReader::Copy(int slice, const ViewpointSamples& target)
{
  const std::size_t texels = this->Grid.GetStripTexels();
  vtkImageData* image = this->Input.GetImage();
  const auto first = static_cast<vtkIdType>(texels * (slice - image->GetExtent()[4]));
  ViewpointSamples(image).At(first).CopyTo(target, texels);
  for (int layer = 0; layer < MaximumLayers; ++layer)
  {
    const auto* color = target.Get<float>({ KnownChannel::Color, layer });
    for (std::size_t texel = 0; color && texel < texels; ++texel)
    {
      this->Clipped = this->Clipped || !IsCodable(color + 4 * texel);
    }
  }
}

GroupSource::GroupSource(
  ViewpointReader& input, const FileAssembler& file, const GeometryPlan& plan, int kept)
  : Input(input)
  , File(file)
  , Plan(plan)
  , Room(kept)
{
}

bool GroupSource::Gather(const std::vector<CodingTask>& tasks, const Progress& progress,
  std::vector<ViewpointSamples>& slices, std::string& error)
{
  std::vector<int> groups;
  for (const CodingTask& task : tasks)
  {
    if (this->Kept.count(task.Group) == 0)
    {
      groups.push_back(task.Group);
    }
  }
  const std::vector<FrameId> frames = this->File.GetFrames(groups);
  if (this->Plan.TellsAll())
  {
    slices = MakeBlankSamples(this->Input.GetField(), frames.size());
    return true;
  }
  if (!this->Input.Read(frames, error))
  {
    return false;
  }
  const std::vector<ViewpointSamples> fresh = this->Input.GetSlices();
  GeometryFit ignored;
  if (!this->Plan.Fit(frames, fresh, progress, ignored))
  {
    error = Stopped;
    return false;
  }
  auto from = fresh.begin();
  for (const CodingTask& task : tasks)
  {
    const auto kept = this->Kept.find(task.Group);
    if (kept != this->Kept.end())
    {
      slices.insert(slices.end(), kept->second.begin(), kept->second.end());
      continue;
    }
    const int count = this->File.CountFrames(task.Group);
    slices.insert(slices.end(), from, from + count);
    if (task.IsTrial && count <= this->Room)
    {
      this->Room -= count;
      this->Kept[task.Group] = { from, from + count };
    }
    from += count;
  }
  return true;
}

void GroupSource::Drop(int group)
{
  const auto found = this->Kept.find(group);
  if (found != this->Kept.end())
  {
    this->Room += static_cast<int>(found->second.size());
    this->Kept.erase(found);
  }
}
}
