// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfStoppingRule.h"

#include "SIMD/cslfVectorize.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// If one sample is to be enough, colours may differ by this many noise targets across the 4 texels
// of a square's side and half a texel around it. On a gradient, the root mean square error of a
// sample at a random place in its texel is then about half the target.
constexpr float RangeOfTarget = 8.0f;

/// Joins the bounds of two halves.
template <int Half>
inline void Fold(float* lows, float* highs)
{
  for (int lane = 0; lane < Half; ++lane)
  {
    lows[lane] = lows[lane + Half] < lows[lane] ? lows[lane + Half] : lows[lane];
    highs[lane] = highs[lane + Half] > highs[lane] ? highs[lane + Half] : highs[lane];
  }
}

/// Extends bounds by the values inside.
CSLF_VECTORIZE void ExtendBounds(const float* values, const int* inside, float& low, float& high)
{
  float lows[TexelSums::Size];
  float highs[TexelSums::Size];
  for (int lane = 0; lane < TexelSums::Size; ++lane)
  {
    const float forLow = inside[lane] ? values[lane] : low;
    const float forHigh = inside[lane] ? values[lane] : high;
    lows[lane] = forLow < low ? forLow : low;
    highs[lane] = forHigh > high ? forHigh : high;
  }
  Fold<TexelSums::Size / 2>(lows, highs);
  Fold<TexelSums::Size / 4>(lows, highs);
  Fold<TexelSums::Size / 8>(lows, highs);
  Fold<TexelSums::Size / 16>(lows, highs);
  low = lows[0];
  high = highs[0];
}

void FindCovered(const TexelSums& sums, int* covered)
{
  for (int texel = 0; texel < TexelSums::Size; ++texel)
  {
    covered[texel] = sums.Covered[texel] > 0.0f ? -1 : 0;
  }
}

/// The fewest samples that have a variance.
constexpr int MinimumForVariance = 2;

glm::vec3 FindMean(const ColorSamples& samples)
{
  return samples.Sum / static_cast<float>(samples.Count);
}

/// The variance of at least two samples.
glm::vec3 FindVariance(const ColorSamples& samples)
{
  const auto count = static_cast<float>(samples.Count);
  const glm::vec3 mean = FindMean(samples);
  return glm::max(samples.Squares - count * mean * mean, glm::vec3(0.0f)) / (count - 1.0f);
}
}

void ColorBounds::Add(
  const float* red, const float* green, const float* blue, const int* covered, const int* inside)
{
  this->AddCoverage(covered, inside);
  if (this->SomeCovered)
  {
    ExtendBounds(red, inside, this->Low.x, this->High.x);
    ExtendBounds(green, inside, this->Low.y, this->High.y);
    ExtendBounds(blue, inside, this->Low.z, this->High.z);
  }
}

void ColorBounds::Add(const TexelSums& sums, const int* inside)
{
  alignas(64) int covered[TexelSums::Size];
  FindCovered(sums, covered);
  const PacketRadiance& radiance = sums.GetRadiance();
  this->Add(radiance.Red, radiance.Green, radiance.Blue, covered, inside);
}

void ColorBounds::AddCoverage(const TexelSums& sums, const int* inside)
{
  alignas(64) int covered[TexelSums::Size];
  FindCovered(sums, covered);
  this->AddCoverage(covered, inside);
}

void ColorBounds::AddCoverage(const int* covered, const int* inside)
{
  int someCovered = 0;
  int someEmpty = 0;
  for (int lane = 0; lane < TexelSums::Size; ++lane)
  {
    const int isCovered = covered[lane] != 0 ? -1 : 0;
    someCovered |= inside[lane] & isCovered;
    someEmpty |= inside[lane] & ~isCovered;
  }
  this->SomeCovered |= someCovered != 0;
  this->SomeEmpty |= someEmpty != 0;
}

float ColorBounds::GetRange(const DisplayCurve& display) const
{
  const glm::vec3 range = display(this->High) - display(glm::min(this->Low, this->High));
  return std::max({ range.x, range.y, range.z });
}

bool StoppingRule::IsPlain(const ColorBounds& seen) const
{
  return !seen.AreMixed() && seen.GetRange(this->Display) <= RangeOfTarget * this->Target;
}

void StoppingRule::TakeByOthers(const bool needs[TexelSums::Size],
  const bool lacks[TexelSums::Size], const int inside[TexelSums::Size], TexelSums& sums)
{
  int texels = 0;
  int needing = 0;
  for (int texel = 0; texel < TexelSums::Size; ++texel)
  {
    texels += inside[texel] ? 1 : 0;
    needing += inside[texel] && needs[texel] ? 1 : 0;
  }
  if (texels > 1 && needing <= 1)
  {
    // A single texel that needs more has enough itself, as none of the others needs more.
    int enough[TexelSums::Size];
    for (int texel = 0; texel < TexelSums::Size; ++texel)
    {
      const bool isEnough = !lacks[texel] && (needing == 0 || needs[texel]);
      enough[texel] = !inside[texel] || isEnough ? -1 : 0;
    }
    sums.Take(enough);
  }
}

void StoppingRule::TakeSingle(
  const ColorBounds& expected, const int inside[TexelSums::Size], TexelSums& sums) const
{
  bool needs[TexelSums::Size] = {};
  bool lacks[TexelSums::Size];
  int own[TexelSums::Size];
  for (int texel = 0; texel < TexelSums::Size; ++texel)
  {
    lacks[texel] = inside[texel] && sums.GetColorSamples(texel).Count == 0;
    own[texel] = lacks[texel] ? 0 : inside[texel];
  }
  ColorBounds all = expected;
  all.AddCoverage(sums, inside);
  all.Add(sums, own);
  const bool areFollowed =
    std::any_of(sums.Paths, sums.Paths + TexelSums::Size, [](int n) { return n > 0; });
  if (areFollowed || !this->IsPlain(all))
  {
    int one[TexelSums::Size] = {};
    for (int texel = 0; texel < TexelSums::Size; ++texel)
    {
      one[texel] = lacks[texel] ? 0 : -1;
      ColorBounds bounds = expected;
      bounds.Add(sums, one);
      needs[texel] = sums.Paths[texel] > 0 || !this->IsPlain(bounds);
      one[texel] = 0;
    }
  }
  TakeByOthers(needs, lacks, inside, sums);
}

void StoppingRule::Take(const ColorBounds& expected, const glm::vec3& elsewhere,
  const int inside[TexelSums::Size], TexelSums& sums) const
{
  // Half of the samples of a texel may see a surface, and half of them none.
  if (expected.AreMixed() && this->IsNoisyCoverage(0.25f, sums.Samples))
  {
    return;
  }
  bool needs[TexelSums::Size];
  bool lacks[TexelSums::Size];
  for (int texel = 0; texel < TexelSums::Size; ++texel)
  {
    lacks[texel] = inside[texel] && sums.GetColorSamples(texel).Count < MinimumForVariance;
    needs[texel] = lacks[texel] || (inside[texel] && this->IsNoisy(sums, texel, elsewhere));
  }
  TakeByOthers(needs, lacks, inside, sums);
}

bool StoppingRule::IsNoisyCoverage(float variance, int samples) const
{
  return variance > static_cast<float>(samples - 1) * this->Target * this->Target;
}

bool StoppingRule::IsNoisy(const TexelSums& sums, int texel, const glm::vec3& elsewhere) const
{
  const float alpha = sums.Covered[texel] / static_cast<float>(sums.Samples);
  const float partial = sums.Partial[texel] / static_cast<float>(sums.Samples);
  if (this->IsNoisyCoverage(alpha * (1.0f - alpha) - partial, sums.Samples))
  {
    return true;
  }
  const ColorSamples samples = sums.GetColorSamples(texel);
  const auto count = static_cast<float>(samples.Count);
  const glm::vec3 mean = FindMean(samples);
  glm::vec3 variance = FindVariance(samples);
  if (sums.Paths[texel] > 0)
  {
    variance = ((count - 1.0f) * variance + elsewhere) / count;
  }
  const glm::vec3 error = glm::sqrt(variance / count);
  // Upwards and downwards: a mean that is clipped at white may be that of a single bright sample.
  const glm::vec3 shown = this->Display(mean + error) - this->Display(mean - error);
  return std::max({ shown.x, shown.y, shown.z }) > 2.0f * this->Target;
}

PathVariance StoppingRule::GetVariance(const TexelSums& sums)
{
  PathVariance variance;
  for (int texel = 0; texel < TexelSums::Size; ++texel)
  {
    const ColorSamples samples = sums.GetColorSamples(texel);
    if (sums.Paths[texel] > 0 && samples.Count >= MinimumForVariance)
    {
      variance.Sum += FindVariance(samples);
      ++variance.Texels;
    }
  }
  return variance;
}
}
