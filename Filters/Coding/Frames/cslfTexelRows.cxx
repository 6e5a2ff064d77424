// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelRows.h"

#include "SIMD/cslfVectorize.h"
#include "cslfTexelBytes.h"

#include <algorithm>

namespace cslf
{
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
