// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Colours to frames of every pixel format and back: no format makes them darker or brighter, gray
// stays gray, and chroma does not spread between tiles.
#include "cslfTesting.h"

#include "Coding/Codecs/cslfTrack.h"
#include "Coding/Frames/cslfColorFrames.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

namespace
{
constexpr int Tile = 64;
constexpr int Width = 5 * Tile;
constexpr int Height = Tile;

struct Case
{
  AVPixelFormat Format;
  int Worst; ///< the allowed error of a colour component of noise, 255 for subsampled chroma
  double MinimumPSNR; ///< of smooth colours
};

const Case Cases[] = {
  { AV_PIX_FMT_GBRP, 0, 99.0 },
  { AV_PIX_FMT_YUV444P, 1, 51.0 },
  { AV_PIX_FMT_YUV444P10, 0, 99.0 },
  { AV_PIX_FMT_YUV444P12, 0, 99.0 },
  { AV_PIX_FMT_YUV422P, 255, 43.0 },
  { AV_PIX_FMT_YUV420P, 255, 43.0 },
  { AV_PIX_FMT_YUV420P10, 255, 45.0 },
};

using Colors = std::vector<unsigned char>;

cslf::AVHandle<AVFrame> MakeFrame(AVPixelFormat format)
{
  cslf::AVHandle<AVFrame> frame(av_frame_alloc());
  frame->width = Width;
  frame->height = Height;
  frame->format = format;
  frame->color_range = AVCOL_RANGE_JPEG;
  CSLF_CHECK(av_frame_get_buffer(frame.get(), 0) >= 0);
  return frame;
}

Colors PassThrough(const Colors& colors, AVPixelFormat format)
{
  const auto frame = MakeFrame(format);
  cslf::PutColors(colors.data(), Tile, frame.get());
  Colors result(colors.size());
  cslf::TakeColors(frame.get(), format, AVCHROMA_LOC_LEFT, Tile, result.data());
  return result;
}

/// The mean signed difference, the mean square and the largest difference.
struct Difference
{
  double Mean = 0.0;
  double Square = 0.0;
  int Worst = 0;

  double GetPSNR() const
  {
    return this->Square == 0.0 ? 100.0 : 10.0 * std::log10(255.0 * 255.0 / this->Square);
  }
};

Difference Compare(const Colors& a, const Colors& b)
{
  Difference difference;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    if (k % 4 != 3)
    {
      const int d = a[k] - b[k];
      difference.Mean += d;
      difference.Square += d * d;
      difference.Worst = std::max(difference.Worst, std::abs(d));
    }
  }
  difference.Mean /= 0.75 * static_cast<double>(a.size());
  difference.Square /= 0.75 * static_cast<double>(a.size());
  return difference;
}

template <typename Function>
Colors MakeColors(Function function)
{
  Colors colors;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      for (int k = 0; k < 3; ++k)
      {
        colors.push_back(static_cast<unsigned char>(function(x, y, k)));
      }
      colors.push_back(255);
    }
  }
  return colors;
}

void TestFormat(const Case& item)
{
  unsigned int state = 1;
  const Colors noise = MakeColors(
    [&state](int, int, int)
    {
      state = state * 1664525u + 1013904223u;
      return state >> 24;
    });
  const Difference ofNoise = Compare(PassThrough(noise, item.Format), noise);
  CSLF_CHECK(ofNoise.Worst <= item.Worst);

  const Colors smooth = MakeColors(
    [](int x, int y, int k)
    {
      return std::lround(
        128.0 + 90.0 * std::sin(0.05 * (x % Tile) + 0.03 * y + 2.0 * k + 0.4 * (x / Tile)));
    });
  const Difference ofSmooth = Compare(PassThrough(smooth, item.Format), smooth);
  std::cout << cslf::NameOfFormat(item.Format) << ": noise " << ofNoise.Mean << " of 255, worst "
            << ofNoise.Worst << "; smooth " << ofSmooth.Mean << ", " << ofSmooth.GetPSNR()
            << " dB\n";
  CSLF_CHECK(std::abs(ofSmooth.Mean) < 0.03);
  CSLF_CHECK(ofSmooth.GetPSNR() > item.MinimumPSNR);
  if (item.Worst < 255)
  {
    CSLF_CHECK(std::abs(ofNoise.Mean) < 0.03);
  }

  const Colors grays = MakeColors([](int x, int y, int) { return (x + y * Width) % 256; });
  CSLF_CHECK(PassThrough(grays, item.Format) == grays);

  // Tiles of saturated colours.
  const Colors tiles =
    MakeColors([](int x, int, int k) { return (x / Tile + 1) >> k & 1 ? 255 : 0; });
  CSLF_CHECK(Compare(PassThrough(tiles, item.Format), tiles).Worst <= 1);
}

/// Chroma in the middle, as in older files: the samples are those of a smooth field.
void TestCentered()
{
  const auto slope = [](double x) { return 0.4 * x; };
  const auto frame = MakeFrame(AV_PIX_FMT_YUV420P);
  for (int y = 0; y < Height; ++y)
  {
    std::fill_n(frame->data[0] + y * frame->linesize[0], Width, 128);
  }
  for (int y = 0; y < Height / 2; ++y)
  {
    for (int x = 0; x < Width / 2; ++x)
    {
      const double place = 2.0 * (x % (Tile / 2)) + 0.5;
      frame->data[1][y * frame->linesize[1] + x] = 128;
      frame->data[2][y * frame->linesize[2] + x] =
        static_cast<std::uint8_t>(std::lround(128.0 + slope(place)));
    }
  }
  Colors colors(static_cast<std::size_t>(4) * Width * Height);
  cslf::TakeColors(frame.get(), AV_PIX_FMT_YUV420P, AVCHROMA_LOC_CENTER, Tile, colors.data());
  double mean = 0.0;
  for (int x = 1; x + 1 < Tile; ++x)
  {
    const double expected = 128.0 + 1.5748 * slope(x);
    CSLF_CHECK_NEAR(colors[4 * x], expected, 1.4);
    mean += (colors[4 * x] - expected) / (Tile - 2);
  }
  CSLF_CHECK(std::abs(mean) < 0.1);
}
}

int TestCSLFColorFrames(int, char*[])
{
  for (const Case& item : Cases)
  {
    TestFormat(item);
  }
  TestCentered();
  return cslf::testing::Result();
}
