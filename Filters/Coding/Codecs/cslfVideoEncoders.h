// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * FFmpeg's encoders for light fields, their capabilities and their setup: closed groups, one
 * thread, and bytes that depend only on the frames and the settings.
 */
#ifndef cslfVideoEncoders_h
#define cslfVideoEncoders_h

#include "cslfTrack.h"
#include "vtkCSLFModule.h"

#include <string>
#include <vector>

namespace cslf
{
/// How a track is encoded; equal for all its groups.
struct EncodeOptions
{
  /// One of x265's presets. Other encoders use a similar one.
  std::string Preset = "slow";
  /// On x265's scale, from 0 to 51. Other encoders use a value of about the same quality.
  double CRF = 22.0;
  int GroupLength = MaximumGroupLength;
};

struct EncoderOption
{
  std::string Name;
  std::string Value;
};

/// The options of an encoder.
struct EncoderOptions
{
  std::vector<EncoderOption> OfFFmpeg;  ///< those that FFmpeg has for the encoder
  std::vector<EncoderOption> OfLibrary; ///< the library's other options
  int KeyFrameDistance = 0;             ///< at most, in frames; 0 for the encoder's own
};

struct VideoEncoder
{
  Codec Coding;
  const char* Name;          ///< FFmpeg's
  const char* LibraryOption; ///< FFmpeg's option that contains the library's options
  int MinimumResolution;     ///< in texels along each side of a tile
  bool CanBeLossless;
  bool CanShareProcess;                  ///< whether several may run at once
  std::vector<AVPixelFormat> ByteColors; ///< the first is the default
  AVPixelFormat Bytes;                   ///< coverage, and the bytes of numbers
  AVPixelFormat Numbers;
  AVPixelFormat FloatColors; ///< AV_PIX_FMT_NONE if there is none
  EncoderOptions (*MakeOptions)(const Track& track, const EncodeOptions& options);

  bool CanCode(AVPixelFormat format) const;

  /// The default format of a plane of that kind of samples.
  AVPixelFormat GetFormat(SampleKind kind, Plane plane) const;
};

/// The first encoder of this FFmpeg that can code frames of that format and resolution, or null.
VTKCSLF_EXPORT const VideoEncoder* FindEncoder(Codec codec, AVPixelFormat format, int resolution);

/// The first one for that codec, with its default format for byte colour or float colour, or null.
const VideoEncoder* FindEncoder(Codec codec, bool isRadiance, int resolution);

/// Whether this FFmpeg has any encoder for a codec.
bool HasEncoder(Codec codec);

/// The codecs for which it has encoders, for messages: "hevc, h264".
std::string ListCodecsToEncode();

/// The presets that x265 knows, fastest first.
const std::vector<std::string>& GetPresets();
}

#endif
