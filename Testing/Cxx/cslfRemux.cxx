// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRemux.h"

#include "Coding/Codecs/cslfTrack.h"

#include <cstddef>
#include <cstdint>

namespace cslf
{
namespace testing
{
namespace
{
bool AddStreams(AVFormatContext* input, AVFormatContext* output, const RemuxChanges& changes)
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
    to->codecpar->width = changes.Width > 0 ? changes.Width : to->codecpar->width;
    to->codecpar->height = changes.Height > 0 ? changes.Height : to->codecpar->height;
    to->time_base = from->time_base;
    to->avg_frame_rate = from->avg_frame_rate;
  }
  bool good = av_dict_copy(&output->metadata, input->metadata, 0) >= 0;
  for (const auto& [name, text] : changes.SetTags)
  {
    const char* value = text.empty() ? nullptr : text.c_str();
    good = good && av_dict_set(&output->metadata, name.c_str(), value, 0) >= 0;
  }
  return good;
}

/// Writes a packet of the input `later` frames later.
bool WritePacket(
  const AVPacket* packet, AVRational time, std::int64_t later, AVFormatContext* output)
{
  const AVHandle<AVPacket> copy(av_packet_clone(packet));
  if (!copy)
  {
    return false;
  }
  const std::int64_t delay = av_rescale_q(later, { 1, FrameRate }, time);
  copy->pts += delay;
  copy->dts += delay;
  copy->pos = -1;
  av_packet_rescale_ts(copy.get(), time, output->streams[copy->stream_index]->time_base);
  return av_interleaved_write_frame(output, copy.get()) >= 0;
}

bool CopyPackets(AVFormatContext* input, AVFormatContext* output, const RemuxChanges& changes)
{
  std::vector<AVHandle<AVPacket>> packets;
  std::vector<int> frames(input->nb_streams, 0);
  AVHandle<AVPacket> packet(av_packet_alloc());
  while (packet && av_read_frame(input, packet.get()) >= 0)
  {
    ++frames[packet->stream_index];
    packets.push_back(std::move(packet));
    packet.reset(av_packet_alloc());
  }
  std::vector<int> written(input->nb_streams, 0);
  for (int repeat = 0; repeat < changes.Repeats; ++repeat)
  {
    for (const auto& each : packets)
    {
      const std::size_t track = each->stream_index;
      if (track < changes.Frames.size() && written[track] >= changes.Frames[track])
      {
        continue;
      }
      ++written[track];
      if (!WritePacket(each.get(), input->streams[track]->time_base,
            static_cast<std::int64_t>(repeat) * frames[track], output))
      {
        return false;
      }
    }
  }
  return av_write_trailer(output) >= 0;
}
}

bool Remux(const std::string& from, const std::string& to, const RemuxChanges& changes)
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
  return AddStreams(input.get(), output.get(), changes) &&
    avio_open(&output->pb, to.c_str(), AVIO_FLAG_WRITE) >= 0 &&
    avformat_write_header(output.get(), nullptr) >= 0 &&
    CopyPackets(input.get(), output.get(), changes);
}

std::string ReadTag(const std::string& fileName, const std::string& name)
{
  AVFormatContext* context = nullptr;
  if (avformat_open_input(&context, fileName.c_str(), nullptr, nullptr) < 0)
  {
    return {};
  }
  const AVInput input(context);
  const AVDictionaryEntry* entry = av_dict_get(input->metadata, name.c_str(), nullptr, 0);
  return entry ? entry->value : "";
}
}
}
