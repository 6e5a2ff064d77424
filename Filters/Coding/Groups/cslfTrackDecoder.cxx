// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTrackDecoder.h"

#include "cslfLayout.h"

#include <algorithm>

namespace cslf
{
std::unique_ptr<TrackDecoder> TrackDecoder::Open(
  const AVCodecParameters* parameters, int resolution)
{
  const AVCodec* codec = FindDecoder(parameters->codec_id);
  if (!codec)
  {
    return nullptr;
  }
  auto decoder = std::make_unique<TrackDecoder>();
  decoder->Context.reset(RequireMemory(avcodec_alloc_context3(codec)));
  decoder->Frame.reset(RequireMemory(av_frame_alloc()));
  AVCodecContext* context = decoder->Context.get();
  if (RequireMemory(avcodec_parameters_to_context(context, parameters)) < 0)
  {
    return nullptr;
  }
  context->thread_count = 1;
  context->err_recognition = AV_EF_EXPLODE;
  // Decoders round up to coding blocks and aligned rows.
  constexpr std::int64_t alignment = 128;
  context->max_pixels = FFALIGN(TileCount * std::int64_t(resolution), alignment) *
    FFALIGN(std::int64_t(resolution), alignment);
  // A message that no checksum covers may ask for film grain, which is not light.
  context->export_side_data |= AV_CODEC_EXPORT_DATA_FILM_GRAIN;
  return RequireMemory(avcodec_open2(context, codec, nullptr)) < 0 ? nullptr : std::move(decoder);
}

void TrackDecoder::Begin(
  const std::vector<AVHandle<AVPacket>>& packets, const std::vector<bool>& wanted)
{
  // Takes out unwanted frames, too: since version 7.1, FFmpeg's HEVC decoder keeps finished frames
  // after a flush, and would return them as frames of the next group.
  while (avcodec_receive_frame(this->Context.get(), this->Frame.get()) >= 0)
  {
  }
  avcodec_flush_buffers(this->Context.get());
  this->Packets = &packets;
  this->IsWanted = wanted;
  this->NextPacket = 0;
  this->ToSend = std::count(wanted.begin(), wanted.end(), true);
  this->IsDrained = false;
}

const AVFrame* TrackDecoder::Next()
{
  int code = 0;
  do
  {
    while (
      (code = RequireMemory(avcodec_receive_frame(this->Context.get(), this->Frame.get()))) >= 0)
    {
      const std::int64_t place = this->Frame->pts;
      if (place < 0 || place >= static_cast<std::int64_t>(this->IsWanted.size()))
      {
        return nullptr;
      }
      if (this->IsWanted[place])
      {
        return this->Frame.get();
      }
    }
  } while (code == AVERROR(EAGAIN) && this->Send());
  return nullptr;
}

bool TrackDecoder::Send()
{
  AVCodecContext* context = this->Context.get();
  if (this->ToSend > 0 && this->NextPacket < this->Packets->size())
  {
    const AVPacket* packet = (*this->Packets)[this->NextPacket++].get();
    const bool isWanted = this->IsWanted[packet->pts];
    this->ToSend -= isWanted ? 1 : 0;
    context->skip_frame = isWanted ? AVDISCARD_DEFAULT : AVDISCARD_NONREF;
    return RequireMemory(avcodec_send_packet(context, packet)) >= 0;
  }
  const bool isFirst = !this->IsDrained;
  this->IsDrained = true;
  return isFirst && avcodec_send_packet(context, nullptr) >= 0;
}
}
