// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMovie.h"

#include "Console/cslfMessages.h"

#ifdef CSLF_HAS_ENCODER
#include "Coding/Frames/cslfColorFrames.h"
#include "Console/cslfOutputFiles.h"

#include <vtkImageData.h>

#include <algorithm>
#include <cstddef>
#include <vector>
#else
#include "Fields/cslfFieldFiles.h"
#endif

namespace cslf::tool
{
#ifdef CSLF_HAS_ENCODER
namespace
{
constexpr const char* EncoderName = "libx264";
constexpr AVPixelFormat Format = AV_PIX_FMT_YUV420P;
constexpr int ColorBytes = 4;

/// x264's rate factor for almost invisible loss.
constexpr const char* RateFactor = "18";

class MovieWriter : public FrameWriter
{
public:
  explicit MovieWriter(const std::string& fileName)
    : FileName(fileName)
    , File(fileName)
    , Temporary(this->File.GetTemporaryName())
  {
  }

  void Open(int width, int height, double frameRate)
  {
    this->OpenEncoder(width, height, frameRate);
    this->Packet.reset(av_packet_alloc());
    this->Check(this->Packet ? 0 : AVERROR(ENOMEM));
    this->Frame = this->MakeFrame(width, height);
    this->Colors.resize(static_cast<std::size_t>(ColorBytes) * width * height);
    this->OpenContainer();
  }

  void Add(vtkImageData* picture) override
  {
    // VTK's pictures begin with the bottom row, those of videos with the top row.
    const int width = this->Frame->width;
    const int height = this->Frame->height;
    const auto* pixels = static_cast<const unsigned char*>(picture->GetScalarPointer());
    for (int y = height - 1; y >= 0; --y)
    {
      unsigned char* row = &this->Colors[static_cast<std::size_t>(ColorBytes) * width * y];
      for (int x = 0; x < width; ++x, pixels += 3)
      {
        std::copy_n(pixels, 3, row + static_cast<std::ptrdiff_t>(ColorBytes) * x);
      }
    }
    this->Check(av_frame_make_writable(this->Frame.get()));
    PutColors(this->Colors.data(), width, this->Frame.get());
    this->Frame->pts = this->Frames;
    ++this->Frames;
    this->Check(avcodec_send_frame(this->Encoder.get(), this->Frame.get()));
    this->WritePackets();
  }

  void Finish() override
  {
    this->Check(avcodec_send_frame(this->Encoder.get(), nullptr));
    this->WritePackets();
    this->Check(av_write_trailer(this->Output.get()));
    this->Check(avio_closep(&this->Output->pb));
    this->File.Publish();
  }

private:
  void Check(int code) const
  {
    if (code < 0)
    {
      FailWriting(this->FileName, AVErrorText(code));
    }
  }

  AVHandle<AVFrame> MakeFrame(int width, int height) const
  {
    AVHandle<AVFrame> frame(av_frame_alloc());
    this->Check(frame ? 0 : AVERROR(ENOMEM));
    frame->width = width;
    frame->height = height;
    frame->format = Format;
    frame->color_range = AVCOL_RANGE_MPEG;
    this->Check(av_frame_get_buffer(frame.get(), 0));
    return frame;
  }

  void OpenEncoder(int width, int height, double frameRate)
  {
    const AVCodec* codec = avcodec_find_encoder_by_name(EncoderName);
    this->Encoder.reset(codec ? avcodec_alloc_context3(codec) : nullptr);
    if (!this->Encoder)
    {
      throw Failure(std::string("This FFmpeg lacks ") + EncoderName +
        ", which is needed for videos of pictures: write a folder.");
    }
    constexpr int most = 1001000;
    const AVRational rate = av_d2q(frameRate, most);
    AVCodecContext* context = this->Encoder.get();
    context->width = width;
    context->height = height;
    context->pix_fmt = Format;
    context->color_range = AVCOL_RANGE_MPEG;
    context->color_primaries = AVCOL_PRI_BT709;
    context->color_trc = AVCOL_TRC_IEC61966_2_1;
    context->colorspace = AVCOL_SPC_BT709;
    context->chroma_sample_location = AVCHROMA_LOC_LEFT;
    context->framerate = rate;
    context->time_base = av_inv_q(rate);
    context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    av_opt_set(context->priv_data, "crf", RateFactor, 0);
    this->Check(avcodec_open2(context, codec, nullptr));
  }

  void OpenContainer()
  {
    AVFormatContext* output = nullptr;
    const AVOutputFormat* format = av_guess_format(nullptr, this->FileName.c_str(), nullptr);
    this->Check(avformat_alloc_output_context2(&output, format, nullptr, this->Temporary.c_str()));
    this->Output.reset(output);
    this->Stream = avformat_new_stream(output, nullptr);
    this->Check(this->Stream ? 0 : AVERROR(ENOMEM));
    this->Check(avcodec_parameters_from_context(this->Stream->codecpar, this->Encoder.get()));
    this->Stream->time_base = this->Encoder->time_base;
    this->Stream->avg_frame_rate = this->Encoder->framerate;
    this->Check(avio_open(&output->pb, this->Temporary.c_str(), AVIO_FLAG_WRITE));
    this->Check(avformat_write_header(output, nullptr));
  }

  /// Passes on all packets that the encoder has ready.
  void WritePackets()
  {
    int code = 0;
    while ((code = avcodec_receive_packet(this->Encoder.get(), this->Packet.get())) >= 0)
    {
      this->Packet->duration = 1;
      this->Packet->stream_index = this->Stream->index;
      av_packet_rescale_ts(this->Packet.get(), this->Encoder->time_base, this->Stream->time_base);
      this->Check(av_interleaved_write_frame(this->Output.get(), this->Packet.get()));
    }
    this->Check(code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : code);
  }

  AVLogSilence Silence;
  std::string FileName;
  OutputFile File;
  std::string Temporary;
  AVHandle<AVCodecContext> Encoder;
  std::vector<unsigned char> Colors; ///< as drawn, the top row first, 4 bytes each
  AVHandle<AVFrame> Frame;           ///< as encoded
  AVHandle<AVPacket> Packet;
  AVOutput Output;
  AVStream* Stream = nullptr;
  int Frames = 0;
};
}

std::unique_ptr<FrameWriter> MakeMovieWriter(
  const std::string& fileName, int width, int height, double frameRate)
{
  if (width % 2 != 0 || height % 2 != 0)
  {
    throw Failure("A video needs pictures of even width and height: choose another --size.");
  }
  auto writer = std::make_unique<MovieWriter>(fileName);
  writer->Open(width, height, frameRate);
  return writer;
}
#else
std::unique_ptr<FrameWriter> MakeMovieWriter(const std::string&, int, int, double)
{
  throw Failure(NoEncoder);
}
#endif
}
