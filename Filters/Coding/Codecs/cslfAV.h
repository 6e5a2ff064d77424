// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * FFmpeg's objects as owned handles, and its messages.
 */
#ifndef cslfAV_h
#define cslfAV_h

extern "C"
{
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/dict.h>
#include <libavutil/frame.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
#include <libavutil/pixdesc.h>
}

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <vector>

namespace cslf
{
struct AVDeleter
{
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVCodecContext* context) const { avcodec_free_context(&context); }
  void operator()(AVCodecParameters* parameters) const { avcodec_parameters_free(&parameters); }
  void operator()(AVCodecParserContext* parser) const { av_parser_close(parser); }
  void operator()(AVDictionary* dictionary) const { av_dict_free(&dictionary); }
};

/// An FFmpeg object that frees itself.
template <typename T>
using AVHandle = std::unique_ptr<T, AVDeleter>;

struct AVInputDeleter
{
  void operator()(AVFormatContext* context) const { avformat_close_input(&context); }
};

/// A container open for reading.
using AVInput = std::unique_ptr<AVFormatContext, AVInputDeleter>;

struct AVOutputDeleter
{
  void operator()(AVFormatContext* context) const
  {
    avio_closep(&context->pb);
    avformat_free_context(context);
  }
};

/// A container open for writing.
using AVOutput = std::unique_ptr<AVFormatContext, AVOutputDeleter>;

/// Adds parameter sets to otherwise empty parameters of a video codec. False if there is not enough
/// memory.
inline bool SetParameterSets(
  AVCodecID codec, const std::vector<std::uint8_t>& sets, AVCodecParameters* parameters)
{
  parameters->codec_type = AVMEDIA_TYPE_VIDEO;
  parameters->codec_id = codec;
  parameters->extradata =
    static_cast<std::uint8_t*>(av_mallocz(sets.size() + AV_INPUT_BUFFER_PADDING_SIZE));
  if (!parameters->extradata)
  {
    return false;
  }
  std::copy(sets.begin(), sets.end(), parameters->extradata);
  parameters->extradata_size = static_cast<int>(sets.size());
  return true;
}

/// Returns the code, or throws std::bad_alloc if it means that there is not enough memory.
inline int RequireMemory(int code)
{
  if (code == AVERROR(ENOMEM))
  {
    throw std::bad_alloc();
  }
  return code;
}

/// Returns the object, or throws std::bad_alloc if it is null.
template <typename T>
T* RequireMemory(T* object)
{
  if (!object)
  {
    throw std::bad_alloc();
  }
  return object;
}

/// The meaning of an error code of FFmpeg.
inline std::string AVErrorText(int code)
{
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof(text));
  return text;
}

/// Keeps FFmpeg from printing while it lives. Scopes may nest and overlap between threads. The last
/// one restores the log level that the first one found.
class AVLogSilence
{
public:
  AVLogSilence()
  {
    State& state = AVLogSilence::GetState();
    const std::lock_guard<std::mutex> lock(state.Mutex);
    if (state.Count++ == 0)
    {
      state.Level = av_log_get_level();
      av_log_set_level(AV_LOG_QUIET);
    }
  }
  ~AVLogSilence()
  {
    State& state = AVLogSilence::GetState();
    const std::lock_guard<std::mutex> lock(state.Mutex);
    if (--state.Count == 0)
    {
      av_log_set_level(state.Level);
    }
  }
  AVLogSilence(const AVLogSilence&) = delete;
  AVLogSilence& operator=(const AVLogSilence&) = delete;

private:
  struct State
  {
    std::mutex Mutex;
    int Count = 0;
    int Level = AV_LOG_INFO;
  };

  static State& GetState()
  {
    static State state;
    return state;
  }
};
}

#endif
