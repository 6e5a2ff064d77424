// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfVideoEncoders.h"

#include <vtkSMPTools.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>

namespace cslf
{
namespace
{
/// The smallest picture that HEVC can code. It is used for the other codecs, too.
constexpr int MinimumResolution = 16;

/// The minimum of SVT-AV1 up to version 1.
constexpr int MinimumResolutionOfSVT = 64;

/// Frames to look ahead: all of any group.
constexpr int Lookahead = 2 * MaximumGroupLength;

int IndexOfPreset(const std::string& preset)
{
  const auto& presets = GetPresets();
  return static_cast<int>(std::find(presets.begin(), presets.end(), preset) - presets.begin());
}

std::string ToText(double number)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(std::numeric_limits<double>::max_digits10) << number;
  return text.str();
}

void Append(const std::vector<EncoderOption>& more, std::vector<EncoderOption>& options)
{
  options.insert(options.end(), more.begin(), more.end());
}

/// Extra options of x265 for colour; other tracks gain nothing by them. "slow" is x265's preset
/// with the rate-distortion analysis of "slower", which has most of the gain in half the time, and
/// more references. Chroma is a little finer, because it matters more for red, green and blue than
/// the analysis assumes.
std::vector<EncoderOption> GetColorOptions(AVPixelFormat format, const std::string& preset)
{
  std::vector<EncoderOption> options = { { "b-intra", "1" } };
  if (preset == "slow")
  {
    Append({ { "rd", "6" }, { "limit-refs", "1" } }, options);
  }
  if (format != AV_PIX_FMT_GBRP)
  {
    Append({ { "cbqpoffs", "-2" }, { "crqpoffs", "-2" } }, options);
  }
  return options;
}

/// x265: one thread, so that bytes do not depend on the machine's load; no weighted prediction, and
/// early skip, because libx265 3.5 otherwise decides both by uninitialised memory, so that bytes
/// would depend on what the process did before; a closed group without scene cuts; no psycho-visual
/// options, which add false detail. Blocks of coverage and depth may always be divided: x265 would
/// leave thin edges in large blocks whose surroundings are flat.
EncoderOptions MakeX265Options(const Track& track, const EncodeOptions& options)
{
  const std::string length = std::to_string(options.GroupLength);
  EncoderOptions all;
  all.OfLibrary = { { "log-level", "none" }, { "info", "0" }, { "repeat-headers", "0" },
    { "pools", "none" }, { "frame-threads", "1" }, { "wpp", "0" }, { "pmode", "0" }, { "pme", "0" },
    { "scenecut", "0" }, { "open-gop", "0" }, { "keyint", length }, { "min-keyint", length },
    { "rc-lookahead", std::to_string(Lookahead) }, { "bframes", "8" }, { "ref", "5" },
    { "weightp", "0" }, { "weightb", "0" }, { "early-skip", "1" }, { "psy-rd", "0" },
    { "psy-rdoq", "0" }, { "aq-mode", "0" } };
  if (track.Role.Samples == Plane::Colors && !track.Lossless)
  {
    Append(GetColorOptions(track.Format, options.Preset), all.OfLibrary);
  }
  if (track.Role.Samples != Plane::Colors)
  {
    all.OfLibrary.push_back({ "rskip", "0" });
  }
  if (track.Lossless)
  {
    all.OfLibrary.push_back({ "lossless", "1" });
  }
  else
  {
    all.OfFFmpeg.push_back({ "crf", ToText(options.CRF) });
  }
  all.OfFFmpeg.push_back({ "preset", options.Preset });
  return all;
}

/// x264: likewise, and without macroblock trees, which read uninitialised memory if there is no
/// adaptive quantisation. Its quantisers are those of x265. Stitchable: parameter sets do not
/// depend on the rate factor.
EncoderOptions MakeX264Options(const Track&, const EncodeOptions& options)
{
  const std::string length = std::to_string(options.GroupLength);
  EncoderOptions all;
  all.OfFFmpeg = { { "crf", ToText(options.CRF) }, { "preset", options.Preset } };
  all.OfLibrary = { { "stitchable", "1" }, { "scenecut", "0" }, { "open-gop", "0" },
    { "keyint", length }, { "min-keyint", length }, { "rc-lookahead", std::to_string(Lookahead) },
    { "bframes", "8" }, { "ref", "5" }, { "weightp", "0" }, { "weightb", "0" }, { "psy", "0" },
    { "aq-mode", "0" }, { "mbtree", "0" } };
  return all;
}

/// AV1's rate factor, from 0 to 63, with about the same quality as x265's. It is between those that
/// fit a diffuse and a glossy scene, which differ by up to 7.
double ToAV1Factor(double crf)
{
  constexpr std::array<std::array<double, 2>, 9> factors = { { { 0, 1 }, { 10, 11 }, { 16, 22 },
    { 22, 34 }, { 28, 45 }, { 34, 55 }, { 40, 60 }, { 46, 62 }, { 51, 63 } } };
  std::size_t k = 1;
  while (k + 1 < factors.size() && crf > factors[k][0])
  {
    ++k;
  }
  const auto& low = factors[k - 1];
  const auto& high = factors[k];
  return std::round(low[1] + (crf - low[0]) / (high[0] - low[0]) * (high[1] - low[1]));
}

/// It prints messages unless the environment forbids it.
void SilenceSVT()
{
  static const bool isSilent =
    vtksys::SystemTools::HasEnv("SVT_LOG") || vtksys::SystemTools::PutEnv("SVT_LOG=0");
  (void)isSilent;
}

/// SVT-AV1: all threads, because its bytes do not depend on their number; quality measured as PSNR;
/// no filtering of reference frames, which are viewed like all others. No preset above 10: with 12,
/// version 4.2 writes streams that decoders refuse.
EncoderOptions MakeSVTOptions(const Track&, const EncodeOptions& options)
{
  SilenceSVT();
  constexpr std::array<int, 10> presets = { 10, 10, 10, 9, 8, 6, 5, 4, 3, 2 };
  const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
  EncoderOptions all;
  all.OfFFmpeg = { { "preset", std::to_string(presets[IndexOfPreset(options.Preset)]) },
    { "crf", ToText(ToAV1Factor(options.CRF)) } };
  all.OfLibrary = { { "lp", std::to_string(threads) }, { "tune", "1" }, { "enable-tf", "0" },
    { "scd", "0" } };
  all.KeyFrameDistance = 2 * MaximumGroupLength;
  return all;
}

/// libaom: quality measured as PSNR.
EncoderOptions MakeAOMOptions(const Track&, const EncodeOptions& options)
{
  constexpr std::array<int, 10> speeds = { 8, 7, 6, 6, 5, 4, 3, 2, 1, 0 };
  EncoderOptions all;
  all.OfFFmpeg = { { "cpu-used", std::to_string(speeds[IndexOfPreset(options.Preset)]) },
    { "crf", ToText(ToAV1Factor(options.CRF)) }, { "row-mt", "0" },
    { "lag-in-frames", std::to_string(Lookahead) }, { "arnr-max-frames", "0" },
    { "tune", "psnr" } };
  all.KeyFrameDistance = 2 * MaximumGroupLength;
  return all;
}

const std::vector<VideoEncoder>& GetEncoders()
{
  static const std::vector<VideoEncoder> encoders = {
    { Codec::HEVC, "libx265", "x265-params", MinimumResolution, true, true,
      { AV_PIX_FMT_YUV444P, AV_PIX_FMT_YUV444P10, AV_PIX_FMT_YUV422P, AV_PIX_FMT_YUV420P,
        AV_PIX_FMT_YUV420P10, AV_PIX_FMT_GBRP },
      AV_PIX_FMT_GRAY8, AV_PIX_FMT_GRAY12, AV_PIX_FMT_YUV444P12, MakeX265Options },
    // It has no gray format. The added chroma is ignored and costs almost nothing.
    { Codec::AV1, "libsvtav1", "svtav1-params", MinimumResolutionOfSVT, false, false,
      { AV_PIX_FMT_YUV420P10, AV_PIX_FMT_YUV420P }, AV_PIX_FMT_YUV420P, AV_PIX_FMT_YUV420P10,
      AV_PIX_FMT_NONE, MakeSVTOptions },
    { Codec::AV1, "libaom-av1", "aom-params", MinimumResolution, false, true,
      { AV_PIX_FMT_YUV420P10, AV_PIX_FMT_YUV420P, AV_PIX_FMT_YUV444P, AV_PIX_FMT_YUV444P10,
        AV_PIX_FMT_YUV422P },
      AV_PIX_FMT_GRAY8, AV_PIX_FMT_GRAY12, AV_PIX_FMT_YUV444P12, MakeAOMOptions },
    { Codec::H264, "libx264", "x264-params", MinimumResolution, false, true,
      { AV_PIX_FMT_YUV444P, AV_PIX_FMT_YUV444P10, AV_PIX_FMT_YUV422P, AV_PIX_FMT_YUV420P,
        AV_PIX_FMT_YUV420P10 },
      AV_PIX_FMT_GRAY8, AV_PIX_FMT_GRAY10, AV_PIX_FMT_YUV444P10, MakeX264Options },
  };
  return encoders;
}

template <typename Condition>
const VideoEncoder* FindFirst(Condition condition)
{
  for (const VideoEncoder& encoder : GetEncoders())
  {
    if (condition(encoder) && avcodec_find_encoder_by_name(encoder.Name))
    {
      return &encoder;
    }
  }
  return nullptr;
}
}

bool VideoEncoder::CanCode(AVPixelFormat format) const
{
  return format == this->Bytes || format == this->Numbers || format == this->FloatColors ||
    std::find(this->ByteColors.begin(), this->ByteColors.end(), format) != this->ByteColors.end();
}

AVPixelFormat VideoEncoder::GetFormat(SampleKind kind, Plane plane) const
{
  switch (plane)
  {
    case Plane::Colors:
      return kind == SampleKind::FloatColor ? this->FloatColors : this->ByteColors.front();
    case Plane::Numbers:
      return this->Numbers;
    case Plane::Coverage:
    case Plane::HighByte:
    case Plane::LowByte:
      break;
  }
  return this->Bytes;
}

const VideoEncoder* FindEncoder(Codec codec, AVPixelFormat format, int resolution)
{
  return FindFirst(
    [=](const VideoEncoder& encoder)
    {
      return encoder.Coding == codec && resolution >= encoder.MinimumResolution &&
        encoder.CanCode(format);
    });
}

const VideoEncoder* FindEncoder(Codec codec, bool isRadiance, int resolution)
{
  return FindFirst(
    [=](const VideoEncoder& encoder)
    {
      return encoder.Coding == codec && resolution >= encoder.MinimumResolution &&
        (!isRadiance || encoder.FloatColors != AV_PIX_FMT_NONE);
    });
}

bool HasEncoder(Codec codec)
{
  return FindFirst([=](const VideoEncoder& encoder) { return encoder.Coding == codec; }) != nullptr;
}

std::string ListCodecsToEncode()
{
  std::string list;
  for (const Codec codec : GetCodecs())
  {
    if (HasEncoder(codec))
    {
      list += (list.empty() ? "" : ", ") + std::string(NameOfCodec(codec));
    }
  }
  return list.empty() ? "none" : list;
}

const std::vector<std::string>& GetPresets()
{
  static const std::vector<std::string> presets = { "ultrafast", "superfast", "veryfast", "faster",
    "fast", "medium", "slow", "slower", "veryslow", "placebo" };
  return presets;
}
}
