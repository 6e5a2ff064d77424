// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The video tracks of a coded light field.
 */
#ifndef cslfTrack_h
#define cslfTrack_h

#include "cslfChannel.h"
#include "cslfCodec.h"

#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace cslf
{
/// The part of a channel's samples that a track contains.
enum class Plane
{
  Colors,   ///< red, green, blue
  Coverage, ///< alpha
  Numbers,  ///< numbers from 0 to 1, rounded to the track's bits
  HighByte, ///< the high byte of 16-bit numbers
  LowByte   ///< the low byte
};

/// The contents of a track: a plane of a channel of a layer.
struct TrackRole
{
  ChannelId Source = KnownChannel::Color;
  Plane Samples = Plane::Colors;

  bool operator==(const TrackRole& other) const
  {
    return this->Source == other.Source && this->Samples == other.Samples;
  }
  bool operator<(const TrackRole& other) const
  {
    return std::tie(this->Source, this->Samples) < std::tie(other.Source, other.Samples);
  }
};

/// The tracks of the first layer that every reader and writer needs.
constexpr TrackRole ColorRole{ KnownChannel::Color, Plane::Colors };
constexpr TrackRole CoverageRole{ KnownChannel::Color, Plane::Coverage };
constexpr TrackRole DepthRole{ KnownChannel::Depth, Plane::Numbers };

/// The coverage of a layer, which is that of all its channels.
constexpr TrackRole CoverageOf(int layer)
{
  return { { KnownChannel::Color, layer }, Plane::Coverage };
}

/// The kind of samples of a channel in its first form, which tells colours from numbers.
SampleKind KindOf(ChannelId id);

/// The planes in which a kind of samples is coded. Numbers are coded without loss as two bytes.
std::vector<Plane> GetPlanes(SampleKind kind, bool isLossless);

/// The information about samples that a file stores beside their format.
struct ReaderConstants
{
  /// Lossy coverage this close to none or full counts as none or full. On the closed-form test
  /// field, 8 removes 19 of 20 false traces of coverage at a rate factor of 12.
  int CoverageTolerance = 8;
  double Mu = 40.0;     ///< of the curve of cslfFrameConverter.h
  double White = 203.0; ///< of the perceptual quantiser: the luminance of radiance 1, in cd/m^2
};

/// A track's role and the layout of its samples in a frame. Formats of more than 8 bits are in the
/// machine's byte order, like the frames of FFmpeg's codecs.
struct Track
{
  TrackRole Role;
  AVPixelFormat Format = AV_PIX_FMT_YUV444P;
  bool Lossless = false;
  Codec Coding = Codec::HEVC;
  bool IsRadiance = false; ///< colour: linear radiance through the perceptual quantiser
  bool IsCurved = false;   ///< numbers: through the curve of cslfFrameConverter.h
  /// Colour with less chroma than luma: where it lies, AVCHROMA_LOC_LEFT or, in older files,
  /// AVCHROMA_LOC_CENTER.
  AVChromaLocation Siting = AVCHROMA_LOC_LEFT;
  ReaderConstants Constants = {};

  /// How far coverage may be from none or full to count as that.
  int GetTolerance() const { return this->Lossless ? 0 : this->Constants.CoverageTolerance; }
};

/// The frames of all tracks follow each other at this rate, in Hz.
constexpr int FrameRate = 25;

/// The duration of a frame, in seconds.
constexpr AVRational FrameTime = { 1, FrameRate };

/// The most frames of a closed group of pictures.
constexpr int MaximumGroupLength = 16;

/// The names in files: the channel's in lower case, with the number of a layer that is not the
/// first, and the plane's.
const char* NameOfRole(TrackRole role);
std::optional<TrackRole> RoleOfName(const std::string& name);

/// The pixel format of that FFmpeg name if a track of that plane may have it.
std::optional<AVPixelFormat> FindPixelFormat(Plane plane, const std::string& name);

/// The pixel formats that a user may choose for colour, for messages: "yuv444p, ...".
std::string ListColorFormats();

/// FFmpeg's name of a pixel format, in files and for users: the little-endian one on all machines.
std::string NameOfFormat(AVPixelFormat format);

/// Whether float colour can have that format: full resolution and more than 8 bits.
bool CanHoldRadiance(AVPixelFormat format);

/// The bits of a sample.
int BitsOfFormat(AVPixelFormat format);

/// Whether there is chroma besides the first plane.
bool HasChroma(AVPixelFormat format);

/// Whether a track's colour has less chroma than luma.
bool HasSparseChroma(const Track& track);

/// Whether frames of an odd width or height cannot have this format.
bool NeedsEvenSize(AVPixelFormat format);
}

#endif
