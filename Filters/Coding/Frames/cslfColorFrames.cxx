// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfColorFrames.h"

#include "cslfColor.h"

#include "cslfColorRows.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
}
