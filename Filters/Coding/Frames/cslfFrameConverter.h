// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts slices of the light field to video frames and back.
 *
 * Colour is stored as full-range Y'CbCr with the matrix of ITU-R BT.709, or as planar RGB; float
 * colour as Y'CbCr, through the perceptual quantiser. Coverage is stored unchanged, depth in 10 or
 * 12 bits by a curve, or as two bytes. If a codec has no gray format, both are luma, and chroma is
 * ignored.
 */
#ifndef cslfFrameConverter_h
#define cslfFrameConverter_h

#include "Coding/Codecs/cslfTrack.h"
#include "cslfViewpointSamples.h"
#include "vtkCSLFModule.h" // for export macro

#include <cstdint>
#include <functional>
#include <vector>

namespace cslf
{
/// The parameter of the curve by which depth is coded: its steps grow with depth, so that the
/// relative error of coding is about the same for all depths. Lookups compare positions along a ray
/// by inverse depth, so an error that is harmless far away makes holes in near surfaces. With t the
/// depth in [0,1] and c the code in [0,1]:
/// c = ln(1 + mu t) / ln(1 + mu), the mu-law of ITU-T G.711.
constexpr int DepthMu = 40;

/// The code of each depth of 16 bits, in 10 or 12 bits.
const std::vector<std::uint16_t>& GetDepthCodes(int bits);

/// The depth of each code, for a curve with that parameter.
VTKCSLF_EXPORT std::vector<unsigned short> MakeCodedDepths(int bits, double mu);

/// Sets the size, format and colour tags of what a track's encoder or frame holds.
VTKCSLF_EXPORT void TagFrame(const Track& track, int resolution, AVFrame* frame);

/// Turns slices into frames of one track.
class VTKCSLF_EXPORT SliceToFrame
{
public:
  SliceToFrame(const Track& track, int resolution);

  /// Fills a writable frame that has the track's format and size.
  void Convert(const ViewpointSamples& samples, AVFrame* frame);

private:
  void PutNumbers(const ViewpointSamples& samples, AVFrame* frame);

  Track Kind;
  int Resolution;
  std::vector<unsigned char> Coverage;
  std::vector<unsigned short> Filled;
};

/// Converts frames of one track to its part of slices, colour before coverage.
class VTKCSLF_EXPORT FrameToSlice
{
public:
  FrameToSlice(const Track& track, int resolution);

  /// False if the frame has another format or size than the track.
  bool Convert(const AVFrame* frame, const ViewpointSamples& samples);

private:
  Track Kind;
  int Resolution;
  std::vector<unsigned short> Curve; ///< the depth of each code, where depth has a curve
};

/// Combines the channels of each layer of a decoded slice. `findTrack` gives the track of a role,
/// or null. Coverage within its track's tolerance of none or full becomes none or full. Colour is
/// clamped to coverage (floats: 0 where nothing is covered), and numbers are filled where nothing
/// is covered. A layer without a coverage track is covered everywhere.
void JoinChannels(int resolution, const std::function<const Track*(TrackRole)>& findTrack,
  const ViewpointSamples& samples);
}

#endif
