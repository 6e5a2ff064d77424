// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFrameFiles.h"

#include "Coding/Frames/cslfColorFrames.h"
#include "Console/cslfMessages.h"
#include "Console/cslfSceneText.h"
#include "Fields/cslfFieldFiles.h"
#include "Files/cslfFileSystem.h"
#include "Images/cslfImageFiles.h"
#include "cslfPictures.h"

#include <vtkImageData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <system_error>
#include <vector>

namespace cslf::tool
{
namespace
{
/// How FFmpeg encodes a movie.
struct MovieFormat
{
  const char* Extension;
  const char* Encoder;
  const char* Quality; ///< the encoder's options: name=value:name=value
  bool IsSubsampled;   ///< in YCbCr, otherwise RGB
};

/// The format of a file name. Null if its extension is of none.
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

/// Throws a Failure if this tool or its FFmpeg cannot encode such pictures. If the format is
/// subsampled, their width and height must be even.
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
}

namespace fs = std::filesystem;

namespace cslf::tool
{
namespace
{
std::string NameFrame(int frame)
{
  char name[32];
  std::snprintf(name, sizeof(name), "frame-%04d.png", frame);
  return name;
}

/// The frames in a folder.
std::vector<std::string> ListFrames(const std::string& folder)
{
  static const std::regex frame("frame-[0-9]{4,}\\.png");
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(ToPath(folder), ignored))
  {
    const std::string name = ToName(entry.path().filename());
    if (std::regex_match(name, frame))
    {
      names.push_back(name);
    }
  }
  return names;
}

/// A folder, filled under a temporary name.
class FolderWriter : public FrameWriter
{
public:
  explicit FolderWriter(const std::string& folder)
    : Folder(folder)
    , Whole(folder, ListFrames)
  {
    std::string error;
    if (!this->Whole.Open("frames", error))
    {
      FailWriting(folder, error);
    }
  }

  void Add(vtkImageData* picture, int frames) override
  {
    const auto bytes = EncodePNG(picture);
    for (int end = this->Frames + frames; this->Frames < end; ++this->Frames)
    {
      std::string error;
      if (!MakeFile(this->Whole.GetTemporaryName() + "/" + NameFrame(this->Frames),
            bytes->GetPointer(0), bytes->GetNumberOfValues(), error))
      {
        FailWriting(this->Folder, error);
      }
    }
  }

  void Finish() override { PublishWhole(this->Whole, this->Folder); }

private:
  std::string Folder;
  AtomicFolder Whole;
  int Frames = 0;
};

/// A GIF, whose colours are dithered.
class GIFWriter : public FrameWriter
{
public:
  GIFWriter(const std::string& fileName, int width, int height, double frameRate)
    : File(fileName, std::array<int, 2>{ width, height }.data(), frameRate)
  {
  }

  void Add(vtkImageData* picture, int frames) override { this->File.Add(picture, frames); }
  void Finish() override { this->File.Publish(); }

private:
  ImageFile File;
};

/// Multiplies the delays of the pictures of a GIF, as OpenImageIO writes one delay for all. False
/// if the file cannot be changed.
bool ScaleDelays(const std::string& fileName, const std::vector<int>& factors)
{
  constexpr std::size_t header = 13;
  constexpr unsigned char extension = 0x21;
  constexpr unsigned char control = 0xf9;
  constexpr unsigned char image = 0x2c;
  constexpr unsigned int most = 0xffff;
  std::string bytes = ReadBytes(fileName);
  const auto at = [&bytes](std::size_t i)
  { return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u; };
  const auto tableSize = [](unsigned int flags)
  { return (flags & 0x80) != 0 ? std::size_t{ 6 } << (flags & 7) : 0; };
  std::size_t picture = 0;
  std::size_t place = header + tableSize(at(10));
  while (at(place) == extension || at(place) == image)
  {
    if (at(place) == extension && at(place + 1) == control && picture < factors.size() &&
      place + 5 < bytes.size())
    {
      const unsigned int delay =
        std::min((at(place + 4) | at(place + 5) << 8) * factors[picture++], most);
      bytes[place + 4] = static_cast<char>(delay & 0xff);
      bytes[place + 5] = static_cast<char>(delay >> 8);
    }
    // Blocks of data follow, the last of which is empty.
    place += at(place) == extension ? 2 : 11 + tableSize(at(place + 9));
    while (at(place) != 0)
    {
      place += 1 + at(place);
    }
    ++place;
  }
  std::fstream file(ToPath(fileName), std::ios::binary | std::ios::in | std::ios::out);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  return picture == factors.size() && !file.fail();
}

/// Whether a file can be decoded as an image. OpenImageIO does not notice all disk errors.
bool IsWholeImage(const std::string& fileName)
{
  std::string reason;
  const auto input = OpenImage({ fileName }, reason);
  std::vector<unsigned char> pixels;
  bool isWhole = input != nullptr;
  for (bool isOpen = isWhole; isOpen && isWhole; isOpen = input->GoOn())
  {
    const ImageHeader& header = input->GetHeader();
    pixels.resize(std::size_t(header.Width) * header.Height * header.Channels);
    isWhole = input->Read(PixelType::Bytes, pixels.data(), reason);
  }
  return isWhole;
}
}

bool IsMovieName(const std::string& fileName)
{
  return FindMovieFormat(fileName) || LowerExtension(fileName) == ".gif";
}

std::unique_ptr<FrameWriter> MakeFrameWriter(
  const std::string& output, int width, int height, double frameRate)
{
  if (IsMovieName(output))
  {
    RequireWritable(output);
    if (FindMovieFormat(output))
    {
      return MakeMovieWriter(output, width, height, frameRate);
    }
    return std::make_unique<GIFWriter>(output, width, height, frameRate);
  }
  const fs::path folder = ToPath(ResolveTarget(output));
  std::error_code failure;
  if (folder.has_extension() && !fs::is_directory(folder, failure))
  {
    throw Failure(
      "Cannot write " + output + ": several pictures are written to " + FrameFormats + ".");
  }
  return std::make_unique<FolderWriter>(output);
}

struct ImageFile::Output
{
  std::unique_ptr<ImageWriter> Writer;
  std::vector<int> Frames; ///< for which each picture is shown
};

ImageFile::ImageFile(const std::string& fileName, const int size[2], double frameRate)
  : File(fileName)
  , Image(std::make_unique<Output>())
{
  const std::string extension = LowerExtension(fileName);
  ImageHeader header;
  header.Width = size[0];
  header.Height = size[1];
  header.Channels = 3;
  header.Type = PixelType::Bytes;
  // Almost invisible loss. Each format ignores what is not for it.
  header.Attributes = { { "compression", extension == ".webp" ? "webp:95" : "jpeg:95" },
    { "jpeg:subsampling", "4:4:4" }, { ColorSpaceAttribute, "sRGB" } };
  std::string error;
  const ImageLibrary* library = GetImageLibrary(error);
  if (!library)
  {
    throw Failure(error);
  }
  this->Image->Writer =
    library->Create(this->File.GetTemporaryName(), extension.substr(1), header, frameRate, error);
  if (!this->Image->Writer)
  {
    throw Failure("This OpenImageIO cannot write " + extension + ", which " + fileName + " needs.");
  }
}

ImageFile::~ImageFile() = default;

void ImageFile::Add(vtkImageData* picture, int frames)
{
  // VTK's pictures begin with the bottom row.
  const std::ptrdiff_t row = 3 * std::ptrdiff_t(picture->GetDimensions()[0]);
  const auto* last = static_cast<const unsigned char*>(picture->GetScalarPointer()) +
    row * (picture->GetDimensions()[1] - 1);
  std::string error;
  if (!this->Image->Writer->Add(last, -row, error))
  {
    FailWriting(this->File.GetName(), error);
  }
  this->Image->Frames.push_back(frames);
}

void ImageFile::Publish()
{
  std::string error;
  if (!this->Image->Writer->Finish(error) || !IsWholeImage(this->File.GetTemporaryName()))
  {
    FailWriting(this->File.GetName(), error);
  }
  const std::vector<int>& frames = this->Image->Frames;
  const bool isEven =
    std::all_of(frames.begin(), frames.end(), [](int count) { return count == 1; });
  if (!isEven && !ScaleDelays(this->File.GetTemporaryName(), frames))
  {
    FailWriting(this->File.GetName(), "");
  }
  this->File.Publish();
}
}
