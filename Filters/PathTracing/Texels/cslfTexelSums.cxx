// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelSums.h"

#include "SIMD/cslfVectorize.h"

#include <algorithm>
#include <limits>

namespace cslf
{
namespace
{
constexpr int Size = TexelSums::Size;

template <int Texels, typename Value>
inline void AddSamples(Value* __restrict sums, const Value* __restrict values)
{
  for (int sample = 0; sample < Size / Texels; ++sample)
  {
    for (int texel = 0; texel < Texels; ++texel)
    {
      sums[texel] += values[sample * Texels + texel];
    }
  }
}

/// Adds the values of a packet's samples to those of their texels.
template <typename Value>
inline void AddTo(Value* sums, const TexelGroup& group, const Value* values)
{
  switch (group.Size)
  {
    case Size:
      AddSamples<Size>(sums, values);
      break;
    case 4:
      AddSamples<4>(sums + group.First, values);
      break;
    default:
      AddSamples<1>(sums + group.First, values);
      break;
  }
}

CSLF_VECTORIZE void AddColors(
  TexelSums& sums, const TexelGroup& group, const PacketRadiance& radiance, const int* counts)
{
  AddTo(sums.Red, group, radiance.Red);
  AddTo(sums.Green, group, radiance.Green);
  AddTo(sums.Blue, group, radiance.Blue);
  AddTo(sums.Covered, group, counts);
}

CSLF_VECTORIZE void AddSquaredColors(
  TexelSums& sums, const TexelGroup& group, const PacketRadiance& radiance)
{
  PacketRadiance squares;
  for (int lane = 0; lane < Size; ++lane)
  {
    squares.Red[lane] = radiance.Red[lane] * radiance.Red[lane];
    squares.Green[lane] = radiance.Green[lane] * radiance.Green[lane];
    squares.Blue[lane] = radiance.Blue[lane] * radiance.Blue[lane];
  }
  AddTo(sums.RedSquares, group, squares.Red);
  AddTo(sums.GreenSquares, group, squares.Green);
  AddTo(sums.BlueSquares, group, squares.Blue);
}
}

TexelSums::TexelSums()
{
  std::fill_n(this->Depth, Size, 1.0f);
  std::fill_n(this->DepthOffset, Size, std::numeric_limits<float>::max());
}

void TexelSums::Add(
  const TexelGroup& group, const PacketRadiance& radiance, const int covered[Size])
{
  alignas(64) int counts[Size];
  for (int lane = 0; lane < Size; ++lane)
  {
    counts[lane] = -covered[lane];
  }
  AddColors(*this, group, radiance, counts);
}

void TexelSums::AddPath(int texel, const glm::vec3& radiance)
{
  this->Red[texel] += radiance.x;
  this->Green[texel] += radiance.y;
  this->Blue[texel] += radiance.z;
  this->RedSquares[texel] += radiance.x * radiance.x;
  this->GreenSquares[texel] += radiance.y * radiance.y;
  this->BlueSquares[texel] += radiance.z * radiance.z;
  ++this->Covered[texel];
  ++this->Paths[texel];
}

void TexelSums::AddSquares(const TexelGroup& group, const PacketRadiance& radiance)
{
  AddSquaredColors(*this, group, radiance);
}

CSLF_VECTORIZE void TexelSums::AddDepths(const TexelGroup& group, const RayPacket& packet,
  const PacketScale& scale, const float x[Size], const float y[Size])
{
  alignas(64) float depths[Size];
  alignas(64) float offsets[Size]; // the largest values if nothing is hit
  CSLF_LANE_LOOP
  for (int lane = 0; lane < Size; ++lane)
  {
    const float offsetX = x[lane] - 0.5f;
    const float offsetY = y[lane] - 0.5f;
    const int isHit = static_cast<int>(packet.Query.hit.geomID[lane]) == -1 ? 0 : -1;
    const float offset = offsetX * offsetX + offsetY * offsetY;
    offsets[lane] = isHit ? offset : std::numeric_limits<float>::max();
    depths[lane] = scale.Start[lane] + packet.Query.ray.tfar[lane] / scale.Length[lane];
  }
  for (int first = 0; first < Size; first += group.Size)
  {
    CSLF_LANE_LOOP
    for (int i = 0; i < group.Size; ++i)
    {
      const int texel = group.First + i;
      const bool isNearer = offsets[first + i] < this->DepthOffset[texel];
      this->Depth[texel] = isNearer ? depths[first + i] : this->Depth[texel];
      this->DepthOffset[texel] = isNearer ? offsets[first + i] : this->DepthOffset[texel];
    }
  }
}

void TexelMeans::Take(int texel, const TexelSums& sums)
{
  if (this->Samples[texel] == 0)
  {
    this->Samples[texel] = sums.Samples;
    this->Covered[texel] = sums.Covered[texel];
    this->Red[texel] = sums.Red[texel];
    this->Green[texel] = sums.Green[texel];
    this->Blue[texel] = sums.Blue[texel];
    ++this->Taken;
  }
}

void TexelMeans::TakeAll(const TexelSums& sums)
{
  if (this->Taken == 0)
  {
    std::fill_n(this->Samples, Size, sums.Samples);
    std::copy_n(sums.Covered, Size, this->Covered);
    std::copy_n(sums.Red, Size, this->Red);
    std::copy_n(sums.Green, Size, this->Green);
    std::copy_n(sums.Blue, Size, this->Blue);
    this->Taken = Size;
  }
  for (int texel = 0; texel < Size && this->Taken < Size; ++texel)
  {
    this->Take(texel, sums);
  }
}
}
