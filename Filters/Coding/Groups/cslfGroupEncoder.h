// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One closed group of pictures of one track, encoded separately. Groups share nothing, so they can
 * be coded in parallel, and the bytes do not depend on how many are.
 */
#ifndef cslfGroupEncoder_h
#define cslfGroupEncoder_h

#include "Coding/Codecs/cslfVideoEncoders.h"
#include "Coding/Frames/cslfFrameConverter.h"
#include "vtkCSLFModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace cslf
{
/// An open encoder of frames of a track with these options, or null with the reason in one line. It
/// names the option if the encoder does not know or accept it.
///
/// Each library's options are checked once in a process. During the check, FFmpeg's log goes
/// through a callback, and afterwards to FFmpeg's default callback. A program with its own callback
/// must set it again.
VTKCSLF_EXPORT AVHandle<AVCodecContext> OpenEncoder(const VideoEncoder& encoder, const Track& track,
  int resolution, const EncoderOptions& options, std::string& error);

/// One coded frame.
struct CodedFrame
{
  int Index = 0; ///< its place in the group in order of presentation
  std::vector<std::uint8_t> Data;
};

/// A coded group: frames in decoding order. The first one is a key frame, and no later frame refers
/// to frames before it.
struct CodedGroup
{
  std::vector<std::uint8_t> ParameterSets; ///< annex B, or AV1's sequence header
  std::vector<CodedFrame> Frames;
  std::uint32_t CRC = 0;     ///< over all coded picture data
  bool CoveredFully = false; ///< of a coverage track: every sample is 255
  /// A colour track's, once decoded, as in GroupCost; negative if not known.
  double SquaredError = -1.0;
};

/// Encodes the slices of a group. On failure returns false and gives the reason in one line.
/// `proceed` is called for each frame; if it returns false, that is a failure.
bool EncodeGroup(const Track& track, int resolution, const EncodeOptions& options,
  const std::vector<ViewpointSamples>& slices, const std::function<bool()>& proceed,
  CodedGroup& group, std::string& error);

/// The error of work that was asked to stop.
constexpr const char* Stopped = "it was stopped";

/// A group to be coded, once for each rate factor of colour.
struct CodingTask
{
  int Group = 0;
  bool IsTrial = false; ///< only the cost is needed
  std::vector<double> Factors;
};

/// The cost of a coded group, including its share of the container.
struct GroupCost
{
  double Bytes = 0.0; ///< of all tracks except coverage
  double CoverageBytes = 0.0;
  /// Of colour, summed over texels, red, green and blue, in units of 1/255; negative if not known.
  double SquaredError = -1.0;
  bool CoveredFully = true;
};

/// A coded group of all tracks.
using GroupTracks = std::vector<CodedGroup>;

/// What came of a task.
struct CodingResult
{
  int Group = 0;
  std::vector<std::pair<double, GroupCost>> Trials; ///< the cost at each rate factor
  GroupTracks Tracks;                               ///< of a group that is not only tried
};
}

#endif
