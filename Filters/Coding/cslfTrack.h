// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The video tracks that a light field is coded as.
 */
#ifndef cslfTrack_h
#define cslfTrack_h

#include "Coding/cslfCodec.h"

#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// What a track's samples are.
enum class TrackRole
{
  Color,     ///< red, green, blue
  Coverage,  ///< alpha
  Depth,     ///< depth, rounded to the track's bits
  DepthHigh, ///< the high byte of 16-bit depth
  DepthLow   ///< its low byte
};

/// What a file says of its samples beside their format.
struct ReaderConstants
{
  /// Coverage this near to none or full is taken for none or full where it is lossy. On the
  /// closed-form test field 8 removes 19 of 20 of the false traces of coverage at a rate factor of
  /// 12.
  int CoverageTolerance = 8;
  double Mu = 40.0;     ///< of the curve of cslfDepthCurve.h
  double White = 203.0; ///< of the perceptual quantiser: the luminance of radiance 1, in cd/m^2
};

/// A track's role and how its samples lie in a frame. Formats of more than 8 bits are those in the
/// machine's byte order, whose frames FFmpeg's coders take and give.
struct Track
{
  TrackRole Role = TrackRole::Color;
  AVPixelFormat Format = AV_PIX_FMT_YUV444P;
  bool Lossless = false;
  Codec Coding = Codec::HEVC;
  bool IsRadiance = false; ///< colour: linear radiance through the perceptual quantiser
  bool IsCurved = false;   ///< depth: through the curve of cslfDepthCurve.h
  /// Colour with less chroma than luma: where it lies, AVCHROMA_LOC_LEFT or, in older files,
  /// AVCHROMA_LOC_CENTER.
  AVChromaLocation Siting = AVCHROMA_LOC_LEFT;
  ReaderConstants Constants;

  /// How far coverage may be from none or full to be taken for that.
  int GetTolerance() const { return this->Lossless ? 0 : this->Constants.CoverageTolerance; }
};

/// The frames of all tracks follow each other at this rate, in Hz.
constexpr int FrameRate = 25;

/// Closed groups of pictures have at most this many frames.
constexpr int MaximumGroupLength = 16;

/// The names that files use.
const char* NameOfRole(TrackRole role);
std::optional<TrackRole> RoleOfName(const std::string& name);

/// The pixel format of that FFmpeg name if a track of that role may have it.
std::optional<AVPixelFormat> FindPixelFormat(TrackRole role, const std::string& name);

/// The pixel formats that a user may choose for colour, for messages: "yuv444p, ...".
std::string ListColorFormats();

/// FFmpeg's name of a pixel format, in files and for users: that of low bytes first, whatever the
/// machine's order.
std::string NameOfFormat(AVPixelFormat format);

/// Whether float colour can have that format: full resolution and more than 8 bits.
bool CanHoldRadiance(AVPixelFormat format);

/// The bits of a sample.
int BitsOfFormat(AVPixelFormat format);

/// Whether there is chroma beside the first plane.
bool HasChroma(AVPixelFormat format);

/// Whether a track's colour has less chroma than luma.
bool HasSparseChroma(const Track& track);

/// Whether frames of an odd width or height cannot have this format.
bool NeedsEvenSize(AVPixelFormat format);
}

#endif
