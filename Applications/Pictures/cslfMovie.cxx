// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMovie.h"

#include "Console/cslfMessages.h"
#include "Fields/cslfFieldFiles.h"

#ifdef CSLF_HAS_ENCODER
#include "Coding/Frames/cslfColorFrames.h"

#include <vtkImageData.h>

#include <algorithm>
#include <cstddef>
#include <vector>
#endif

namespace cslf::tool
{
const MovieFormat* FindMovieFormat(const std::string& fileName)
{
  // Almost invisible loss.
  static const MovieFormat formats[] = {
    { ".mp4", "libx264", "crf=18", true },
    { ".mkv", "libx264", "crf=18", true },
    { ".webm", "libvpx-vp9", "crf=20:b=0:deadline=good:cpu-used=4:row-mt=1", true },
    { ".webp", "libwebp_anim", "quality=90", false },
  };
  const std::string extension = LowerExtension(fileName);
  for (const MovieFormat& format : formats)
  {
    if (extension == format.Extension)
    {
      return &format;
    }
  }
  return nullptr;
}

#ifdef CSLF_HAS_ENCODER
namespace
{
constexpr int ColorBytes = 4;

class MovieWriter : public FrameWriter
{
public:
  explicit MovieWriter(const std::string& fileName)
    : FileName(fileName)
    , Format(*FindMovieFormat(fileName))
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
    this->Frame->pts = -1; // there is none yet
    this->Colors.resize(static_cast<std::size_t>(ColorBytes) * width * height);
    this->OpenContainer();
  }

  void Add(vtkImageData* picture, int frames) override
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
    if (this->Format.IsSubsampled)
    {
      PutColors(this->Colors.data(), width, this->Frame.get());
    }
    else
    {
      this->PutRGB();
    }
    this->Encode(this->Frames);
    this->Frames += frames;
  }

  void Finish() override
  {
    // The end of the last picture, whose duration no other picture tells.
    if (this->Frames > this->Frame->pts + 1)
    {
      this->Encode(this->Frames - 1);
    }
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
    frame->format = this->Encoder->pix_fmt;
    frame->color_range = this->Encoder->color_range;
    this->Check(av_frame_get_buffer(frame.get(), 0));
    return frame;
  }

  void OpenEncoder(int width, int height, double frameRate)
  {
    const AVCodec* codec = avcodec_find_encoder_by_name(this->Format.Encoder);
    this->Encoder.reset(codec ? avcodec_alloc_context3(codec) : nullptr);
    if (!this->Encoder)
    {
      throw Failure(std::string("This FFmpeg lacks ") + this->Format.Encoder + ", which " +
        this->Format.Extension + " needs: write a folder, or another format.");
    }
    constexpr int most = 1001000;
    const AVRational rate = av_d2q(frameRate, most);
    AVCodecContext* context = this->Encoder.get();
    context->width = width;
    context->height = height;
    context->pix_fmt = AV_PIX_FMT_BGRA;
    if (this->Format.IsSubsampled)
    {
      context->pix_fmt = AV_PIX_FMT_YUV420P;
      context->color_range = AVCOL_RANGE_MPEG;
      context->color_primaries = AVCOL_PRI_BT709;
      context->color_trc = AVCOL_TRC_IEC61966_2_1;
      context->colorspace = AVCOL_SPC_BT709;
      context->chroma_sample_location = AVCHROMA_LOC_LEFT;
    }
    context->framerate = rate;
    context->time_base = av_inv_q(rate);
    context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    AVDictionary* quality = nullptr;
    av_dict_parse_string(&quality, this->Format.Quality, "=", ":", 0);
    const int code = avcodec_open2(context, codec, &quality);
    av_dict_free(&quality);
    this->Check(code);
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
    AVDictionary* endless = nullptr;
    av_dict_set(&endless, "loop", "0", 0); // of WebP
    const int code = avformat_write_header(output, &endless);
    av_dict_free(&endless);
    this->Check(code);
  }

  /// Copies the colours to the frame as blue, green, red and an alpha of 1.
  void PutRGB()
  {
    for (int y = 0; y < this->Frame->height; ++y)
    {
      const std::size_t bytes = static_cast<std::size_t>(ColorBytes) * this->Frame->width;
      const unsigned char* source = &this->Colors[bytes * y];
      unsigned char* row = this->Frame->data[0] + std::ptrdiff_t(y) * this->Frame->linesize[0];
      for (std::size_t x = 0; x < bytes; x += ColorBytes)
      {
        row[x] = source[x + 2];
        row[x + 1] = source[x + 1];
        row[x + 2] = source[x];
        row[x + 3] = 255;
      }
    }
  }

  /// Encodes the picture to be shown from this frame on.
  void Encode(int frame)
  {
    this->Frame->pts = frame;
    this->Check(avcodec_send_frame(this->Encoder.get(), this->Frame.get()));
    this->WritePackets();
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
  const MovieFormat& Format;
  OutputFile File;
  std::string Temporary;
  AVHandle<AVCodecContext> Encoder;
  std::vector<unsigned char> Colors; ///< as drawn, the top row first, 4 bytes each
  AVHandle<AVFrame> Frame;           ///< as encoded
  AVHandle<AVPacket> Packet;
  AVOutput Output;
  AVStream* Stream = nullptr;
  int Frames = 0; ///< that are shown by the pictures so far
};
}

std::unique_ptr<FrameWriter> MakeMovieWriter(
  const std::string& fileName, int width, int height, double frameRate)
{
  const bool isOdd = width % 2 != 0 || height % 2 != 0;
  if (isOdd && FindMovieFormat(fileName)->IsSubsampled)
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
