// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfTexelRows.h"

#include "Coding/cslfDepthCurve.h"
#include "PathTracing/cslfVectorize.h"

#include <vtkEndian.h>

#include <algorithm>
#include <cstring>

namespace cslf
{
namespace
{
constexpr int FractionBits = 20;

/// What a sample of each kind adds to each colour, in units of 2^-20 levels of 8 bits.
struct Weights
{
  int Luma;
  int RedOfRed;
  int GreenOfRed;
  int GreenOfBlue;
  int BlueOfBlue;
  int Middle; ///< the sample that stands for no chroma
};

/// ITU-R BT.709: R' = Y' + 2 (1 - Kr) Cr, B' = Y' + 2 (1 - Kb) Cb, and G' by the luma's definition.
Weights MakeWeights(int bits)
{
  constexpr double redShare = 0.2126;
  constexpr double blueShare = 0.0722;
  constexpr double greenShare = 1.0 - redShare - blueShare;
  const double level = 255.0 / ((1 << bits) - 1) * (1 << FractionBits);
  const auto toInteger = [level](double weight)
  { return static_cast<int>(weight * level + (weight < 0.0 ? -0.5 : 0.5)); };
  return { toInteger(1.0), toInteger(2.0 * (1.0 - redShare)),
    toInteger(-2.0 * redShare * (1.0 - redShare) / greenShare),
    toInteger(-2.0 * blueShare * (1.0 - blueShare) / greenShare),
    toInteger(2.0 * (1.0 - blueShare)), 1 << (bits - 1) };
}

inline std::uint32_t ToByte(int value)
{
  return static_cast<std::uint32_t>(std::min(std::max(value >> FractionBits, 0), 255));
}

/// The bytes of a texel as one number, so that a texel fits in a vector's lane: by how many bits
/// each is shifted depends on how numbers lie in memory.
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
  std::memcpy(&texel, colors + 4 * k, sizeof(texel));
  return texel;
}

inline void WriteTexel(std::uint32_t texel, unsigned char* colors, int k)
{
  std::memcpy(colors + 4 * k, &texel, sizeof(texel));
}

template <typename Sample>
inline void ConvertRow(const Sample* luma, const Sample* blue, const Sample* red,
  const Weights& weights, int count, unsigned char* colors)
{
  const Weights w = weights;
  constexpr int half = 1 << (FractionBits - 1);
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

CSLF_VECTORIZE void ConvertBytes(
  const YCbCrRow& row, const Weights& weights, int count, unsigned char* colors)
{
  ConvertRow(row.Luma, row.Blue, row.Red, weights, count, colors);
}

CSLF_VECTORIZE void ConvertWords(
  const YCbCrRow& row, const Weights& weights, int count, unsigned char* colors)
{
  ConvertRow(reinterpret_cast<const std::uint16_t*>(row.Luma),
    reinterpret_cast<const std::uint16_t*>(row.Blue),
    reinterpret_cast<const std::uint16_t*>(row.Red), weights, count, colors);
}

/// The largest number is a constant, since vectors know no division.
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

void YCbCrToColors(const YCbCrRow& row, int bits, int count, unsigned char* colors)
{
  (bits > 8 ? ConvertWords : ConvertBytes)(row, MakeWeights(bits), count, colors);
}

void SamplesToDepths(
  const std::uint16_t* samples, int bits, bool isCurved, int count, unsigned short* depths)
{
  if (isCurved)
  {
    const std::vector<unsigned short>& curve = GetCodedDepths(bits);
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

CSLF_VECTORIZE void JoinTexels(
  int tolerance, int count, unsigned char* colors, unsigned short* depths)
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
  for (int k = 0; depths && k < count; ++k)
  {
    depths[k] = colors[4 * k + 3] == 0 ? 65535 : depths[k];
  }
}
}
