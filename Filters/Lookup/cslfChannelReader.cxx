// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lookup/cslfChannelReader.h"

#include "Lookup/cslfLookup.h"
#include "Lookup/cslfLookupConstants.h"

#include <vtkDataArray.h>

#include <glm/common.hpp>

#include <algorithm>
#include <numeric>

namespace cslf
{
namespace
{
double ScaleOf(vtkDataArray* values)
{
  const int type = values ? values->GetDataType() : VTK_VOID;
  return type == VTK_UNSIGNED_CHAR ? 1.0 / 255.0 : type == VTK_UNSIGNED_SHORT ? 1.0 / 65535.0 : 1.0;
}
}

ChannelReader::ChannelReader(
  const Layout& grid, vtkDataArray* values, const std::vector<int>& slices)
  : Grid(grid)
  , Values(values)
  , Scale(ScaleOf(values))
  , Strips(grid.GetSlices(), -1)
{
  if (slices.empty())
  {
    std::iota(this->Strips.begin(), this->Strips.end(), 0);
  }
  for (std::size_t strip = 0; strip < slices.size(); ++strip)
  {
    this->Strips[slices[strip]] = static_cast<int>(strip);
  }
}

glm::dvec2 ChannelReader::TexelPosition(const Place& place) const
{
  return 0.5 * (place.Coordinates + 1.0) * static_cast<double>(this->Grid.GetResolution());
}

vtkIdType ChannelReader::TexelIndex(const Place& place, int p, int q) const
{
  const int resolution = this->Grid.GetResolution();
  const vtkIdType row = static_cast<vtkIdType>(this->Strips[place.Slice]) * resolution +
    std::clamp(q, 0, resolution - 1);
  return row * this->Grid.GetStripWidth() + place.Tile * resolution +
    std::clamp(p, 0, resolution - 1);
}

double ChannelReader::FetchNumber(const Place& place, int p, int q) const
{
  return this->Scale * this->Values->GetComponent(this->TexelIndex(place, p, q), 0);
}

glm::dvec4 ChannelReader::Fetch(const Place& place, int p, int q) const
{
  double value[4] = { 0.0, 0.0, 0.0, 0.0 };
  this->Values->GetTuple(this->TexelIndex(place, p, q), value);
  return this->Scale * glm::dvec4(value[0], value[1], value[2], value[3]);
}

glm::dvec4 ChannelReader::ReadNearest(const Place& place) const
{
  const glm::ivec2 texel(glm::floor(this->TexelPosition(place)));
  return this->Fetch(place, texel.x, texel.y);
}

glm::dvec4 ChannelReader::Read(const Place& place) const
{
  const glm::dvec2 position = this->TexelPosition(place) - 0.5;
  const glm::ivec2 base(glm::floor(position));
  const glm::dvec2 weight = position - glm::dvec2(base);
  return glm::mix(
    glm::mix(this->Fetch(place, base.x, base.y), this->Fetch(place, base.x + 1, base.y), weight.x),
    glm::mix(
      this->Fetch(place, base.x, base.y + 1), this->Fetch(place, base.x + 1, base.y + 1), weight.x),
    weight.y);
}

glm::dvec4 ChannelReader::Blend(const LookupResult& result) const
{
  glm::dvec4 value(0.0);
  double sum = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    const double weight = result.Weights[k];
    if (weight > 0.0)
    {
      const Place& place = result.Places[k];
      value += weight * (result.IsNearest ? this->ReadNearest(place) : this->Read(place));
      sum += weight;
    }
  }
  return value / std::max(sum, lookup::MinimumWeight);
}

glm::dvec4 ChannelReader::Blend(const Sightings& found) const
{
  const double most = std::max(this->Grid.GetResolution() - 2.0, 0.0);
  glm::dvec4 value(0.0);
  for (int k = 0; k < found.Count; ++k)
  {
    const Sighting& sighting = found.All[k];
    if (sighting.Share <= 0.0)
    {
      continue;
    }
    const glm::ivec2 base(
      glm::clamp(glm::floor(this->TexelPosition(sighting.At) - 0.5), 0.0, most));
    for (int texel = 0; texel < 4; ++texel)
    {
      value += found.Weights[k] / sighting.Share * sighting.Texels[texel] *
        this->Fetch(sighting.At, base.x + TexelCorners[texel][0], base.y + TexelCorners[texel][1]);
    }
  }
  return value.w > 0.0 ? value / value.w : glm::dvec4(0.0);
}
}
