// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Decodes closed groups of pictures of one track with one decoder, which costs much less than a
 * decoder for each group.
 */
#ifndef cslfTrackDecoder_h
#define cslfTrackDecoder_h

#include "Coding/Frames/cslfFrameConverter.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace cslf
{
class TrackDecoder
{
public:
  /// Null if FFmpeg cannot decode a track of these parameters, whose frames are strips of 5 N x N
  /// texels. Larger frames are not decoded.
  static std::unique_ptr<TrackDecoder> Open(const AVCodecParameters* parameters, int resolution);

  /// Begins a group. The packets, whose times are the frames' places in the group, must exist until
  /// the last wanted frame is taken. Frames after that in decoding order, and unwanted frames that
  /// no other refers to, are not decoded.
  void Begin(const std::vector<AVHandle<AVPacket>>& packets, const std::vector<bool>& wanted);

  /// The next wanted frame in order of presentation, valid until the next call. Null if there is
  /// none or it cannot be decoded. Its time is its place in the group. Frames do not depend on
  /// which other ones are wanted.
  const AVFrame* Next();

private:
  bool Send();

  AVHandle<AVCodecContext> Context;
  AVHandle<AVFrame> Frame;
  const std::vector<AVHandle<AVPacket>>* Packets = nullptr;
  std::vector<bool> IsWanted;
  std::size_t NextPacket = 0;
  std::ptrdiff_t ToSend = 0; ///< wanted frames not sent yet
  bool IsDrained = false;
};
}

#endif
