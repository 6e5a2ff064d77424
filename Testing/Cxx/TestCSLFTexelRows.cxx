// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of video samples become texels exactly as the formulas say.
#include "cslfTesting.h"

#include "Coding/Frames/cslfFrameConverter.h"
#include "Coding/Frames/cslfTexelRows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace
{
void TestDepths(int bits)
{
  const int largest = (1 << bits) - 1;
  std::vector<std::uint16_t> samples(4200);
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    samples[k] = static_cast<std::uint16_t>(k);
  }
  std::vector<unsigned short> depths(samples.size());
  for (const double mu : { 0.0, 40.0, 255.0 })
  {
    const auto curve = mu > 0.0 ? cslf::MakeCodedDepths(bits, mu) : std::vector<unsigned short>();
    cslf::SamplesToDepths(
      samples.data(), bits, curve, static_cast<int>(samples.size()), depths.data());
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      const double code = std::min(static_cast<double>(k), static_cast<double>(largest)) / largest;
      const double depth = mu > 0.0 ? (std::pow(1.0 + mu, code) - 1.0) / mu : code;
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
  cslf::JoinTexels(tolerance, 256, colors.data());
  cslf::FillUncovered(65535, 256, colors.data(), depths.data());
  for (int k = 0; k < 256; ++k)
  {
    const int alpha = k >= 255 - tolerance ? 255 : k <= tolerance ? 0 : k;
    CSLF_CHECK(colors[4 * k] == 0);
    CSLF_CHECK(colors[4 * k + 1] == std::min(100, alpha));
    CSLF_CHECK(colors[4 * k + 2] == alpha);
    CSLF_CHECK(colors[4 * k + 3] == alpha);
    CSLF_CHECK(depths[k] == (alpha == 0 ? 65535 : 1234));
  }
}
}

int TestCSLFTexelRows(int, char*[])
{
  TestDepths(10);
  TestDepths(12);
  for (int tolerance : { 0, 3, 255 })
  {
    TestJoined(tolerance);
  }
  return cslf::testing::Result();
}
