// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRemux.h"

#include "Coding/cslfAV.h"

namespace cslf
{
namespace testing
{
namespace
{
bool AddStreams(AVFormatContext* input, AVFormatContext* output)
{
  for (unsigned int k = 0; k < input->nb_streams; ++k)
  {
    const AVStream* from = input->streams[k];
    AVStream* to = avformat_new_stream(output, nullptr);
    if (!to || avcodec_parameters_copy(to->codecpar, from->codecpar) < 0)
    {
      return false;
    }
    to->codecpar->codec_tag = 0;
    to->time_base = from->time_base;
    to->avg_frame_rate = from->avg_frame_rate;
  }
  return av_dict_copy(&output->metadata, input->metadata, 0) >= 0;
}

bool CopyPackets(AVFormatContext* input, AVFormatContext* output)
{
  const AVHandle<AVPacket> packet(av_packet_alloc());
  int code = packet ? 0 : AVERROR(ENOMEM);
  while (code >= 0 && av_read_frame(input, packet.get()) >= 0)
  {
    av_packet_rescale_ts(packet.get(), input->streams[packet->stream_index]->time_base,
      output->streams[packet->stream_index]->time_base);
    packet->pos = -1;
    code = av_interleaved_write_frame(output, packet.get());
  }
  return code >= 0 && av_write_trailer(output) >= 0;
}
}

bool Remux(const std::string& from, const std::string& to)
{
  const AVLogSilence silence;
  AVFormatContext* context = nullptr;
  if (avformat_open_input(&context, from.c_str(), nullptr, nullptr) < 0)
  {
    return false;
  }
  const AVInput input(context);
  context = nullptr;
  if (avformat_find_stream_info(input.get(), nullptr) < 0 ||
    avformat_alloc_output_context2(&context, nullptr, nullptr, to.c_str()) < 0)
  {
    return false;
  }
  const AVOutput output(context);
  return AddStreams(input.get(), output.get()) &&
    avio_open(&output->pb, to.c_str(), AVIO_FLAG_WRITE) >= 0 &&
    avformat_write_header(output.get(), nullptr) >= 0 && CopyPackets(input.get(), output.get());
}
}
}
