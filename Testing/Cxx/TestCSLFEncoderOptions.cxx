// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Each encoder accepts its options. Unknown options and invalid values are refused by name.
#include "cslfTesting.h"

#include "Coding/Frames/cslfColorFrames.h"
#include "Coding/Groups/cslfGroupEncoder.h"

#include <iostream>
#include <string>
#include <vector>

namespace
{
struct Case
{
  cslf::Codec Codec;
  AVPixelFormat Format;
  int Resolution;
  const char* Option; ///< of the library: a known one, and an invalid value
  const char* Value;
};

const Case Cases[] = {
  { cslf::Codec::HEVC, AV_PIX_FMT_YUV444P, 16, "bframes", "many" },
  { cslf::Codec::H264, AV_PIX_FMT_YUV444P, 16, "bframes", "many" },
  { cslf::Codec::AV1, AV_PIX_FMT_YUV420P10, 64, "lp", "many" },
  { cslf::Codec::AV1, AV_PIX_FMT_YUV444P, 16, "deltaq-mode", "-7" },
};

/// SVT-AV1 cannot be closed before the end of a video.
void CodeOneFrame(AVCodecContext* context)
{
  const cslf::AVHandle<AVFrame> frame(av_frame_alloc());
  frame->width = context->width;
  frame->height = context->height;
  frame->format = context->pix_fmt;
  frame->pts = 0;
  CSLF_CHECK(av_frame_get_buffer(frame.get(), 0) >= 0);
  const std::vector<unsigned char> black(
    static_cast<std::size_t>(4) * frame->width * frame->height);
  cslf::PutColors(black.data(), frame->height, frame.get());
  CSLF_CHECK(avcodec_send_frame(context, frame.get()) >= 0);
  CSLF_CHECK(avcodec_send_frame(context, nullptr) >= 0);
  const cslf::AVHandle<AVPacket> packet(av_packet_alloc());
  while (avcodec_receive_packet(context, packet.get()) >= 0)
  {
    av_packet_unref(packet.get());
  }
}

/// The error of a list of options. Empty if there is none.
std::string FindError(const Case& item, const cslf::VideoEncoder& encoder,
  std::vector<cslf::EncoderOption> cslf::EncoderOptions::*list, const cslf::EncoderOption& more)
{
  cslf::Track track;
  track.Format = item.Format;
  track.Coding = item.Codec;
  cslf::EncoderOptions options = encoder.MakeOptions(track, {});
  if (!more.Name.empty())
  {
    (options.*list).push_back(more);
  }
  std::string error;
  const auto context = cslf::OpenEncoder(encoder, track, item.Resolution, options, error);
  CSLF_CHECK((context == nullptr) == !error.empty());
  if (context)
  {
    CodeOneFrame(context.get());
  }
  return error;
}

void TestEncoder(const Case& item, const cslf::VideoEncoder& encoder)
{
  const std::string refusal =
    std::string("the encoder ") + encoder.Name + " does not accept the option ";
  const auto ofLibrary = &cslf::EncoderOptions::OfLibrary;
  const auto ofFFmpeg = &cslf::EncoderOptions::OfFFmpeg;
  // Again after each refusal: an earlier check must not count for other options.
  for (int round = 0; round < 2; ++round)
  {
    CSLF_CHECK(FindError(item, encoder, ofLibrary, {}).empty());
    CSLF_CHECK(FindError(item, encoder, ofLibrary, { "no-such-option", "1" }) ==
      refusal + "\"no-such-option=1\"");
    CSLF_CHECK(FindError(item, encoder, ofLibrary, { item.Option, item.Value }) ==
      refusal + "\"" + item.Option + "=" + item.Value + "\"");
    CSLF_CHECK(FindError(item, encoder, ofFFmpeg, { "no-such", "1" }) == refusal + "\"no-such=1\"");
    CSLF_CHECK(FindError(item, encoder, ofFFmpeg, { "crf", "good" }) == refusal + "\"crf=good\"");
  }
}
}

int TestCSLFEncoderOptions(int, char*[])
{
  const cslf::AVLogSilence silence;
  for (const Case& item : Cases)
  {
    const cslf::VideoEncoder* encoder = cslf::FindEncoder(item.Codec, item.Format, item.Resolution);
    if (encoder)
    {
      std::cout << encoder->Name << "\n";
      TestEncoder(item, *encoder);
    }
    else
    {
      std::cout << "This FFmpeg cannot encode " << cslf::NameOfCodec(item.Codec) << ": skipped.\n";
    }
  }
  return cslf::testing::Result();
}
