// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfGroupCodec.h"

#include "Coding/cslfHEVC.h"
#include "cslfLayout.h"

#include <algorithm>
#include <sstream>

namespace cslf
{
namespace
{
constexpr const char* EncoderName = "libx265";

/// x265's options: one thread, so that bytes do not depend on the machine's load; no weighted
/// prediction, on which libx265 3.5 decides by memory that it has not set, so that bytes would
/// depend on what the process did before; a closed group without scene cuts; no psycho-visual
/// options, which add detail that is not there.
std::string MakeParameters(const Track& track, const EncodeOptions& options)
{
  std::ostringstream text;
  text << "log-level=none:info=0:repeat-headers=0:pools=none:frame-threads=1:wpp=0:pmode=0:pme=0"
       << ":scenecut=0:open-gop=0:keyint=" << options.GroupLength
       << ":min-keyint=" << options.GroupLength << ":rc-lookahead=" << 2 * MaximumGroupLength
       << ":bframes=8:ref=5:weightp=0:weightb=0:psy-rd=0:psy-rdoq=0:aq-mode=0";
  if (track.Lossless)
  {
    text << ":lossless=1";
  }
  return text.str();
}

AVHandle<AVCodecContext> OpenEncoder(
  const Track& track, int resolution, const EncodeOptions& options, std::string& error)
{
  const AVCodec* codec = avcodec_find_encoder_by_name(EncoderName);
  AVHandle<AVCodecContext> context(codec ? avcodec_alloc_context3(codec) : nullptr);
  AVHandle<AVFrame> tags(av_frame_alloc());
  if (!context || !tags)
  {
    error = "this FFmpeg has no encoder " + std::string(EncoderName);
    return nullptr;
  }
  TagFrame(track, resolution, tags.get());
  context->width = tags->width;
  context->height = tags->height;
  context->pix_fmt = track.Format;
  context->color_range = tags->color_range;
  context->color_primaries = tags->color_primaries;
  context->color_trc = tags->color_trc;
  context->colorspace = tags->colorspace;
  context->time_base = { 1, FrameRate };
  context->framerate = { FrameRate, 1 };
  context->thread_count = 1;
  context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  av_opt_set(context->priv_data, "preset", options.Preset.c_str(), 0);
  av_opt_set(context->priv_data, "x265-params", MakeParameters(track, options).c_str(), 0);
  if (!track.Lossless)
  {
    av_opt_set_double(context->priv_data, "crf", options.CRF, 0);
  }
  const int code = avcodec_open2(context.get(), codec, nullptr);
  if (code < 0)
  {
    error = "the encoder refuses frames of " + std::to_string(tags->width) + " x " +
      std::to_string(tags->height) + " " + NameOfFormat(track.Format) + ": " + AVErrorText(code);
    return nullptr;
  }
  return context;
}

/// Takes all packets that the encoder has ready.
int TakePackets(AVCodecContext* context, AVPacket* packet, CodedGroup& group)
{
  int code = 0;
  while ((code = avcodec_receive_packet(context, packet)) >= 0)
  {
    CodedFrame frame;
    frame.Index = static_cast<int>(packet->pts);
    frame.Data.assign(packet->data, packet->data + packet->size);
    group.Frames.push_back(std::move(frame));
    av_packet_unref(packet);
  }
  return code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : code;
}

int EncodeFrames(AVCodecContext* context, const Track& track, int resolution,
  const std::vector<ConstSlice>& slices, CodedGroup& group)
{
  SliceToFrame converter(track, resolution);
  AVHandle<AVPacket> packet(av_packet_alloc());
  if (!packet)
  {
    return AVERROR(ENOMEM);
  }
  for (std::size_t k = 0; k < slices.size(); ++k)
  {
    AVHandle<AVFrame> frame(av_frame_alloc());
    if (!frame)
    {
      return AVERROR(ENOMEM);
    }
    TagFrame(track, resolution, frame.get());
    frame->pts = static_cast<std::int64_t>(k);
    int code = av_frame_get_buffer(frame.get(), 0);
    if (code >= 0 && !converter.Convert(slices[k], frame.get()))
    {
      code = AVERROR_EXTERNAL;
    }
    if (code < 0 || (code = avcodec_send_frame(context, frame.get())) < 0 ||
      (code = TakePackets(context, packet.get(), group)) < 0)
    {
      return code;
    }
  }
  const int code = avcodec_send_frame(context, nullptr);
  return code < 0 ? code : TakePackets(context, packet.get(), group);
}

/// Whether the encoder gave every frame once, the first one first, and the checksum of it all.
bool SealGroup(std::size_t frames, CodedGroup& group)
{
  std::vector<bool> seen(frames, false);
  for (const CodedFrame& frame : group.Frames)
  {
    if (frame.Index < 0 || static_cast<std::size_t>(frame.Index) >= frames || seen[frame.Index] ||
      !AddSlicesToCRC(frame.Data.data(), frame.Data.size(), NALFraming{}, group.CRC))
    {
      return false;
    }
    seen[frame.Index] = true;
  }
  std::uint32_t crc = 0;
  return group.Frames.size() == frames && group.Frames.front().Index == 0 &&
    ComputeParameterSetsCRC(group.ParameterSets.data(), group.ParameterSets.size(), crc);
}

bool IsCoveredFully(int resolution, const std::vector<ConstSlice>& slices)
{
  const std::size_t texels = static_cast<std::size_t>(TileCount) * resolution * resolution;
  for (const ConstSlice& slice : slices)
  {
    for (std::size_t texel = 0; texel < texels; ++texel)
    {
      if (slice.Color[4 * texel + 3] != 255)
      {
        return false;
      }
    }
  }
  return true;
}
}

const std::vector<std::string>& GetPresets()
{
  static const std::vector<std::string> presets = { "ultrafast", "superfast", "veryfast", "faster",
    "fast", "medium", "slow", "slower", "veryslow", "placebo" };
  return presets;
}

bool HasEncoder()
{
  return avcodec_find_encoder_by_name(EncoderName) != nullptr;
}

bool EncodeGroup(const Track& track, int resolution, const EncodeOptions& options,
  const std::vector<ConstSlice>& slices, CodedGroup& group, std::string& error)
{
  group = CodedGroup();
  const AVHandle<AVCodecContext> context = OpenEncoder(track, resolution, options, error);
  if (!context)
  {
    return false;
  }
  const int code = EncodeFrames(context.get(), track, resolution, slices, group);
  if (code < 0)
  {
    error = "the encoder failed: " + AVErrorText(code);
    return false;
  }
  group.ParameterSets.assign(context->extradata, context->extradata + context->extradata_size);
  if (!SealGroup(slices.size(), group))
  {
    error = "the encoder did not give one packet for each frame";
    return false;
  }
  group.CoveredFully = track.Role == TrackRole::Coverage && IsCoveredFully(resolution, slices);
  return true;
}
}
