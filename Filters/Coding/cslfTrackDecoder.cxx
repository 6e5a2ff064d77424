// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfTrackDecoder.h"

#include <algorithm>
#include <cstddef>

namespace cslf
{
std::unique_ptr<TrackDecoder> TrackDecoder::Open(const AVCodecParameters* parameters)
{
  const AVCodec* codec = avcodec_find_decoder(parameters->codec_id);
  auto decoder = std::make_unique<TrackDecoder>();
  decoder->Context.reset(codec ? avcodec_alloc_context3(codec) : nullptr);
  decoder->Frame.reset(av_frame_alloc());
  AVCodecContext* context = decoder->Context.get();
  if (!context || !decoder->Frame || avcodec_parameters_to_context(context, parameters) < 0)
  {
    return nullptr;
  }
  context->thread_count = 1;
  context->err_recognition = AV_EF_EXPLODE;
  return avcodec_open2(context, codec, nullptr) < 0 ? nullptr : std::move(decoder);
}

void TrackDecoder::Begin(
  const std::vector<AVHandle<AVPacket>>& packets, const std::vector<bool>& wanted)
{
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
    while ((code = avcodec_receive_frame(this->Context.get(), this->Frame.get())) >= 0)
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
    return avcodec_send_packet(context, packet) >= 0;
  }
  const bool isFirst = !this->IsDrained;
  this->IsDrained = true;
  return isFirst && avcodec_send_packet(context, nullptr) >= 0;
}
}
