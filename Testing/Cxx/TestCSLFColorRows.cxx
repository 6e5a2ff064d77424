// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of red, green and blue become samples, and rows of samples colours, exactly as the formulas
// say. The codes of radiance are the same on all machines.
#include "cslfTesting.h"

#include "Coding/Frames/cslfColorFrames.h"
#include "Coding/Frames/cslfColorRows.h"
#include "Coding/Frames/cslfFrameConverter.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace
{
using cslf::SamplePlane;

/// A width that is not a multiple of any vector's length.
constexpr int Width = 257;

/// The allowed rounding error, because the weights are inexact.
constexpr double Slack = 0.506;

template <typename Sample>
void TestToColors(int bits)
{
  const int maximum = (1 << bits) - 1;
  const double middle = 1 << (bits - 1);
  double worst = 0.0;
  for (int row = 0; row < 64; ++row)
  {
    std::vector<Sample> luma(Width);
    std::vector<Sample> blue(Width);
    std::vector<Sample> red(Width);
    for (int x = 0; x < Width; ++x)
    {
      luma[x] = static_cast<Sample>((x * 37 + row * 101) % (maximum + 1));
      blue[x] = static_cast<Sample>((x * 89 + row * 13) % (maximum + 1));
      red[x] = static_cast<Sample>((x * 61 + row * 57) % (maximum + 1));
    }
    std::vector<unsigned char> colors(4 * Width, 7);
    cslf::YCbCrToColors({ reinterpret_cast<const std::uint8_t*>(luma.data()),
                          reinterpret_cast<const std::uint8_t*>(blue.data()),
                          reinterpret_cast<const std::uint8_t*>(red.data()) },
      bits, Width, colors.data());
    for (int x = 0; x < Width; ++x)
    {
      const double cb = blue[x] - middle;
      const double cr = red[x] - middle;
      const double exact[3] = { luma[x] + 1.5748 * cr,
        luma[x] - (0.0722 * 1.8556 * cb + 0.2126 * 1.5748 * cr) / 0.7152, luma[x] + 1.8556 * cb };
      for (int k = 0; k < 3; ++k)
      {
        const double level = std::clamp(255.0 / maximum * exact[k], 0.0, 255.0);
        worst = std::max(worst, std::abs(level - colors[4 * x + k]));
      }
      CSLF_CHECK(colors[4 * x + 3] == 255);
    }
  }
  CSLF_CHECK(worst <= Slack);
}

/// The exact sample of each plane, before rounding.
void Apply(const unsigned char* color, double black, double lumaSpan, double middle,
  double chromaSpan, double samples[3])
{
  const double red = color[0] / 255.0;
  const double green = color[1] / 255.0;
  const double blue = color[2] / 255.0;
  const double luma = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
  samples[0] = black + lumaSpan * luma;
  samples[1] = middle + chromaSpan * (blue - luma) / 1.8556;
  samples[2] = middle + chromaSpan * (red - luma) / 1.5748;
}

template <typename Sample>
void TestToSamples(int bits, bool isFull)
{
  const int maximum = (1 << bits) - 1;
  const int finer = 1 << (bits - 8);
  std::vector<unsigned char> colors(4 * Width);
  std::vector<Sample> samples(Width);
  double worst = 0.0;
  for (int row = 0; row < 64; ++row)
  {
    for (int k = 0; k < 4 * Width; ++k)
    {
      colors[k] = static_cast<unsigned char>(k * 57 + row * 91 + k * k * 3);
    }
    for (const SamplePlane plane : { SamplePlane::Luma, SamplePlane::Blue, SamplePlane::Red })
    {
      const auto weights = cslf::MakeSampleWeights(plane, bits, 255, 17, isFull);
      cslf::ColorsToSamples(
        colors.data(), weights, bits, Width, reinterpret_cast<std::uint8_t*>(samples.data()));
      for (int x = 0; x < Width; ++x)
      {
        double exact[3];
        Apply(&colors[4 * x], isFull ? 0 : 16 * finer, isFull ? maximum : 219 * finer,
          1 << (bits - 1), isFull ? maximum : 224 * finer, exact);
        const double value = std::clamp<double>(exact[static_cast<int>(plane)], 0.0, maximum);
        worst = std::max(worst, std::abs(value - samples[x]));
      }
    }
  }
  CSLF_CHECK(worst <= Slack + 0.01 * finer / 4);
}

/// Two tiles with different chroma: upsampling does not mix them.
void TestSpread()
{
  constexpr int tile = 8;
  const std::vector<std::uint8_t> near = { 10, 20, 40, 80, 200, 200, 100, 0 };
  const std::vector<std::uint8_t> far = { 50, 60, 80, 120, 240, 240, 140, 40 };
  std::vector<std::uint16_t> scratch(tile / 2 + 2);
  std::vector<std::uint16_t> chroma(2 * tile);
  for (const bool isLeft : { true, false })
  {
    cslf::SpreadChroma(near.data(), far.data(), 8, isLeft ? cslf::LeftSiting : cslf::CenterSiting,
      tile, 2 * tile, scratch.data(), chroma.data());
    for (int x = 0; x < 2 * tile; ++x)
    {
      // The position of a luma sample among the chroma samples of its tile.
      const double place = std::clamp((x % tile - (isLeft ? 0.0 : 0.5)) / 2.0, 0.0, 3.0);
      const int k = std::min(static_cast<int>(place), 2) + x / tile * 4;
      const double share = place - (k - x / tile * 4);
      const auto mix = [&](const std::vector<std::uint8_t>& row)
      { return (1.0 - share) * row[k] + share * row[k + 1]; };
      CSLF_CHECK_NEAR(chroma[x], 16.0 * (0.75 * mix(near) + 0.25 * mix(far)), 1e-9);
    }
  }
}

/// The smallest distance of numbers from a rounding boundary, in units of the rounded numbers. It
/// is enough for any C library, whose relative errors are about 1e-16.
void TestMargins()
{
  for (const int bits : { 10, 12 })
  {
    const double most = (1 << bits) - 1;
    double margin = 1.0;
    const auto narrow = [&margin](double value)
    { margin = std::min(margin, std::abs(value - std::floor(value) - 0.5)); };
    for (int code = 0; code <= most; ++code)
    {
      narrow(std::expm1(code / most * std::log1p(40.0)) / 40.0 * 65535.0);
    }
    CSLF_CHECK(margin > 1e-7);
    margin = 1.0;
    for (int depth = 0; depth < 65536; ++depth)
    {
      narrow(std::log1p(40.0 * (depth / 65535.0)) / std::log1p(40.0) * most);
    }
    CSLF_CHECK(margin > 1e-9);
  }
}

void TestRadianceCodes()
{
  const std::vector<float>& radiances = cslf::GetCodedRadiances();
  CSLF_CHECK(radiances.size() == 65536 && radiances.front() == 0.0F);
  CSLF_CHECK(radiances.back() == static_cast<float>(cslf::MaximumRadiance));
  double margin = 1.0;
  int wrong = 0;
  for (int code = 0; code <= cslf::MaximumPQCode; ++code)
  {
    const float radiance = radiances[code];
    wrong += cslf::RadianceToPQCode(radiance) == code ? 0 : 1;
    const float above = std::nextafter(radiance, std::numeric_limits<float>::infinity());
    const double exact = cslf::PQToRadiance(code / 65535.0);
    const double place = (exact - radiance) / (above - radiance);
    margin = std::min(margin, std::abs(std::abs(place) - 0.5));
  }
  CSLF_CHECK(wrong == 0);
  CSLF_CHECK(margin > 1e-6);
  for (float radiance = 1e-9F; radiance < 60.0F; radiance *= 1.0003F)
  {
    const double exact = 65535.0 * cslf::RadianceToPQ(radiance);
    CSLF_CHECK(std::abs(cslf::RadianceToPQCode(radiance) - exact) < 0.501);
  }
  for (const float none : { 0.0F, -0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(),
         -std::numeric_limits<float>::infinity() })
  {
    CSLF_CHECK(cslf::RadianceToPQCode(none) == 0);
  }
  CSLF_CHECK(cslf::RadianceToPQCode(1e30F) == cslf::MaximumPQCode);
  CSLF_CHECK(cslf::RadianceToPQCode(std::numeric_limits<float>::infinity()) == cslf::MaximumPQCode);
}
}

int TestCSLFColorRows(int, char*[])
{
  TestToColors<std::uint8_t>(8);
  TestToColors<std::uint16_t>(10);
  TestToColors<std::uint16_t>(12);
  for (const bool isFull : { true, false })
  {
    TestToSamples<std::uint8_t>(8, isFull);
    TestToSamples<std::uint16_t>(10, isFull);
    TestToSamples<std::uint16_t>(12, isFull);
  }
  TestSpread();
  TestMargins();
  TestRadianceCodes();
  return cslf::testing::Result();
}
