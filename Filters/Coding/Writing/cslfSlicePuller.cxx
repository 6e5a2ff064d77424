// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSlicePuller.h"

#include "Pipeline/cslfArrayLayout.h"

#include "Coding/Frames/cslfRadianceFrames.h"
#include "cslfEncodeSettings.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationExecutivePortKey.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
const unsigned char* GetColor(vtkImageData* image)
{
  return static_cast<unsigned char*>(image->GetPointData()->GetArray(ColorName)->GetVoidPointer(0));
}

const unsigned short* GetDepth(vtkImageData* image)
{
  return static_cast<unsigned short*>(
    image->GetPointData()->GetArray(DepthName)->GetVoidPointer(0));
}
}

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
  , Texels(static_cast<std::size_t>(grid.GetStripWidth()) * grid.GetResolution())
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
  this->HasDepth = field->FindChannel(DepthName) != nullptr;
  this->IsFloat = field->FindChannel(ColorName)->Type == VTK_FLOAT;
  this->ColorBytes = this->IsFloat ? 4 * sizeof(float) : 4;
  return true;
}

std::uint32_t SlicePuller::GetFirstChecksum() const
{
  vtkImageData* input = vtkImageData::GetData(this->Information);
  const int first = input->GetExtent()[4];
  const vtkSmartPointer<vtkImageData> image = ToAOS(input, first, first);
  uLong checksum = ::crc32(0, GetColor(image), static_cast<uInt>(this->ColorBytes * this->Texels));
  if (this->HasDepth)
  {
    checksum = ::crc32(checksum, reinterpret_cast<const Bytef*>(GetDepth(image)),
      static_cast<uInt>(this->Texels * sizeof(unsigned short)));
  }
  return static_cast<std::uint32_t>(checksum);
}

bool SlicePuller::Pull(const std::vector<int>& slices, std::string& error)
{
  if (this->Pulled.use_count() != 1)
  {
    // Nobody else references the new ones.
    this->Pulled = std::make_shared<Samples>();
  }
  this->Pulled->Color.resize(this->ColorBytes * this->Texels * slices.size());
  this->Pulled->Depth.resize(this->HasDepth ? this->Texels * slices.size() : 0);
  std::vector<std::pair<int, std::size_t>> sorted; // slice, place
  for (std::size_t place = 0; place < slices.size(); ++place)
  {
    sorted.emplace_back(this->Keys.ToWhole(slices[place]), place);
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t begin = 0; begin < sorted.size();)
  {
    std::size_t end = begin + 1;
    while (end < sorted.size() && sorted[end].first == sorted[end - 1].first + 1)
    {
      ++end;
    }
    const vtkSmartPointer<vtkImageData> image =
      this->Update(sorted[begin].first, sorted[end - 1].first, error);
    if (!image)
    {
      return false;
    }
    for (; begin < end; ++begin)
    {
      this->Copy(image, sorted[begin].first, sorted[begin].second);
    }
  }
  return true;
}

vtkSmartPointer<vtkImageData> SlicePuller::Update(int first, int last, std::string& error)
{
  int extent[6];
  this->Grid.GetWholeExtent(extent);
  extent[4] = first;
  extent[5] = last;
  vtkInformation* information = this->Information;
  information->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
  auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(
    vtkExecutive::PRODUCER()->GetExecutive(information));
  auto* image = executive && executive->Update(vtkExecutive::PRODUCER()->GetPort(information))
    ? vtkImageData::GetData(information)
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

void SlicePuller::Copy(vtkImageData* image, int slice, std::size_t place)
{
  const std::size_t offset = this->Texels * (slice - image->GetExtent()[4]);
  const std::size_t bytes = this->ColorBytes * this->Texels;
  unsigned char* to = this->Pulled->Color.data() + bytes * place;
  std::copy_n(GetColor(image) + this->ColorBytes * offset, bytes, to);
  if (this->IsFloat)
  {
    const auto* color = reinterpret_cast<const float*>(to);
    for (std::size_t texel = 0; texel < this->Texels; ++texel)
    {
      this->Clipped = this->Clipped || !IsCodable(color + 4 * texel);
    }
  }
  if (this->HasDepth)
  {
    std::copy_n(GetDepth(image) + offset, this->Texels,
      this->Pulled->Depth.begin() + static_cast<std::ptrdiff_t>(this->Texels * place));
  }
}

std::vector<ConstSlice> SlicePuller::GetSlices() const
{
  const Samples& pulled = *this->Pulled;
  std::vector<ConstSlice> slices(pulled.Color.size() / (this->ColorBytes * this->Texels));
  for (std::size_t place = 0; place < slices.size(); ++place)
  {
    slices[place].Color = pulled.Color.data() + this->ColorBytes * this->Texels * place;
    slices[place].IsFloat = this->IsFloat;
    slices[place].Depth = this->HasDepth ? pulled.Depth.data() + this->Texels * place : nullptr;
  }
  return slices;
}
}
