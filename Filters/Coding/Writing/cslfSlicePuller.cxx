// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSlicePuller.h"

#include "Pipeline/cslfArrayLayout.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfRequests.h"

#include "Coding/Frames/cslfRadianceFrames.h"
#include "cslfEncodeSettings.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <zlib.h>

#include <algorithm>
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

SlicePuller::SlicePuller(vtkInformation* information, const Layout& grid)
  : Information(information)
  , Grid(grid)
  , Keys(grid.GetViewpoints(), 1)
{
}

bool SlicePuller::Begin(std::string& error)
{
  const auto field = Description::ReadFrom(vtkImageData::GetData(this->Information), error);
  if (!field)
  {
    return false;
  }
  error = FindFault(*field);
  if (!error.empty())
  {
    return false;
  }
  this->Field = *field;
  this->Text = field->ToText();
  return true;
}

std::uint32_t SlicePuller::GetFirstChecksum() const
{
  vtkImageData* input = vtkImageData::GetData(this->Information);
  const int first = input->GetExtent()[4];
  const vtkSmartPointer<vtkImageData> image = ToAOS(input, first, first);
  const ViewpointSamples samples(image);
  uLong checksum = 0;
  for (const KnownChannel id : KnownChannels)
  {
    if (const Channel* channel = this->Field.FindChannel(id))
    {
      checksum = ::crc32(checksum, static_cast<const Bytef*>(samples.GetMemory(id)),
        static_cast<uInt>(channel->GetTexelBytes() * this->Grid.GetStripTexels()));
    }
  }
  return static_cast<std::uint32_t>(checksum);
}

bool SlicePuller::Pull(const std::vector<int>& slices, std::string& error)
{
  this->Pulled.clear();
  const auto texels = static_cast<vtkIdType>(this->Grid.GetStripTexels());
  const ViewpointSamples all =
    MakeSamples(this->Field, texels * static_cast<vtkIdType>(slices.size()));
  for (std::size_t place = 0; place < slices.size(); ++place)
  {
    this->Pulled.push_back(all.At(texels * static_cast<vtkIdType>(place)));
  }
  std::vector<std::pair<int, std::size_t>> sorted; // slice, place
  for (std::size_t place = 0; place < slices.size(); ++place)
  {
    sorted.emplace_back(this->Keys.ToWhole(slices[place]), place);
  }
  std::sort(sorted.begin(), sorted.end());
  this->Wanted = sorted.size();
  for (std::size_t begin = 0; begin < sorted.size();)
  {
    std::size_t end = begin + 1;
    while (end < sorted.size() && sorted[end].first == sorted[end - 1].first + 1)
    {
      ++end;
    }
    this->Done = begin;
    this->Awaited = end - begin;
    const vtkSmartPointer<vtkImageData> image =
      this->Update(sorted[begin].first, sorted[end - 1].first, error);
    if (!image)
    {
      return false;
    }
    for (; begin < end; ++begin)
    {
      this->Copy(image, sorted[begin].first, this->Pulled[sorted[begin].second]);
    }
  }
  return true;
}

double SlicePuller::GetShare(double ofInput) const
{
  const double done =
    static_cast<double>(this->Done) + ofInput * static_cast<double>(this->Awaited);
  return done / static_cast<double>(std::max<std::size_t>(this->Wanted, 1));
}

vtkSmartPointer<vtkImageData> SlicePuller::Update(int first, int last, std::string& error)
{
  auto* image = UpdateSlices(this->Information, first, last)
    ? vtkImageData::GetData(this->Information)
    : nullptr;
  if (!image || image->GetExtent()[4] > first || image->GetExtent()[5] < last)
  {
    error = "the input did not deliver the viewpoints " + std::to_string(first) + " to " +
      std::to_string(last);
    return nullptr;
  }
  const auto field = Description::ReadFrom(image, error);
  if (field && field->ToText() != this->Text)
  {
    error = "the input changed between two slabs";
    return nullptr;
  }
  return field ? ToAOS(image, first, last) : nullptr;
}

void SlicePuller::Copy(vtkImageData* image, int slice, const ViewpointSamples& target)
{
  const std::size_t texels = this->Grid.GetStripTexels();
  const auto first = static_cast<vtkIdType>(texels * (slice - image->GetExtent()[4]));
  ViewpointSamples(image).At(first).CopyTo(target, texels);
  if (const auto* color = target.Get<float>(KnownChannel::Color))
  {
    for (std::size_t texel = 0; texel < texels; ++texel)
    {
      this->Clipped = this->Clipped || !IsCodable(color + 4 * texel);
    }
  }
}
}
