// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfContainerWriter.h"

#include "Files/cslfFileSystem.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace cslf
{
namespace
{
bool Fail(const char* what, int code, std::string& error)
{
  error = std::string(what) + ": " + AVErrorText(code);
  return false;
}
}

const char* FindContainer(const std::string& fileName)
{
  std::string extension = ToName(ToPath(fileName).extension());
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return extension == ".mp4" ? "mp4" : extension == ".mkv" ? "matroska" : nullptr;
}

bool ContainerWriter::Open(const std::string& fileName, const HeaderTags& tags, std::string& error)
{
  const std::string url = "file:" + fileName;
  AVFormatContext* context = nullptr;
  int code =
    avformat_alloc_output_context2(&context, nullptr, FindContainer(fileName), url.c_str());
  if (code < 0)
  {
    return Fail("cannot make the container", code, error);
  }
  this->Output.reset(context);
  // Without this, Matroska files contain random numbers.
  context->flags |= AVFMT_FLAG_BITEXACT;
  code = avio_open(&this->Output->pb, url.c_str(), AVIO_FLAG_WRITE);
  if (code < 0)
  {
    return Fail(("cannot write " + fileName).c_str(), code, error);
  }
  for (const auto& [name, text] : tags)
  {
    code = av_dict_set(&this->Output->metadata, name.c_str(), text.c_str(), 0);
    if (code < 0)
    {
      return Fail("cannot store the description", code, error);
    }
  }
  return true;
}

bool ContainerWriter::AddTrack(const Track& track, int resolution,
  const std::vector<std::uint8_t>& parameterSets, std::string& error)
{
  AVStream* stream = avformat_new_stream(this->Output.get(), nullptr);
  const AVHandle<AVFrame> tags(av_frame_alloc());
  if (!stream || !tags ||
    !SetParameterSets(IDOfCodec(track.Coding), parameterSets, stream->codecpar))
  {
    return Fail("cannot add a track", AVERROR(ENOMEM), error);
  }
  TagFrame(track, resolution, tags.get());
  AVCodecParameters* parameters = stream->codecpar;
  parameters->format = tags->format;
  parameters->width = tags->width;
  parameters->height = tags->height;
  parameters->color_range = tags->color_range;
  parameters->color_primaries = tags->color_primaries;
  parameters->color_trc = tags->color_trc;
  parameters->color_space = tags->colorspace;
  parameters->chroma_location = tags->chroma_location;
  parameters->sample_aspect_ratio = { 1, 1 };
  if (track.Coding == Codec::HEVC && std::strcmp(this->Output->oformat->name, "mp4") == 0)
  {
    parameters->codec_tag = MKTAG('h', 'v', 'c', '1');
  }
  stream->time_base = FrameTime;
  stream->avg_frame_rate = { FrameRate, 1 };
  stream->disposition = track.Role == ColorRole ? AV_DISPOSITION_DEFAULT : 0;
  return true;
}

bool ContainerWriter::Begin(std::string& error)
{
  AVDictionary* options = nullptr;
  if (std::strcmp(this->Output->oformat->name, "mp4") == 0)
  {
    // Puts the index first: files open at once, and truncated files remain readable.
    av_dict_set(&options, "movflags", "+faststart", 0);
  }
  const int code = avformat_write_header(this->Output.get(), &options);
  av_dict_free(&options);
  return code >= 0 || Fail("cannot begin the container", code, error);
}

bool ContainerWriter::Write(
  std::size_t track, int start, int delay, const CodedGroup& group, std::string& error)
{
  const AVStream* stream = this->Output->streams[track];
  const AVHandle<AVPacket> packet(av_packet_alloc());
  for (std::size_t k = 0; packet && k < group.Frames.size(); ++k)
  {
    const CodedFrame& frame = group.Frames[k];
    int code = av_new_packet(packet.get(), static_cast<int>(frame.Data.size()));
    if (code >= 0)
    {
      std::copy(frame.Data.begin(), frame.Data.end(), packet->data);
      packet->stream_index = stream->index;
      packet->pts = start + frame.Index;
      packet->dts = start + static_cast<int>(k) - delay;
      packet->duration = 1;
      packet->flags = k == 0 ? AV_PKT_FLAG_KEY : 0;
      av_packet_rescale_ts(packet.get(), FrameTime, stream->time_base);
      code = av_write_frame(this->Output.get(), packet.get());
      av_packet_unref(packet.get());
    }
    if (code < 0)
    {
      return Fail("cannot write the file", code, error);
    }
  }
  return packet != nullptr || Fail("cannot write the file", AVERROR(ENOMEM), error);
}

bool ContainerWriter::End(std::string& error)
{
  int code = av_write_trailer(this->Output.get());
  if (code >= 0)
  {
    avio_flush(this->Output->pb);
    code = this->Output->pb->error;
  }
  const int closed = avio_closep(&this->Output->pb);
  code = code < 0 ? code : closed;
  return code >= 0 || Fail("cannot finish the file", code, error);
}
}
