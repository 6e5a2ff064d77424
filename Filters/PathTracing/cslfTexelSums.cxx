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

CSLF_VECTORIZE void AddTo(float* __restrict sums, const float* __restrict values)
{
  for (int lane = 0; lane < Size; ++lane)
  {
    sums[lane] += values[lane];
  }
}

CSLF_VECTORIZE void AddSquaresTo(float* __restrict sums, const float* __restrict values)
{
  for (int lane = 0; lane < Size; ++lane)
  {
    sums[lane] += values[lane] * values[lane];
  }
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

void TexelSums::Add(const PacketRadiance& radiance, const int covered[Size])
{
  AddTo(this->Red, radiance.Red);
  AddTo(this->Green, radiance.Green);
  AddTo(this->Blue, radiance.Blue);
  for (int lane = 0; lane < Size; ++lane)
  {
    this->Covered[lane] -= covered[lane];
  }
  ++this->Samples;
}

void TexelSums::AddPath(int lane, const glm::vec3& radiance)
{
  this->Red[lane] += radiance.x;
  this->Green[lane] += radiance.y;
  this->Blue[lane] += radiance.z;
  this->RedSquares[lane] += radiance.x * radiance.x;
  this->GreenSquares[lane] += radiance.y * radiance.y;
  this->BlueSquares[lane] += radiance.z * radiance.z;
  ++this->Covered[lane];
}

void TexelSums::AddSquares(const PacketRadiance& radiance)
{
  AddSquaresTo(this->RedSquares, radiance.Red);
  AddSquaresTo(this->GreenSquares, radiance.Green);
  AddSquaresTo(this->BlueSquares, radiance.Blue);
}

CSLF_VECTORIZE void TexelSums::AddDepths(
  const RayPacket& packet, const PacketScale& scale, const float x[Size], const float y[Size])
{
  CSLF_LANE_LOOP
  for (int lane = 0; lane < Size; ++lane)
  {
    const float offsetX = x[lane] - 0.5f;
    const float offsetY = y[lane] - 0.5f;
    const float offset = offsetX * offsetX + offsetY * offsetY;
    const int isHit = static_cast<int>(packet.Query.hit.geomID[lane]) == -1 ? 0 : -1;
    const int isNearer = (offset < this->DepthOffset[lane] ? -1 : 0) & isHit;
    const float depth = scale.Start[lane] + packet.Query.ray.tfar[lane] / scale.Length[lane];
    this->Depth[lane] = isNearer ? depth : this->Depth[lane];
    this->DepthOffset[lane] = isNearer ? offset : this->DepthOffset[lane];
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
