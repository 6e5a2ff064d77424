// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfEncodeSettings.h"

#include "Coding/Containers/cslfContainerWriter.h"
#include "Files/cslfFileSystem.h"
#include "cslfJoin.h"

#include <vtkType.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace cslf
{
namespace
{
namespace fs = std::filesystem;

/// The size of the smallest pictures that are coded.
constexpr int MinimumResolution = 16;

/// Means the codec's default pixel format.
constexpr const char* AutomaticFormat = "auto";
}

double EncodeSettings::GetCRF(Plane plane) const
{
  switch (plane)
  {
    case Plane::Colors:
      return this->CRF;
    case Plane::Coverage:
      return this->CoverageCRF;
    case Plane::Numbers:
      return this->DepthCRF;
    case Plane::HighByte:
    case Plane::LowByte:
      break;
  }
  return 0.0;
}

nlohmann::json DescribeSettings(const EncodeSettings& settings)
{
  return { { "cslf", CSLF_VERSION }, { "codec", avcodec_version() },
    { "ffmpeg", av_version_info() }, { "coding", settings.Codec }, { "preset", settings.Preset },
    { "pixel_format", settings.PixelFormat }, { "crf", settings.CRF },
    { "coverage_crf", settings.CoverageCRF }, { "depth_crf", settings.DepthCRF },
    { "group_length", settings.GroupLength }, { "lossless", settings.Lossless },
    { "target", static_cast<int>(settings.Target.Kind) },
    { "target_value", settings.Target.Value } };
}

EncoderChoice ChooseEncoder(const EncodeSettings& settings, bool isRadiance, int resolution)
{
  EncoderChoice choice;
  const Codec codec = *CodecOfName(settings.Codec);
  if (settings.Lossless || settings.PixelFormat != AutomaticFormat)
  {
    choice.Color =
      settings.Lossless ? AV_PIX_FMT_GBRP : *FindPixelFormat(Plane::Colors, settings.PixelFormat);
    choice.Encoder = FindEncoder(codec, choice.Color, resolution);
  }
  else if ((choice.Encoder = FindEncoder(codec, isRadiance, resolution)))
  {
    choice.Color = choice.Encoder->GetFormat(
      isRadiance ? SampleKind::FloatColor : SampleKind::ByteColor, Plane::Colors);
  }
  return choice;
}

bool HasRadiance(const Description& field)
{
  return field.FindChannel(KnownChannel::Color)->Type == VTK_FLOAT;
}

std::string FindError(const std::string& fileName)
{
  const fs::path path = ToPath(fileName);
  if (!FindContainer(fileName))
  {
    return "The extension of " + fileName + " must be .mp4 or .mkv.";
  }
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
  {
    return fileName + " is a folder.";
  }
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(parent, ignored))
  {
    return "The folder of " + fileName + " does not exist.";
  }
  return {};
}

std::string FindError(const EncodeSettings& settings, int resolution)
{
  const auto& presets = GetPresets();
  if (std::find(presets.begin(), presets.end(), settings.Preset) == presets.end())
  {
    return "The preset \"" + settings.Preset + "\" is none of " + Join(presets) + ".";
  }
  const auto codec = CodecOfName(settings.Codec);
  if (!codec)
  {
    return "The codec \"" + settings.Codec + "\" is none of " + JoinAs(GetCodecs(), NameOfCodec) +
      ".";
  }
  if (settings.PixelFormat != AutomaticFormat &&
    !FindPixelFormat(Plane::Colors, settings.PixelFormat))
  {
    return "The pixel format \"" + settings.PixelFormat + "\" is none of auto, " +
      ListColorFormats() + ".";
  }
  std::string fault = FindError(settings.Target, settings.Lossless);
  if (!fault.empty())
  {
    return fault;
  }
  if (resolution < MinimumResolution)
  {
    return "Video needs a resolution of at least " + std::to_string(MinimumResolution) +
      " texels, the field has " + std::to_string(resolution) + ".";
  }
  if (!HasEncoder(*codec))
  {
    return "This FFmpeg cannot encode " + settings.Codec +
      ". It has encoders for: " + ListCodecsToEncode() + ".";
  }
  const EncoderChoice choice = ChooseEncoder(settings, false, resolution);
  if (!choice.Encoder || (settings.Lossless && !choice.Encoder->CanBeLossless))
  {
    return "No encoder that this FFmpeg has for " + settings.Codec + " can code " +
      (settings.Lossless ? "without loss" : settings.PixelFormat) + " at a resolution of " +
      std::to_string(resolution) + ".";
  }
  if (NeedsEvenSize(choice.Color) && resolution % 2 != 0)
  {
    return "The pixel format " + NameOfFormat(choice.Color) +
      " needs an even resolution, the field has " + std::to_string(resolution) + ".";
  }
  return {};
}

std::string FindError(const Description& field)
{
  if (!field.FindChannel(KnownChannel::Color))
  {
    return "The coded file needs \"Color\" as 4 unsigned chars or 4 floats.";
  }
  for (const Channel& channel : field.Channels)
  {
    const ChannelForm* form = FindForm(channel);
    if (form && form->Kind == SampleKind::FloatNumber)
    {
      return "The coded file needs \"" + channel.Name + "\" as unsigned short.";
    }
  }
  return {};
}

std::string FindError(const EncodeSettings& settings, const Description& field)
{
  if (!HasRadiance(field))
  {
    return {};
  }
  if (settings.Target.Kind == RateTarget::Kinds::PSNR)
  {
    return "A target PSNR needs byte colour, but the field has float colour.";
  }
  if (settings.Lossless)
  {
    return "Float colour cannot be coded without loss: write .vti or a folder instead.";
  }
  const EncoderChoice choice = ChooseEncoder(settings, true, field.Grid.GetResolution());
  if (!choice.Encoder)
  {
    return "This FFmpeg has no encoder that codes float colour as " + settings.Codec + ".";
  }
  if (!CanHoldRadiance(choice.Color))
  {
    return "Float colour needs a 4:4:4 pixel format of 10 or 12 bits, such as auto, not " +
      settings.PixelFormat + ".";
  }
  return {};
}
}
