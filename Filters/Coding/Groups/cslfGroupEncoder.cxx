// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGroupEncoder.h"

#include "Coding/Frames/cslfFrameConverter.h"
#include "cslfDecimalPoint.h"
#include "cslfJoin.h"
#include "cslfLayout.h"

#include <algorithm>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <set>
#include <vector>

namespace cslf
{
namespace
{
/// Collects the warnings and errors of FFmpeg on this thread while it lives. Those of other threads
/// take FFmpeg's default way.
class WarningCapture
{
public:
  explicit WarningCapture(std::vector<std::string>& warnings)
  {
    Warnings = &warnings;
    const std::lock_guard<std::mutex> lock(GetMutex());
    if (GetCount()++ == 0)
    {
      av_log_set_callback(Receive);
    }
  }
  ~WarningCapture()
  {
    Warnings = nullptr;
    const std::lock_guard<std::mutex> lock(GetMutex());
    if (--GetCount() == 0)
    {
      av_log_set_callback(av_log_default_callback);
    }
  }
  WarningCapture(const WarningCapture&) = delete;
  WarningCapture& operator=(const WarningCapture&) = delete;

private:
  static void Receive(void* source, int level, const char* format, va_list arguments)
  {
    constexpr int levelMask = 0xff; // above are colours
    if (!Warnings)
    {
      av_log_default_callback(source, level, format, arguments);
    }
    else if ((level & levelMask) <= AV_LOG_WARNING)
    {
      char text[1024];
      std::vsnprintf(text, sizeof(text), format, arguments);
      Warnings->emplace_back(text);
    }
  }

  static std::mutex& GetMutex()
  {
    static std::mutex mutex;
    return mutex;
  }

  static int& GetCount()
  {
    static int count = 0;
    return count;
  }

  static thread_local std::vector<std::string>* Warnings;
};

thread_local std::vector<std::string>* WarningCapture::Warnings = nullptr;

/// Whether a text contains a name, but not as a part of a longer one.
bool Names(const std::string& text, const std::string& name)
{
  const auto isPart = [](char letter)
  { return std::isalnum(static_cast<unsigned char>(letter)) || letter == '-' || letter == '_'; };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1))
  {
    const std::size_t end = at + name.size();
    if ((at == 0 || !isPart(text[at - 1])) && (end == text.size() || !isPart(text[end])))
    {
      return true;
    }
  }
  return false;
}

std::string Refuse(const VideoEncoder& encoder, const EncoderOption& option)
{
  return std::string("the encoder ") + encoder.Name + " does not accept the option \"" +
    option.Name + "=" + option.Value + "\"";
}

/// The last of a library's options that one of the messages names, or null. The last one takes
/// effect.
const EncoderOption* FindNamed(
  const std::vector<EncoderOption>& options, const std::vector<std::string>& messages)
{
  const auto found = std::find_if(options.rbegin(), options.rend(),
    [&](const EncoderOption& option)
    {
      return std::any_of(messages.begin(), messages.end(),
        [&](const std::string& message) { return Names(message, option.Name); });
    });
  return found == options.rend() ? nullptr : &*found;
}

/// The library's options as FFmpeg passes them on.
std::string JoinOptions(const std::vector<EncoderOption>& options)
{
  return JoinAs(
    options, [](const EncoderOption& option) { return option.Name + "=" + option.Value; }, ":");
}

bool SetOptions(const VideoEncoder& encoder, const EncoderOptions& options, AVCodecContext* context,
  std::string& error)
{
  std::vector<EncoderOption> all = options.OfFFmpeg;
  if (!options.OfLibrary.empty())
  {
    all.push_back({ encoder.LibraryOption, JoinOptions(options.OfLibrary) });
  }
  for (const EncoderOption& option : all)
  {
    if (av_opt_set(context->priv_data, option.Name.c_str(), option.Value.c_str(), 0) < 0)
    {
      error = Refuse(encoder, option);
      return false;
    }
  }
  if (options.KeyFrameDistance > 0)
  {
    context->gop_size = options.KeyFrameDistance;
  }
  return true;
}

/// Calls avcodec_open2 and checks whether the library accepts its options.
bool Open(const VideoEncoder& encoder, const AVCodec* codec, const EncoderOptions& options,
  AVCodecContext* context, std::string& error)
{
  static std::mutex mutex;
  static std::set<std::string> checked;
  const std::string key = std::string(encoder.Name) + " " + JoinOptions(options.OfLibrary);
  bool isChecked = false;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    isChecked = checked.count(key) != 0;
  }
  std::vector<std::string> warnings;
  int code = 0;
  if (isChecked)
  {
    code = avcodec_open2(context, codec, nullptr);
  }
  else
  {
    const WarningCapture capture(warnings);
    code = avcodec_open2(context, codec, nullptr);
  }
  if (const EncoderOption* refused = FindNamed(options.OfLibrary, warnings))
  {
    error = Refuse(encoder, *refused);
    return false;
  }
  if (code < 0)
  {
    error = "the encoder refuses frames of " + std::to_string(context->width) + " x " +
      std::to_string(context->height) + " " + NameOfFormat(context->pix_fmt) + ": " +
      AVErrorText(code);
    return false;
  }
  const std::lock_guard<std::mutex> lock(mutex);
  checked.insert(key);
  return true;
}
}

AVHandle<AVCodecContext> OpenEncoder(const VideoEncoder& encoder, const Track& track,
  int resolution, const EncoderOptions& options, std::string& error)
{
  const AVCodec* codec = avcodec_find_encoder_by_name(encoder.Name);
  AVHandle<AVCodecContext> context(codec ? avcodec_alloc_context3(codec) : nullptr);
  const AVHandle<AVFrame> tags(av_frame_alloc());
  if (!context || !tags)
  {
    error = std::string("this FFmpeg cannot open the encoder ") + encoder.Name;
    return nullptr;
  }
  TagFrame(track, resolution, tags.get());
  context->width = tags->width;
  context->height = tags->height;
  context->pix_fmt = track.Format;
  context->color_range = tags->color_range;
  context->color_primaries = tags->color_primaries;
  context->color_trc = tags->color_trc;
  context->colorspace = tags->colorspace;
  context->chroma_sample_location = tags->chroma_location;
  context->time_base = { 1, FrameRate };
  context->framerate = { FrameRate, 1 };
  context->thread_count = 1;
  context->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  // For SVT-AV1, whose encoder cannot be closed before the end of a video. It refuses unknown
  // options before it begins a video.
  context->err_recognition |= AV_EF_EXPLODE;
  const DecimalPoint point;
  const bool isOpen = SetOptions(encoder, options, context.get(), error) &&
    Open(encoder, codec, options, context.get(), error);
  return isOpen ? std::move(context) : nullptr;
}

namespace
{
/// Takes all packets that the encoder has ready.
int TakePackets(AVCodecContext* context, const Bitstream& bitstream,
  const std::function<bool()>& proceed, AVPacket* packet, CodedGroup& group)
{
  int code = 0;
  while ((code = avcodec_receive_packet(context, packet)) >= 0)
  {
    if (!proceed())
    {
      return AVERROR_EXIT;
    }
    CodedFrame frame;
    frame.Index = static_cast<int>(packet->pts);
    frame.Data = bitstream.Trim(packet->data, static_cast<std::size_t>(packet->size));
    group.Frames.push_back(std::move(frame));
    av_packet_unref(packet);
  }
  return code == AVERROR(EAGAIN) || code == AVERROR_EOF ? 0 : code;
}

int EncodeFrames(AVCodecContext* context, const Track& track, int resolution,
  const std::vector<ViewpointSamples>& slices, const std::function<bool()>& proceed,
  CodedGroup& group)
{
  SliceToFrame converter(track, resolution);
  const Bitstream& bitstream = GetBitstream(track.Coding);
  AVHandle<AVPacket> packet(av_packet_alloc());
  if (!packet)
  {
    return AVERROR(ENOMEM);
  }
  for (std::size_t k = 0; k < slices.size(); ++k)
  {
    if (!proceed())
    {
      return AVERROR_EXIT;
    }
    AVHandle<AVFrame> frame(av_frame_alloc());
    if (!frame)
    {
      return AVERROR(ENOMEM);
    }
    TagFrame(track, resolution, frame.get());
    frame->pts = static_cast<std::int64_t>(k);
    int code = av_frame_get_buffer(frame.get(), 0);
    if (code < 0)
    {
      return code;
    }
    converter.Convert(slices[k], frame.get());
    if ((code = avcodec_send_frame(context, frame.get())) < 0 ||
      (code = TakePackets(context, bitstream, proceed, packet.get(), group)) < 0)
    {
      return code;
    }
  }
  const int code = avcodec_send_frame(context, nullptr);
  return code < 0 ? code : TakePackets(context, bitstream, proceed, packet.get(), group);
}

/// Whether the encoder returned every frame once, the first one first; computes the checksum.
bool SealGroup(const Bitstream& bitstream, std::size_t frames, CodedGroup& group)
{
  // Packets are trimmed in the form of encoders: NAL units have start codes.
  Framing framing;
  if (!bitstream.ReadConfiguration(group.ParameterSets.data(), group.ParameterSets.size(), framing))
  {
    return false;
  }
  std::vector<bool> seen(frames, false);
  for (const CodedFrame& frame : group.Frames)
  {
    if (frame.Index < 0 || static_cast<std::size_t>(frame.Index) >= frames || seen[frame.Index] ||
      frame.Data.empty() ||
      !bitstream.AddToCRC(frame.Data.data(), frame.Data.size(), framing, group.CRC))
    {
      return false;
    }
    seen[frame.Index] = true;
  }
  return group.Frames.size() == frames && group.Frames.front().Index == 0;
}

bool IsCoveredFully(int resolution, int layer, const std::vector<ViewpointSamples>& slices)
{
  const std::size_t texels = static_cast<std::size_t>(TileCount) * resolution * resolution;
  for (const ViewpointSamples& slice : slices)
  {
    const ColorTexels colors(slice, layer);
    for (std::size_t texel = 0; texel < texels; ++texel)
    {
      if (colors.GetCoverage(texel) != 255)
      {
        return false;
      }
    }
  }
  return true;
}
}

bool EncodeGroup(const Track& track, int resolution, const EncodeOptions& options,
  const std::vector<ViewpointSamples>& slices, const std::function<bool()>& proceed,
  CodedGroup& group, std::string& error)
{
  group = CodedGroup();
  const VideoEncoder* encoder = FindEncoder(track.Coding, track.Format, resolution);
  if (!encoder)
  {
    error = "this FFmpeg has no encoder for " + std::string(NameOfCodec(track.Coding)) + " as " +
      NameOfFormat(track.Format);
    return false;
  }
  // SVT-AV1 up to version 1 keeps settings in global variables.
  static std::mutex alone;
  std::unique_lock<std::mutex> lock(alone, std::defer_lock);
  if (!encoder->CanShareProcess)
  {
    lock.lock();
  }
  const AVHandle<AVCodecContext> context =
    OpenEncoder(*encoder, track, resolution, encoder->MakeOptions(track, options), error);
  if (!context)
  {
    return false;
  }
  const int code = EncodeFrames(context.get(), track, resolution, slices, proceed, group);
  if (code < 0)
  {
    error = code == AVERROR_EXIT ? Stopped : "the encoder failed: " + AVErrorText(code);
    return false;
  }
  const Bitstream& bitstream = GetBitstream(track.Coding);
  group.ParameterSets = bitstream.FindParameterSets(
    { context->extradata, context->extradata + context->extradata_size },
    group.Frames.empty() ? std::vector<std::uint8_t>() : group.Frames.front().Data);
  if (!SealGroup(bitstream, slices.size(), group))
  {
    error = "the encoder did not give one packet for each frame";
    return false;
  }
  group.CoveredFully = track.Role.Samples == Plane::Coverage &&
    IsCoveredFully(resolution, track.Role.Source.Layer, slices);
  return true;
}
}
