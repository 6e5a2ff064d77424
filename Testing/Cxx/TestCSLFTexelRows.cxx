// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows of video samples become texels exactly as the formulas say.
#include "cslfTesting.h"

#include "Coding/Frames/cslfColorRows.h"
#include "Coding/Frames/cslfFrameConverter.h"
#include "cslfColor.h"
#include "cslfLayout.h"

#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

extern "C"
{
#include <libavutil/frame.h>
}

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

// Numbers that are no distances are coded in equal steps, and stay the same beside what is not
// covered. Distances there move away.
void TestNumbers(bool areDistances)
{
  constexpr int resolution = 16;
  constexpr int texels = cslf::TileCount * resolution * resolution;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(cslf::ColorBytes);
  colors->SetNumberOfTuples(texels);
  vtkNew<vtkUnsignedShortArray> numbers;
  numbers->SetNumberOfTuples(texels);
  for (int i = 0; i < texels; ++i)
  {
    const bool isCovered = i % resolution < 8;
    const double code = isCovered ? 255.0 : 0.0;
    colors->SetTuple4(i, code, code, code, code);
    numbers->SetValue(i, static_cast<unsigned short>(isCovered ? 20000 - 150 * (i % 8) : 65535));
  }
  cslf::ViewpointSamples samples;
  samples.SetArray(cslf::KnownChannel::Color, colors);
  samples.SetArray(cslf::KnownChannel::Depth, numbers);
  cslf::Track track;
  track.Role = cslf::DepthRole;
  track.Format = AV_PIX_FMT_GRAY12;
  track.IsCurved = areDistances;
  AVFrame* frame = av_frame_alloc();
  cslf::TagFrame(track, resolution, frame);
  CSLF_CHECK(av_frame_get_buffer(frame, 0) == 0);
  cslf::SliceToFrame(track, resolution).Convert(samples, frame);
  vtkNew<vtkUnsignedShortArray> decoded;
  decoded->SetNumberOfTuples(texels);
  cslf::ViewpointSamples result;
  result.SetArray(cslf::KnownChannel::Color, colors);
  result.SetArray(cslf::KnownChannel::Depth, decoded);
  CSLF_CHECK(cslf::FrameToSlice(track, resolution).Convert(frame, result));
  av_frame_free(&frame);
  constexpr int step = 65536 / 4096;
  for (int i = 0; i < texels; ++i)
  {
    const int difference = decoded->GetValue(i) - numbers->GetValue(i);
    if (i % resolution < 7)
    {
      CSLF_CHECK(std::abs(difference) <= step);
    }
    else if (i % resolution == 7)
    {
      CSLF_CHECK(areDistances ? difference > 100 : std::abs(difference) <= step);
    }
  }
}
}

int TestCSLFTexelRows(int, char*[])
{
  TestNumbers(false);
  TestNumbers(true);
  TestDepths(10);
  TestDepths(12);
  for (int tolerance : { 0, 3, 255 })
  {
    TestJoined(tolerance);
  }
  return cslf::testing::Result();
}
