// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfColorRows.h"

#include "SIMD/cslfVectorize.h"

#include <vtkEndian.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cslf
{
namespace
{
/// The four bytes of a texel as one number, so that a texel fits in a vector's lane. The shift of
/// each byte depends on the machine's byte order.
struct TexelBytes
{
#ifdef VTK_WORDS_BIGENDIAN
  static constexpr int Red = 24;
  static constexpr int Green = 16;
  static constexpr int Blue = 8;
  static constexpr int Coverage = 0;
#else
  static constexpr int Red = 0;
  static constexpr int Green = 8;
  static constexpr int Blue = 16;
  static constexpr int Coverage = 24;
#endif
};

inline std::uint32_t ReadTexel(const unsigned char* colors, int k)
{
  std::uint32_t texel;
  std::memcpy(&texel, colors + 4 * static_cast<std::ptrdiff_t>(k), sizeof(texel));
  return texel;
}

inline void WriteTexel(std::uint32_t texel, unsigned char* colors, int k)
{
  std::memcpy(colors + 4 * static_cast<std::ptrdiff_t>(k), &texel, sizeof(texel));
}

// Luma of ITU-R BT.709, and the ranges of its colour differences.
constexpr double RedShare = 0.2126;
constexpr double GreenShare = 0.7152;
constexpr double BlueShare = 0.0722;
constexpr double RedRange = 2.0 * (1.0 - RedShare);
constexpr double BlueRange = 2.0 * (1.0 - BlueShare);

/// The bits of fraction of byte colours.
constexpr int FractionBitsOfSums = 20;

/// The scale of chroma after SpreadChroma.
constexpr int SpreadScale = 16;

int ToInteger(double weight)
{
  return static_cast<int>(std::lround(weight));
}

inline std::uint32_t ToByte(int value)
{
  return static_cast<std::uint32_t>(std::min(std::max(value >> FractionBitsOfSums, 0), 255));
}

template <typename Luma, typename Chroma>
inline void ConvertRow(const Luma* luma, const Chroma* blue, const Chroma* red,
  const ColorWeights& weights, int count, unsigned char* colors)
{
  const ColorWeights w = weights;
  constexpr int half = 1 << (FractionBitsOfSums - 1);
  CSLF_LANE_LOOP
  for (int k = 0; k < count; ++k)
  {
    const int grey = luma[k] * w.Luma + half;
    const int cb = blue[k] - w.Middle;
    const int cr = red[k] - w.Middle;
    WriteTexel(ToByte(grey + cr * w.RedOfRed) << TexelBytes::Red |
        ToByte(grey + cr * w.GreenOfRed + cb * w.GreenOfBlue) << TexelBytes::Green |
        ToByte(grey + cb * w.BlueOfBlue) << TexelBytes::Blue | 255u << TexelBytes::Coverage,
      colors, k);
  }
}

template <typename Sample>
const Sample* Cast(const std::uint8_t* samples)
{
  return reinterpret_cast<const Sample*>(samples);
}

CSLF_VECTORIZE void ConvertBytes(
  const YCbCrRow& row, const ColorWeights& weights, int count, unsigned char* colors)
{
  ConvertRow(row.Luma, row.Blue, row.Red, weights, count, colors);
}

CSLF_VECTORIZE void ConvertWords(
  const YCbCrRow& row, const ColorWeights& weights, int count, unsigned char* colors)
{
  ConvertRow(Cast<std::uint16_t>(row.Luma), Cast<std::uint16_t>(row.Blue),
    Cast<std::uint16_t>(row.Red), weights, count, colors);
}

CSLF_VECTORIZE void ConvertSpreadBytes(const std::uint8_t* luma, const std::uint16_t* blue,
  const std::uint16_t* red, const ColorWeights& weights, int count, unsigned char* colors)
{
  ConvertRow(luma, blue, red, weights, count, colors);
}

CSLF_VECTORIZE void ConvertSpreadWords(const std::uint8_t* luma, const std::uint16_t* blue,
  const std::uint16_t* red, const ColorWeights& weights, int count, unsigned char* colors)
{
  ConvertRow(Cast<std::uint16_t>(luma), blue, red, weights, count, colors);
}

/// One tile: sums two rows, then adds neighbours.
template <typename Sample>
inline void Spread(const Sample* near, const Sample* far, ChromaSiting siting, int count,
  std::uint16_t* scratch, std::uint16_t* chroma)
{
  std::uint16_t* sums = scratch + 1;
  CSLF_LANE_LOOP
  for (int k = 0; k < count; ++k)
  {
    sums[k] = static_cast<std::uint16_t>(3 * near[k] + far[k]);
  }
  sums[-1] = sums[0];
  sums[count] = sums[count - 1];
  const int even = siting.Even;
  const int odd = siting.Odd;
  CSLF_LANE_LOOP
  for (int k = 0; k < count; ++k)
  {
    chroma[2 * k] = static_cast<std::uint16_t>(even * sums[k] + (4 - even) * sums[k - 1]);
    chroma[2 * k + 1] = static_cast<std::uint16_t>(odd * sums[k] + (4 - odd) * sums[k + 1]);
  }
}

CSLF_VECTORIZE void SpreadBytes(const std::uint8_t* near, const std::uint8_t* far,
  ChromaSiting siting, int count, std::uint16_t* scratch, std::uint16_t* chroma)
{
  Spread(near, far, siting, count, scratch, chroma);
}

CSLF_VECTORIZE void SpreadWords(const std::uint16_t* near, const std::uint16_t* far,
  ChromaSiting siting, int count, std::uint16_t* scratch, std::uint16_t* chroma)
{
  Spread(near, far, siting, count, scratch, chroma);
}

inline int Weigh(const SampleWeights& w, std::uint32_t texel)
{
  const auto byte = [texel](int place) { return static_cast<int>(texel >> place & 255u); };
  return w.Red * byte(TexelBytes::Red) + w.Green * byte(TexelBytes::Green) +
    w.Blue * byte(TexelBytes::Blue);
}

template <typename Sample>
inline void MakeSamples(
  const unsigned char* colors, const SampleWeights& weights, int count, Sample* samples)
{
  const SampleWeights w = weights;
  const int offset = static_cast<int>(w.Offset);
  CSLF_LANE_LOOP
  for (int k = 0; k < count; ++k)
  {
    const int value = (Weigh(w, ReadTexel(colors, k)) + offset) >> w.Shift;
    samples[k] = static_cast<Sample>(std::min(std::max(value, 0), w.Largest));
  }
}

CSLF_VECTORIZE void MakeBytes(
  const unsigned char* colors, const SampleWeights& weights, int count, std::uint8_t* samples)
{
  MakeSamples(colors, weights, count, samples);
}

CSLF_VECTORIZE void MakeWords(
  const unsigned char* colors, const SampleWeights& weights, int count, std::uint16_t* samples)
{
  MakeSamples(colors, weights, count, samples);
}

/// One tile: weighted sums of the rows, then every second one with its neighbours.
template <typename Sample>
inline void Gather(const unsigned char* const rows[4], const SampleWeights& weights, int tile,
  int* scratch, Sample* samples)
{
  constexpr int scaleBits = 6; // eighths of eighths
  const SampleWeights w = weights;
  const unsigned char* const row[4] = { rows[0], rows[1], rows[2], rows[3] };
  int* sums = scratch + 2;
  CSLF_LANE_LOOP
  for (int k = 0; k < tile; ++k)
  {
    const auto weigh = [&](int which) { return Weigh(w, ReadTexel(row[which], k)); };
    sums[k] = 5 * (weigh(1) + weigh(2)) - (weigh(0) + weigh(3));
  }
  sums[-2] = sums[0];
  sums[-1] = sums[0];
  sums[tile] = sums[tile - 1];
  const int offset = static_cast<int>(w.Offset * (1 << scaleBits));
  const int shift = w.Shift + scaleBits;
  CSLF_LANE_LOOP
  for (int k = 0; k < tile / 2; ++k)
  {
    const int* sum = sums + 2 * static_cast<std::ptrdiff_t>(k);
    const int value = (6 * sum[0] + 2 * (sum[-1] + sum[1]) - (sum[-2] + sum[2]) + offset) >> shift;
    samples[k] = static_cast<Sample>(std::min(std::max(value, 0), w.Largest));
  }
}

CSLF_VECTORIZE void GatherBytes(const unsigned char* const rows[4], const SampleWeights& weights,
  int tile, int* scratch, std::uint8_t* samples)
{
  Gather(rows, weights, tile, scratch, samples);
}

CSLF_VECTORIZE void GatherWords(const unsigned char* const rows[4], const SampleWeights& weights,
  int tile, int* scratch, std::uint16_t* samples)
{
  Gather(rows, weights, tile, scratch, samples);
}
}

ColorWeights MakeColorWeights(int bits, int peak, int fractionBits, int chromaScale)
{
  const double level = peak / ((1 << bits) - 1.0) * (1 << fractionBits);
  const double chroma = level / chromaScale;
  return { ToInteger(level), ToInteger(RedRange * chroma),
    ToInteger(-RedShare * RedRange / GreenShare * chroma),
    ToInteger(-BlueShare * BlueRange / GreenShare * chroma), ToInteger(BlueRange * chroma),
    chromaScale << (bits - 1) };
}

SampleWeights MakeSampleWeights(
  SamplePlane plane, int bits, int peak, int fractionBits, bool isFullRange)
{
  const int finer = 1 << (bits - 8);
  const double unit = std::ldexp(1.0, fractionBits);
  const double luma = (isFullRange ? (1 << bits) - 1 : 219 * finer) * unit / peak;
  const double chroma = (isFullRange ? (1 << bits) - 1 : 224 * finer) * unit / peak;
  SampleWeights w{};
  int zero = isFullRange ? 0 : 16 * finer;
  if (plane == SamplePlane::Luma)
  {
    // Makes white the largest sample, whatever the rounding.
    w.Red = ToInteger(RedShare * luma);
    w.Blue = ToInteger(BlueShare * luma);
    w.Green = ToInteger(luma) - w.Red - w.Blue;
  }
  else
  {
    // Makes the chroma of gray 0.
    const bool isBlue = plane == SamplePlane::Blue;
    const double range = isBlue ? BlueRange : RedRange;
    w.Red = ToInteger((isBlue ? -RedShare : 1.0 - RedShare) / range * chroma);
    w.Blue = ToInteger((isBlue ? 1.0 - BlueShare : -BlueShare) / range * chroma);
    w.Green = -w.Red - w.Blue;
    zero = 1 << (bits - 1);
  }
  w.Offset = (static_cast<std::int64_t>(2 * zero + 1) << fractionBits) / 2;
  w.Shift = fractionBits;
  w.Largest = (1 << bits) - 1;
  return w;
}

void YCbCrToColors(const YCbCrRow& row, int bits, int count, unsigned char* colors)
{
  const ColorWeights weights = MakeColorWeights(bits, 255, FractionBitsOfSums);
  (bits > 8 ? ConvertWords : ConvertBytes)(row, weights, count, colors);
}

void SpreadChroma(const std::uint8_t* near, const std::uint8_t* far, int bits, ChromaSiting siting,
  int tile, int count, std::uint16_t* scratch, std::uint16_t* chroma)
{
  for (int first = 0; first < count; first += tile)
  {
    const int place = first / 2;
    if (bits > 8)
    {
      SpreadWords(Cast<std::uint16_t>(near) + place, Cast<std::uint16_t>(far) + place, siting,
        tile / 2, scratch, chroma + first);
    }
    else
    {
      SpreadBytes(near + place, far + place, siting, tile / 2, scratch, chroma + first);
    }
  }
}

void SpreadToColors(const std::uint8_t* luma, const std::uint16_t* blue, const std::uint16_t* red,
  int bits, int count, unsigned char* colors)
{
  const ColorWeights weights = MakeColorWeights(bits, 255, FractionBitsOfSums, SpreadScale);
  (bits > 8 ? ConvertSpreadWords : ConvertSpreadBytes)(luma, blue, red, weights, count, colors);
}

void ColorsToSamples(const unsigned char* colors, const SampleWeights& weights, int bits, int count,
  std::uint8_t* samples)
{
  if (bits > 8)
  {
    MakeWords(colors, weights, count, reinterpret_cast<std::uint16_t*>(samples));
  }
  else
  {
    MakeBytes(colors, weights, count, samples);
  }
}

void ColorsToChroma(const unsigned char* const rows[4], const SampleWeights& weights, int bits,
  int tile, int count, int* scratch, std::uint8_t* samples)
{
  for (int first = 0; first < count; first += tile)
  {
    const std::ptrdiff_t place = 4 * static_cast<std::ptrdiff_t>(first);
    const unsigned char* const parts[4] = { rows[0] + place, rows[1] + place, rows[2] + place,
      rows[3] + place };
    if (bits > 8)
    {
      GatherWords(
        parts, weights, tile, scratch, reinterpret_cast<std::uint16_t*>(samples) + first / 2);
    }
    else
    {
      GatherBytes(parts, weights, tile, scratch, samples + first / 2);
    }
  }
}

namespace
{
/// The largest number is a constant, because vectors have no division.
template <unsigned int Largest>
inline void Widen(const std::uint16_t* samples, int count, unsigned short* depths)
{
  CSLF_LANE_LOOP
  for (int k = 0; k < count; ++k)
  {
    const unsigned int code = std::min<unsigned int>(samples[k], Largest);
    depths[k] = static_cast<unsigned short>((code * 65535u + Largest / 2) / Largest);
  }
}

CSLF_VECTORIZE void Widen10(const std::uint16_t* samples, int count, unsigned short* depths)
{
  Widen<1023>(samples, count, depths);
}

CSLF_VECTORIZE void Widen12(const std::uint16_t* samples, int count, unsigned short* depths)
{
  Widen<4095>(samples, count, depths);
}
}

void SamplesToDepths(const std::uint16_t* samples, int bits,
  const std::vector<unsigned short>& curve, int count, unsigned short* depths)
{
  if (!curve.empty())
  {
    for (int k = 0; k < count; ++k)
    {
      depths[k] = curve[std::min<std::size_t>(samples[k], curve.size() - 1)];
    }
    return;
  }
  (bits > 10 ? Widen12 : Widen10)(samples, count, depths);
}

CSLF_VECTORIZE void SamplesToCoverage(const std::uint8_t* samples, int count, unsigned char* colors)
{
  constexpr std::uint32_t others = ~(255u << TexelBytes::Coverage);
  CSLF_LANE_LOOP
  for (int k = 0; k < count; ++k)
  {
    const auto sample = static_cast<std::uint32_t>(samples[k]);
    WriteTexel((ReadTexel(colors, k) & others) | sample << TexelBytes::Coverage, colors, k);
  }
}

CSLF_VECTORIZE void JoinTexels(int tolerance, int count, unsigned char* colors)
{
  const std::uint32_t none = tolerance;
  const std::uint32_t full = 255 - tolerance;
  CSLF_LANE_LOOP
  for (int k = 0; k < count; ++k)
  {
    const std::uint32_t texel = ReadTexel(colors, k);
    std::uint32_t coverage = texel >> TexelBytes::Coverage & 255u;
    coverage = coverage <= none ? 0 : coverage;
    coverage = coverage >= full ? 255 : coverage;
    const std::uint32_t red = std::min(texel >> TexelBytes::Red & 255u, coverage);
    const std::uint32_t green = std::min(texel >> TexelBytes::Green & 255u, coverage);
    const std::uint32_t blue = std::min(texel >> TexelBytes::Blue & 255u, coverage);
    WriteTexel(red << TexelBytes::Red | green << TexelBytes::Green | blue << TexelBytes::Blue |
        coverage << TexelBytes::Coverage,
      colors, k);
  }
}
}
