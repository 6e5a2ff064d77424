// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One closed group of pictures of one track, encoded and decoded on its own. Groups share nothing,
 * so they may be coded side by side, and the bytes do not depend on how many are.
 */
#ifndef cslfGroupCodec_h
#define cslfGroupCodec_h

#include "Coding/cslfFrameConverter.h"
#include "Coding/cslfVideoEncoders.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cslf
{
/// One coded frame.
struct CodedFrame
{
  int Index = 0; ///< its place in the group in order of presentation
  std::vector<std::uint8_t> Data;
};

/// A coded group: frames in decoding order, the first one a key frame that nothing after it refers
/// past.
struct CodedGroup
{
  std::vector<std::uint8_t> ParameterSets; ///< annex B, or AV1's sequence header
  std::vector<CodedFrame> Frames;
  std::uint32_t CRC = 0;     ///< over all coded picture data
  bool CoveredFully = false; ///< a coverage track's: every sample is 255
};

/// Encodes the slices of a group. On failure returns false and says why, in one line.
bool EncodeGroup(const Track& track, int resolution, const EncodeOptions& options,
  const std::vector<ConstSlice>& slices, CodedGroup& group, std::string& error);

/// Decodes the packets of a group and hands each frame, with its place in the group, to `sink`,
/// which returns false when it has seen enough. The packets' times are the frames' places.
bool DecodeGroup(const AVCodecParameters* parameters,
  const std::vector<AVHandle<AVPacket>>& packets,
  const std::function<bool(int index, const AVFrame* frame)>& sink);
}

#endif
