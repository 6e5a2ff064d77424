// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfRadianceFrames.h"

#include "Coding/cslfPerceptualQuantizer.h"
#include "Coding/cslfTrack.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace cslf
{
namespace
{
constexpr int Components = 4;

// Luma of ITU-R BT.709, and the ranges of its colour differences.
constexpr double RedLuma = 0.2126;
constexpr double GreenLuma = 0.7152;
constexpr double BlueLuma = 0.0722;
constexpr double BlueRange = 2.0 * (1.0 - BlueLuma);
constexpr double RedRange = 2.0 * (1.0 - RedLuma);

/// A function on [0,1], linear between many points.
class Curve
{
public:
  template <typename Function>
  explicit Curve(Function function)
    : Values(Steps + 2)
  {
    for (int step = 0; step <= Steps; ++step)
    {
      this->Values[step] = static_cast<float>(function(step / double(Steps)));
    }
    this->Values[Steps + 1] = this->Values[Steps];
  }

  float operator()(float x) const
  {
    const float place = Steps * std::clamp(x, 0.0F, 1.0F);
    const int step = static_cast<int>(place);
    const float low = this->Values[step];
    return low + (place - static_cast<float>(step)) * (this->Values[step + 1] - low);
  }

private:
  static constexpr int Steps = 1 << 14;
  std::vector<float> Values;
};

template <typename Sample, typename Frame>
Sample* GetRow(Frame* frame, int plane, int y)
{
  return reinterpret_cast<Sample*>(
    frame->data[plane] + static_cast<std::ptrdiff_t>(y) * frame->linesize[plane]);
}
}

bool IsCodable(const float* texel)
{
  return std::all_of(texel, texel + 3,
    [](float value) { return value >= 0.0F && value <= static_cast<float>(MaximumRadiance); });
}

void PutRadiance(const float* colors, AVPixelFormat format, AVFrame* frame)
{
  const int bits = BitsOfFormat(format);
  const double largest = (1 << bits) - 1;
  const double neutral = 1 << (bits - 1);
  const auto round = [=](double value)
  { return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, largest))); };
  for (int y = 0; y < frame->height; ++y)
  {
    auto* luma = GetRow<std::uint16_t>(frame, 0, y);
    auto* blue = GetRow<std::uint16_t>(frame, 1, y);
    auto* red = GetRow<std::uint16_t>(frame, 2, y);
    for (int x = 0; x < frame->width; ++x, colors += Components)
    {
      const double r = RadianceToPQ(colors[0]);
      const double g = RadianceToPQ(colors[1]);
      const double b = RadianceToPQ(colors[2]);
      const double sum = RedLuma * r + GreenLuma * g + BlueLuma * b;
      luma[x] = round(largest * sum);
      blue[x] = round(neutral + largest * (b - sum) / BlueRange);
      red[x] = round(neutral + largest * (r - sum) / RedRange);
    }
  }
}

void TakeRadiance(const AVFrame* frame, AVPixelFormat format, float* colors)
{
  static const Curve toRadiance(PQToRadiance);
  const int bits = BitsOfFormat(format);
  const float scale = 1.0F / static_cast<float>((1 << bits) - 1);
  const int neutral = 1 << (bits - 1);
  for (int y = 0; y < frame->height; ++y)
  {
    const auto* luma = GetRow<const std::uint16_t>(frame, 0, y);
    const auto* blue = GetRow<const std::uint16_t>(frame, 1, y);
    const auto* red = GetRow<const std::uint16_t>(frame, 2, y);
    for (int x = 0; x < frame->width; ++x, colors += Components)
    {
      const float sum = scale * luma[x];
      const float b = sum + static_cast<float>(BlueRange) * scale * (blue[x] - neutral);
      const float r = sum + static_cast<float>(RedRange) * scale * (red[x] - neutral);
      const float g = (sum - static_cast<float>(RedLuma) * r - static_cast<float>(BlueLuma) * b) /
        static_cast<float>(GreenLuma);
      colors[0] = toRadiance(r);
      colors[1] = toRadiance(g);
      colors[2] = toRadiance(b);
    }
  }
}

void TakeCoverage(const AVFrame* frame, float* colors)
{
  for (int y = 0; y < frame->height; ++y)
  {
    const auto* row = GetRow<const std::uint8_t>(frame, 0, y);
    for (int x = 0; x < frame->width; ++x, colors += Components)
    {
      colors[3] = row[x] / 255.0F;
    }
  }
}

void JoinRadiance(
  std::size_t texels, bool hasCoverage, int tolerance, float* colors, unsigned short* depths)
{
  constexpr unsigned short far = 65535;
  const float low = (tolerance + 0.5F) / 255.0F;
  const float high = 1.0F - low;
  for (std::size_t texel = 0; texel < texels; ++texel)
  {
    float* color = colors + Components * texel;
    if (!hasCoverage || color[3] > high)
    {
      color[3] = 1.0F;
    }
    else if (color[3] < low)
    {
      std::fill_n(color, Components, 0.0F);
      if (depths)
      {
        depths[texel] = far;
      }
    }
  }
}
}
