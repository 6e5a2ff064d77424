// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGroupCodec.h"

#include "cslfCodingTask.h"
#include "cslfEncoderContext.h"
#include "cslfLayout.h"

#include <mutex>

namespace cslf
{
namespace
{
/// Takes all packets that the encoder has ready.
int TakePackets(AVCodecContext* context, const Bitstream& bitstream,
  const std::function<bool()>& proceed, AVPacket* packet, CodedGroup& group)
{
  int code = 0;
  while ((code = avcodec_receive_packet(context, packet)) >= 0)
  {
    if (!proceed())
    {
      return AVERROR_EXIT;
    }
    CodedFrame frame;
    frame.Index = static_cast<int>(packet->pts);
    frame.Data = bitstream.Trim(packet->data, static_cast<std::size_t>(packet->size));
    group.Frames.push_back(std::move(frame));
    av_packet_unref(packet);
  }
  return code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : code;
}

int EncodeFrames(AVCodecContext* context, const Track& track, int resolution,
  const std::vector<ViewpointSamples>& slices, const std::function<bool()>& proceed,
  CodedGroup& group)
{
  SliceToFrame converter(track, resolution);
  const Bitstream& bitstream = GetBitstream(track.Coding);
  AVHandle<AVPacket> packet(av_packet_alloc());
  if (!packet)
  {
    return AVERROR(ENOMEM);
  }
  for (std::size_t k = 0; k < slices.size(); ++k)
  {
    if (!proceed())
    {
      return AVERROR_EXIT;
    }
    AVHandle<AVFrame> frame(av_frame_alloc());
    if (!frame)
    {
      return AVERROR(ENOMEM);
    }
    TagFrame(track, resolution, frame.get());
    frame->pts = static_cast<std::int64_t>(k);
    int code = av_frame_get_buffer(frame.get(), 0);
    if (code < 0)
    {
      return code;
    }
    converter.Convert(slices[k], frame.get());
    if ((code = avcodec_send_frame(context, frame.get())) < 0 ||
      (code = TakePackets(context, bitstream, proceed, packet.get(), group)) < 0)
    {
      return code;
    }
  }
  const int code = avcodec_send_frame(context, nullptr);
  return code < 0 ? code : TakePackets(context, bitstream, proceed, packet.get(), group);
}

/// Whether the encoder returned every frame once, the first one first; computes the checksum.
bool SealGroup(const Bitstream& bitstream, std::size_t frames, CodedGroup& group)
{
  // Packets are trimmed in the form of encoders: NAL units have start codes.
  Framing framing;
  if (!bitstream.ReadConfiguration(group.ParameterSets.data(), group.ParameterSets.size(), framing))
  {
    return false;
  }
  std::vector<bool> seen(frames, false);
  for (const CodedFrame& frame : group.Frames)
  {
    if (frame.Index < 0 || static_cast<std::size_t>(frame.Index) >= frames || seen[frame.Index] ||
      frame.Data.empty() ||
      !bitstream.AddToCRC(frame.Data.data(), frame.Data.size(), framing, group.CRC))
    {
      return false;
    }
    seen[frame.Index] = true;
  }
  return group.Frames.size() == frames && group.Frames.front().Index == 0;
}

bool IsCoveredFully(int resolution, const std::vector<ViewpointSamples>& slices)
{
  const std::size_t texels = static_cast<std::size_t>(TileCount) * resolution * resolution;
  for (const ViewpointSamples& slice : slices)
  {
    const ColorTexels colors(slice);
    for (std::size_t texel = 0; texel < texels; ++texel)
    {
      if (colors.GetCoverage(texel) != 255)
      {
        return false;
      }
    }
  }
  return true;
}
}

bool EncodeGroup(const Track& track, int resolution, const EncodeOptions& options,
  const std::vector<ViewpointSamples>& slices, const std::function<bool()>& proceed,
  CodedGroup& group, std::string& error)
{
  group = CodedGroup();
  const VideoEncoder* encoder = FindEncoder(track.Coding, track.Format, resolution);
  if (!encoder)
  {
    error = "this FFmpeg has no encoder for " + std::string(NameOfCodec(track.Coding)) + " as " +
      NameOfFormat(track.Format);
    return false;
  }
  // SVT-AV1 up to version 1 keeps settings in global variables.
  static std::mutex alone;
  std::unique_lock<std::mutex> lock(alone, std::defer_lock);
  if (!encoder->CanShareProcess)
  {
    lock.lock();
  }
  const AVHandle<AVCodecContext> context =
    OpenEncoder(*encoder, track, resolution, encoder->MakeOptions(track, options), error);
  if (!context)
  {
    return false;
  }
  const int code = EncodeFrames(context.get(), track, resolution, slices, proceed, group);
  if (code < 0)
  {
    error = code == AVERROR_EXIT ? Stopped : "the encoder failed: " + AVErrorText(code);
    return false;
  }
  const Bitstream& bitstream = GetBitstream(track.Coding);
  group.ParameterSets = bitstream.FindParameterSets(
    { context->extradata, context->extradata + context->extradata_size },
    group.Frames.empty() ? std::vector<std::uint8_t>() : group.Frames.front().Data);
  if (!SealGroup(bitstream, slices.size(), group))
  {
    error = "the encoder did not give one packet for each frame";
    return false;
  }
  group.CoveredFully = track.Role == CoverageRole && IsCoveredFully(resolution, slices);
  return true;
}
}
