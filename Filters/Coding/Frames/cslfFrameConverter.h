// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts slices of the light field to video frames and back.
 *
 * Colour is stored as full-range Y'CbCr with the matrix of ITU-R BT.709, or as planar RGB; float
 * colour as Y'CbCr, through the perceptual quantiser. Coverage is stored unchanged, depth rounded
 * to 10 or 12 bits or as two bytes. If a codec has no gray format, both are luma, and chroma is
 * ignored.
 */
#ifndef cslfFrameConverter_h
#define cslfFrameConverter_h

#include "cslfTrack.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/// One viewpoint's samples: strips of 5 N x N texels.
struct ConstSlice
{
  const unsigned char* Color = nullptr;  ///< 4 a texel; if IsFloat, the memory of 4 floats
  const unsigned short* Depth = nullptr; ///< 1 a texel, or null
  bool IsFloat = false;

  const float* GetRadiance() const { return reinterpret_cast<const float*>(this->Color); }
  /// Red, green or blue as displayed over black, from 0 to 255; floats at that multiple of the
  /// exposure.
  double GetShown(std::size_t texel, int component, double exposure = 1.0) const;
  /// Alpha as a byte.
  unsigned char GetCoverage(std::size_t texel) const;
};

struct Slice
{
  unsigned char* Color = nullptr;
  unsigned short* Depth = nullptr;
  bool IsFloat = false;

  float* GetRadiance() const { return reinterpret_cast<float*>(this->Color); }
};

/// Sets the size, format and colour tags of what a track's encoder or frame holds.
void TagFrame(const Track& track, int resolution, AVFrame* frame);

/// Turns slices into frames of one track.
class SliceToFrame
{
public:
  SliceToFrame(const Track& track, int resolution);

  /// Fills a writable frame that has the track's format and size.
  void Convert(const ConstSlice& slice, AVFrame* frame);

private:
  void PutDepth(const ConstSlice& slice, AVFrame* frame);

  Track Kind;
  int Resolution;
  std::vector<unsigned char> Coverage;
  std::vector<unsigned short> Filled;
};

/// Converts frames of one track to its part of slices, colour before coverage.
class FrameToSlice
{
public:
  FrameToSlice(const Track& track, int resolution);

  /// False if the frame has another format or size than the track.
  bool Convert(const AVFrame* frame, const Slice& slice);

private:
  Track Kind;
  int Resolution;
  std::vector<unsigned short> Curve; ///< the depth of each code, where depth has a curve
};

/// Combines the channels of a decoded slice. Coverage within 3/255 of none or full becomes none or
/// full unless its track is lossless. Colour is clamped to coverage (floats: 0 where nothing is
/// covered), and depth is 1 where nothing is covered. Without a coverage track the slice is covered
/// everywhere.
void JoinChannels(int resolution, const Track* coverage, const Slice& slice);

/// The substitute for a missing viewpoint: nothing covered, depth 1.
void ClearSlice(int resolution, const Slice& slice);
}

#endif
