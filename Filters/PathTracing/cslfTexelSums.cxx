// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelSums.h"

#include "cslfVectorize.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslf
{
namespace
{
constexpr int Size = TexelSums::Size;

/// About what a viewer sees of radiance, in [0,1].
inline float Display(float radiance, float exposure)
{
  const float exposed = radiance * exposure;
  return std::sqrt(exposed < 1.0f ? exposed : 1.0f);
}

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

/// The largest displayed standard error of a colour's component.
CSLF_VECTORIZE float FindError(const float* sums, const float* squares, float count, float exposure)
{
  float errors[Size];
  for (int lane = 0; lane < Size; ++lane)
  {
    const float mean = sums[lane] / count;
    const float spread = squares[lane] / count - mean * mean;
    const float variance = (spread > 0.0f ? spread : 0.0f) / (count - 1.0f);
    errors[lane] = Display(mean + std::sqrt(variance), exposure) - Display(mean, exposure);
  }
  return *std::max_element(errors, errors + Size);
}

/// How far a displayed component lies apart.
CSLF_VECTORIZE float FindRange(const float* sums, const int* inside, float count, float exposure)
{
  float lows[Size];
  float highs[Size];
  for (int lane = 0; lane < Size; ++lane)
  {
    const float shown = Display(sums[lane] / count, exposure);
    lows[lane] = inside[lane] ? shown : 1.0f;
    highs[lane] = inside[lane] ? shown : 0.0f;
  }
  return *std::max_element(highs, highs + Size) - *std::min_element(lows, lows + Size);
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
}

void TexelSums::AddSquares(const TexelGroup& group, const PacketRadiance& radiance)
{
  AddSquaredColors(*this, group, radiance);
}

CSLF_VECTORIZE void TexelSums::AddDepths(const TexelGroup& group, const RayPacket& packet,
  const PacketScale& scale, const float x[Size], const float y[Size])
{
  alignas(64) float depths[Size];
  alignas(64) float offsets[Size]; // the largest there are where nothing is hit
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

float TexelSums::GetNoise(float exposure) const
{
  const auto count = static_cast<float>(this->Samples);
  float noise = std::max({ FindError(this->Red, this->RedSquares, count, exposure),
    FindError(this->Green, this->GreenSquares, count, exposure),
    FindError(this->Blue, this->BlueSquares, count, exposure) });
  for (int covered : this->Covered)
  {
    const float alpha = static_cast<float>(covered) / count;
    noise = std::max(noise, std::sqrt(alpha * (1.0f - alpha) / (count - 1.0f)));
  }
  return noise;
}

float TexelSums::GetRange(float exposure, const int inside[Size]) const
{
  for (int lane = 0; lane < Size; ++lane)
  {
    if (inside[lane] && this->Covered[lane] != this->Covered[0])
    {
      return std::numeric_limits<float>::infinity();
    }
  }
  const auto count = static_cast<float>(this->Samples);
  return std::max({ FindRange(this->Red, inside, count, exposure),
    FindRange(this->Green, inside, count, exposure),
    FindRange(this->Blue, inside, count, exposure) });
}
}
