// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfColorFrames.h"

#include "Coding/Codecs/cslfTrack.h"
#include "cslfColor.h"
#include "cslfColorRows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace cslf
{
namespace
{
/// The bits of fraction of byte colours, and of subsampled ones, when they become samples.
constexpr int FractionBits = 17;
constexpr int SparseFractionBits = 14;

/// The planes of a planar RGB frame hold green, blue, red.
constexpr int PlaneOfComponent[3] = { 2, 0, 1 };

template <typename Frame>
std::uint8_t* GetRow(Frame* frame, int plane, int y)
{
  return frame->data[plane] + static_cast<std::ptrdiff_t>(y) * frame->linesize[plane];
}

template <typename Byte, typename Frame>
Byte* GetColors(Byte* colors, const Frame* frame, int y)
{
  return colors + ColorBytes * static_cast<std::ptrdiff_t>(y) * frame->width;
}

void PutRGB(const unsigned char* colors, AVFrame* frame)
{
  for (int y = 0; y < frame->height; ++y)
  {
    const unsigned char* row = GetColors(colors, frame, y);
    for (int component = 0; component < 3; ++component)
    {
      std::uint8_t* samples = GetRow(frame, PlaneOfComponent[component], y);
      for (int x = 0; x < frame->width; ++x)
      {
        samples[x] = row[ColorBytes * x + component];
      }
    }
  }
}

void TakeRGB(const AVFrame* frame, unsigned char* colors)
{
  for (int y = 0; y < frame->height; ++y)
  {
    unsigned char* row = GetColors(colors, frame, y);
    const std::uint8_t* red = GetRow(frame, PlaneOfComponent[0], y);
    const std::uint8_t* green = GetRow(frame, PlaneOfComponent[1], y);
    const std::uint8_t* blue = GetRow(frame, PlaneOfComponent[2], y);
    for (int x = 0; x < frame->width; ++x)
    {
      row[ColorBytes * x] = red[x];
      row[ColorBytes * x + 1] = green[x];
      row[ColorBytes * x + 2] = blue[x];
      row[ColorBytes * x + 3] = 255;
    }
  }
}

/// A plane with half the columns of luma and as many rows, or half of them.
void PutSparse(const unsigned char* colors, const SampleWeights& weights, int bits, int tile,
  int plane, AVFrame* frame)
{
  const int step =
    1 << av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame->format))->log2_chroma_h;
  const auto getRow = [&](int y)
  { return GetColors(colors, frame, std::clamp(y, 0, frame->height - 1)); };
  std::vector<int> scratch(tile + 3);
  for (int y = 0; y < frame->height; y += step)
  {
    const int apart = step - 1; // 0 if each row has its own
    const unsigned char* const rows[4] = { getRow(y - apart), getRow(y), getRow(y + apart),
      getRow(y + 2 * apart) };
    ColorsToChroma(
      rows, weights, bits, tile, frame->width, scratch.data(), GetRow(frame, plane, y / step));
  }
}

/// Y'CbCr whose chroma has half the columns of luma and as many rows, or half of them.
void TakeSpread(const AVFrame* frame, const AVPixFmtDescriptor& format, ChromaSiting siting,
  int tile, unsigned char* colors)
{
  const int bits = format.comp[0].depth;
  const bool isHalf = format.log2_chroma_h > 0;
  const int last = (isHalf ? frame->height / 2 : frame->height) - 1;
  std::vector<std::uint16_t> scratch(tile / 2 + 2);
  std::vector<std::uint16_t> chroma[2];
  for (int y = 0; y < frame->height; ++y)
  {
    const int near = isHalf ? y / 2 : y;
    const int far = isHalf ? std::clamp(y % 2 == 0 ? near - 1 : near + 1, 0, last) : near;
    for (int k = 0; k < 2; ++k)
    {
      chroma[k].resize(frame->width);
      SpreadChroma(GetRow(frame, 1 + k, near), GetRow(frame, 1 + k, far), bits, siting, tile,
        frame->width, scratch.data(), chroma[k].data());
    }
    SpreadToColors(GetRow(frame, 0, y), chroma[0].data(), chroma[1].data(), bits, frame->width,
      GetColors(colors, frame, y));
  }
}
}

void PutColors(const unsigned char* colors, int tile, AVFrame* frame)
{
  const AVPixFmtDescriptor& format =
    *av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame->format));
  if (format.flags & AV_PIX_FMT_FLAG_RGB)
  {
    PutRGB(colors, frame);
    return;
  }
  const int bits = format.comp[0].depth;
  const bool isFull = frame->color_range != AVCOL_RANGE_MPEG;
  for (const SamplePlane plane : { SamplePlane::Luma, SamplePlane::Blue, SamplePlane::Red })
  {
    if (plane != SamplePlane::Luma && format.log2_chroma_w > 0)
    {
      PutSparse(colors, MakeSampleWeights(plane, bits, 255, SparseFractionBits, isFull), bits, tile,
        static_cast<int>(plane), frame);
      continue;
    }
    const SampleWeights weights = MakeSampleWeights(plane, bits, 255, FractionBits, isFull);
    for (int y = 0; y < frame->height; ++y)
    {
      ColorsToSamples(GetColors(colors, frame, y), weights, bits, frame->width,
        GetRow(frame, static_cast<int>(plane), y));
    }
  }
}

void TakeColors(const AVFrame* frame, AVPixelFormat format, AVChromaLocation location, int tile,
  unsigned char* colors)
{
  const AVPixFmtDescriptor& samples = *av_pix_fmt_desc_get(format);
  if (samples.flags & AV_PIX_FMT_FLAG_RGB)
  {
    TakeRGB(frame, colors);
    return;
  }
  if (samples.log2_chroma_w > 0)
  {
    const ChromaSiting siting = location == AVCHROMA_LOC_LEFT ? LeftSiting : CenterSiting;
    TakeSpread(frame, samples, siting, tile, colors);
    return;
  }
  for (int y = 0; y < frame->height; ++y)
  {
    const YCbCrRow row{ GetRow(frame, 0, y), GetRow(frame, 1, y), GetRow(frame, 2, y) };
    YCbCrToColors(row, samples.comp[0].depth, frame->width, GetColors(colors, frame, y));
  }
}

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
