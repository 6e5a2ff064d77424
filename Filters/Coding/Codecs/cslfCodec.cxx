// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCodec.h"

#include "cslfBitstreams.h"

#include <algorithm>
#include <cstring>

namespace cslf
{
namespace
{
struct CodecRow
{
  Codec Kind;
  const char* Name;
  AVCodecID ID;
  const Bitstream& (*GetBitstream)();
};

constexpr CodecRow Codecs[] = {
  { Codec::HEVC, "hevc", AV_CODEC_ID_HEVC, GetHEVCBitstream },
  { Codec::AV1, "av1", AV_CODEC_ID_AV1, GetAV1Bitstream },
  { Codec::H264, "h264", AV_CODEC_ID_H264, GetH264Bitstream },
};

const CodecRow& GetRow(Codec codec)
{
  return *std::find_if(std::begin(Codecs), std::end(Codecs),
    [codec](const CodecRow& row) { return row.Kind == codec; });
}
}

const std::vector<Codec>& GetCodecs()
{
  static const std::vector<Codec> codecs = []
  {
    std::vector<Codec> all;
    for (const CodecRow& row : Codecs)
    {
      all.push_back(row.Kind);
    }
    return all;
  }();
  return codecs;
}

const char* NameOfCodec(Codec codec)
{
  return GetRow(codec).Name;
}

std::optional<Codec> CodecOfName(const std::string& name)
{
  for (const CodecRow& row : Codecs)
  {
    if (name == row.Name)
    {
      return row.Kind;
    }
  }
  return std::nullopt;
}

AVCodecID IDOfCodec(Codec codec)
{
  return GetRow(codec).ID;
}

const AVCodec* FindDecoder(AVCodecID codec)
{
  // FFmpeg's own AV1 decoder, which it returns if it has no other, only works with hardware.
  const AVCodec* decoder = avcodec_find_decoder(codec);
  return decoder && codec == AV_CODEC_ID_AV1 && std::strcmp(decoder->name, "av1") == 0 ? nullptr
                                                                                       : decoder;
}

const Bitstream& GetBitstream(Codec codec)
{
  return GetRow(codec).GetBitstream();
}
}
