// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of video samples become the texels that the formulas say, to the last level.
#include "cslfTesting.h"

#include "Coding/cslfTexelRows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace
{
/// A width that no vector's length divides.
constexpr int Width = 257;

/// How far from the nearest level a value may be rounded, for what is lost in the weights.
constexpr double Slack = 0.505;

template <typename Sample>
void TestColors(int bits)
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

void TestDepths(int bits)
{
  const int largest = (1 << bits) - 1;
  std::vector<std::uint16_t> samples(4200);
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    samples[k] = static_cast<std::uint16_t>(k);
  }
  std::vector<unsigned short> depths(samples.size());
  for (const bool isCurved : { false, true })
  {
    cslf::SamplesToDepths(
      samples.data(), bits, isCurved, static_cast<int>(samples.size()), depths.data());
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      const double code = std::min(static_cast<double>(k), static_cast<double>(largest)) / largest;
      const double depth = isCurved ? (std::pow(41.0, code) - 1.0) / 40.0 : code;
      CSLF_CHECK(depths[k] == std::lround(depth * 65535));
    }
  }
}

void TestJoined(int tolerance)
{
  std::vector<std::uint8_t> coverage(256);
  std::vector<unsigned char> colors(4 * 256);
  std::vector<unsigned short> depths(256, 1234);
  for (int k = 0; k < 256; ++k)
  {
    coverage[k] = static_cast<std::uint8_t>(k);
    const unsigned char color[4] = { 0, 100, 255, 50 };
    std::copy_n(color, 4, &colors[4 * k]);
  }
  cslf::SamplesToCoverage(coverage.data(), 256, colors.data());
  cslf::JoinTexels(tolerance, 256, colors.data(), depths.data());
  for (int k = 0; k < 256; ++k)
  {
    const int alpha = k >= 255 - tolerance ? 255 : k <= tolerance ? 0 : k;
    CSLF_CHECK(colors[4 * k] == 0);
    CSLF_CHECK(colors[4 * k + 1] == std::min(100, alpha));
    CSLF_CHECK(colors[4 * k + 2] == alpha);
    CSLF_CHECK(colors[4 * k + 3] == alpha);
    CSLF_CHECK(depths[k] == (alpha == 0 ? 65535 : 1234));
  }
  cslf::JoinTexels(tolerance, 256, colors.data(), nullptr);
}
}

int TestCSLFTexelRows(int, char*[])
{
  TestColors<std::uint8_t>(8);
  TestColors<std::uint16_t>(10);
  TestColors<std::uint16_t>(12);
  TestDepths(10);
  TestDepths(12);
  for (int tolerance : { 0, 3, 255 })
  {
    TestJoined(tolerance);
  }
  return cslf::testing::Result();
}
