// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRadianceFrames.h"

#include "Coding/Codecs/cslfTrack.h"
#include "cslfColorRows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace cslf
{
namespace
{
// The constants of SMPTE ST 2084, section 5.
constexpr double M1 = 2610.0 / 16384.0;
constexpr double M2 = 128.0 * 2523.0 / 4096.0;
constexpr double C1 = 3424.0 / 4096.0;
constexpr double C2 = 32.0 * 2413.0 / 4096.0;
constexpr double C3 = 32.0 * 2392.0 / 4096.0;

/// The code of a radiance is the number of codes whose least radiance it reaches. The search is
/// among numbers that begin with the same bits.
class CodeFinder
{
public:
  CodeFinder()
    : Starts(Buckets + 1)
  {
    for (int code = 1; code <= MaximumPQCode; ++code)
    {
      this->Least.push_back(static_cast<float>(PQToRadiance((code - 0.5) / MaximumPQCode)));
    }
    for (std::uint32_t bucket = 0; bucket <= Buckets; ++bucket)
    {
      const std::uint32_t bits = bucket << LowBits;
      float first;
      std::memcpy(&first, &bits, sizeof(first));
      const auto begin = this->Least.begin();
      this->Starts[bucket] =
        static_cast<int>(std::lower_bound(begin, this->Least.end(), first) - begin);
    }
  }

  /// Of a number above 0.
  int Find(float radiance) const
  {
    std::uint32_t bits;
    std::memcpy(&bits, &radiance, sizeof(bits));
    const std::uint32_t bucket = bits >> LowBits;
    if (bucket >= Buckets)
    {
      return MaximumPQCode;
    }
    const auto begin = this->Least.begin();
    return static_cast<int>(
      std::upper_bound(begin + this->Starts[bucket], begin + this->Starts[bucket + 1], radiance) -
      begin);
  }

private:
  static constexpr int LowBits = 16;
  static constexpr std::uint32_t Buckets = 0x7f80; ///< up to infinity

  std::vector<float> Least;
  std::vector<int> Starts;
};
}

double RadianceToPQ(double radiance)
{
  // NaN becomes 0, too.
  const double luminance = radiance > 0.0 ? std::min(radiance / MaximumRadiance, 1.0) : 0.0;
  const double power = std::pow(luminance, M1);
  return std::pow((C1 + C2 * power) / (1.0 + C3 * power), M2);
}

double PQToRadiance(double signal)
{
  const double power = std::pow(std::clamp(signal, 0.0, 1.0), 1.0 / M2);
  const double luminance = std::pow(std::max(power - C1, 0.0) / (C2 - C3 * power), 1.0 / M1);
  return MaximumRadiance * luminance;
}

int RadianceToPQCode(float radiance)
{
  static const CodeFinder codes;
  // NaN becomes 0, too.
  return radiance > 0.0F ? codes.Find(radiance) : 0;
}

const std::vector<float>& GetCodedRadiances()
{
  static const std::vector<float> radiances = []
  {
    std::vector<float> all;
    for (int code = 0; code <= MaximumPQCode; ++code)
    {
      all.push_back(static_cast<float>(PQToRadiance(code / static_cast<double>(MaximumPQCode))));
    }
    return all;
  }();
  return radiances;
}

namespace
{
constexpr int Components = 4;

/// The bits of fraction of 16-bit codes that become samples, and of samples that become codes.
constexpr int FractionBitsOfSamples = 32;
constexpr int FractionBitsOfCodes = 14;

inline std::uint16_t MakeSample(const SampleWeights& w, const int codes[3])
{
  const std::int64_t sum = static_cast<std::int64_t>(w.Red) * codes[0] +
    static_cast<std::int64_t>(w.Green) * codes[1] + static_cast<std::int64_t>(w.Blue) * codes[2];
  return static_cast<std::uint16_t>(
    std::clamp<std::int64_t>((sum + w.Offset) >> w.Shift, 0, w.Largest));
}

inline int ToCode(int value)
{
  return std::clamp(value >> FractionBitsOfCodes, 0, MaximumPQCode);
}

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
  const auto weigh = [format](SamplePlane plane)
  { return MakeSampleWeights(plane, BitsOfFormat(format), MaximumPQCode, FractionBitsOfSamples); };
  const SampleWeights ofLuma = weigh(SamplePlane::Luma);
  const SampleWeights ofBlue = weigh(SamplePlane::Blue);
  const SampleWeights ofRed = weigh(SamplePlane::Red);
  for (int y = 0; y < frame->height; ++y)
  {
    auto* luma = GetRow<std::uint16_t>(frame, 0, y);
    auto* blue = GetRow<std::uint16_t>(frame, 1, y);
    auto* red = GetRow<std::uint16_t>(frame, 2, y);
    for (int x = 0; x < frame->width; ++x, colors += Components)
    {
      const int codes[3] = { RadianceToPQCode(colors[0]), RadianceToPQCode(colors[1]),
        RadianceToPQCode(colors[2]) };
      luma[x] = MakeSample(ofLuma, codes);
      blue[x] = MakeSample(ofBlue, codes);
      red[x] = MakeSample(ofRed, codes);
    }
  }
}

void TakeRadiance(const AVFrame* frame, AVPixelFormat format, double white, float* colors)
{
  const float unit = static_cast<float>(WhiteLuminance / white);
  const float* radiances = GetCodedRadiances().data();
  const ColorWeights w = MakeColorWeights(BitsOfFormat(format), MaximumPQCode, FractionBitsOfCodes);
  constexpr int half = 1 << (FractionBitsOfCodes - 1);
  for (int y = 0; y < frame->height; ++y)
  {
    const auto* luma = GetRow<const std::uint16_t>(frame, 0, y);
    const auto* blue = GetRow<const std::uint16_t>(frame, 1, y);
    const auto* red = GetRow<const std::uint16_t>(frame, 2, y);
    for (int x = 0; x < frame->width; ++x, colors += Components)
    {
      const int grey = luma[x] * w.Luma + half;
      const int cb = blue[x] - w.Middle;
      const int cr = red[x] - w.Middle;
      colors[0] = unit * radiances[ToCode(grey + cr * w.RedOfRed)];
      colors[1] = unit * radiances[ToCode(grey + cr * w.GreenOfRed + cb * w.GreenOfBlue)];
      colors[2] = unit * radiances[ToCode(grey + cb * w.BlueOfBlue)];
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

void JoinRadiance(std::size_t texels, bool hasCoverage, int tolerance, float* colors)
{
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
    }
  }
}
}
