// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfFieldWriter.h"

#include "Coding/cslfContainerWriter.h"

#include <vtkSMPTools.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <thread>

namespace cslf
{
namespace
{
namespace fs = std::filesystem;

/// The smallest pictures that are coded.
constexpr int MinimumResolution = 16;

/// The pixel format that stands for the codec's default.
constexpr const char* AutomaticFormat = "auto";

/// The encoder and the format of colour that settings ask for. The encoder is null where this
/// FFmpeg has none.
struct EncoderChoice
{
  const VideoEncoder* Encoder = nullptr;
  AVPixelFormat Color = AV_PIX_FMT_NONE;
};

EncoderChoice ChooseEncoder(const EncodeSettings& settings, bool isRadiance, int resolution)
{
  EncoderChoice choice;
  const Codec codec = *CodecOfName(settings.Codec);
  if (settings.Lossless || settings.PixelFormat != AutomaticFormat)
  {
    choice.Color = settings.Lossless ? AV_PIX_FMT_GBRP
                                     : *FindPixelFormat(TrackRole::Color, settings.PixelFormat);
    choice.Encoder = FindEncoder(codec, choice.Color, resolution);
  }
  else if ((choice.Encoder = FindEncoder(codec, isRadiance, resolution)))
  {
    choice.Color = isRadiance ? choice.Encoder->Radiance : choice.Encoder->Colors.front();
  }
  return choice;
}

bool HasRadiance(const Description& field)
{
  return field.FindChannel(ColorName)->Type == VTK_FLOAT;
}

std::string ListCodecs()
{
  std::string list;
  for (const Codec codec : GetCodecs())
  {
    list += (list.empty() ? "" : ", ") + std::string(NameOfCodec(codec));
  }
  return list;
}

std::string Join(const std::vector<std::string>& names)
{
  std::string list;
  for (const std::string& name : names)
  {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}
}

std::string FindFault(const std::string& fileName)
{
  const fs::path path(fileName);
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

std::string FindFault(const EncodeSettings& settings, int resolution)
{
  const auto& presets = GetPresets();
  if (std::find(presets.begin(), presets.end(), settings.Preset) == presets.end())
  {
    return "The preset \"" + settings.Preset + "\" is none of " + Join(presets) + ".";
  }
  const auto codec = CodecOfName(settings.Codec);
  if (!codec)
  {
    return "The codec \"" + settings.Codec + "\" is none of " + ListCodecs() + ".";
  }
  if (settings.PixelFormat != AutomaticFormat &&
    !FindPixelFormat(TrackRole::Color, settings.PixelFormat))
  {
    return "The pixel format \"" + settings.PixelFormat + "\" is none of auto, " +
      ListColorFormats() + ".";
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

std::string FindFault(const Description& field)
{
  const Channel* color = field.FindChannel(ColorName);
  if (!color || (color->Type != VTK_UNSIGNED_CHAR && color->Type != VTK_FLOAT) ||
    color->Components != 4)
  {
    return "The coded file needs \"Color\" as 4 unsigned chars or 4 floats.";
  }
  const Channel* depth = field.FindChannel(DepthName);
  if (depth && (depth->Type != VTK_UNSIGNED_SHORT || depth->Components != 1))
  {
    return "The coded file needs \"Depth\" as unsigned short.";
  }
  return {};
}

std::string FindFault(const EncodeSettings& settings, const Description& field)
{
  if (!HasRadiance(field))
  {
    return {};
  }
  if (settings.Lossless)
  {
    return "Float colour cannot be coded without loss: keep it as .vti or a folder.";
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

FieldWriter::FieldWriter(
  const std::string& fileName, const EncodeSettings& settings, const Layout& grid)
  : Parts(fileName)
  , Settings(settings)
{
  FrameOrder order = MakeFrameOrder(grid);
  this->Header.Groups = MakeGroups(order, settings.GroupLength);
  this->Header.Coarsest = order.Coarsest;
  this->Header.Slices = std::move(order.Slices);
}

std::vector<int> FieldWriter::GetSlices(const std::vector<int>& groups) const
{
  const std::vector<int> starts = this->Header.GetGroupStarts();
  std::vector<int> slices;
  for (int group : groups)
  {
    const auto begin = this->Header.Slices.begin();
    slices.insert(slices.end(), begin + starts[group], begin + starts[group + 1]);
  }
  return slices;
}

void FieldWriter::MakeEncodings(const Description& field)
{
  const EncodeSettings& settings = this->Settings;
  const bool isRadiance = HasRadiance(field);
  const EncoderChoice choice = ChooseEncoder(settings, isRadiance, field.Grid.GetResolution());
  const bool hasDepth = field.FindChannel(DepthName) != nullptr;
  const auto add = [&](TrackRole role, AVPixelFormat format, double crf)
  {
    Encoding encoding;
    encoding.Kind = { role, format, settings.Lossless, choice.Encoder->Coding,
      isRadiance && role == TrackRole::Color };
    encoding.Options = { settings.Preset, crf, settings.GroupLength };
    this->Encodings.push_back(encoding);
    this->Header.Tracks.push_back(
      { encoding.Kind, 0, std::vector<std::uint32_t>(this->Header.Groups.size(), 0) });
  };
  this->Encodings.clear();
  this->Header.Tracks.clear();
  add(TrackRole::Color, choice.Color, settings.CRF);
  add(TrackRole::Coverage, choice.Encoder->Coverage, settings.CoverageCRF);
  if (hasDepth && settings.Lossless)
  {
    add(TrackRole::DepthHigh, AV_PIX_FMT_GRAY8, 0.0);
    add(TrackRole::DepthLow, AV_PIX_FMT_GRAY8, 0.0);
  }
  else if (hasDepth)
  {
    add(TrackRole::Depth, choice.Encoder->Depth, settings.DepthCRF);
  }
}

void FieldWriter::Begin(const Description& field, std::uint32_t sample)
{
  this->Header.Field = field;
  this->Header.Field.Channels.clear();
  for (const char* name : { ColorName, DepthName })
  {
    if (const Channel* channel = field.FindChannel(name))
    {
      this->Header.Field.Channels.push_back(*channel);
    }
  }
  this->MakeEncodings(field);
  this->Manifest = this->MakeManifest(sample);
}

std::string FieldWriter::MakeManifest(std::uint32_t sample) const
{
  const EncodeSettings& settings = this->Settings;
  const nlohmann::json manifest = { { "version", 1 }, { "cslf", CSLF_VERSION },
    { "codec", avcodec_version() }, { "description", this->Header.Field.ToJSON() },
    { "sample", sample }, { "coding", settings.Codec }, { "preset", settings.Preset },
    { "pixel_format", settings.PixelFormat }, { "crf", settings.CRF },
    { "coverage_crf", settings.CoverageCRF }, { "depth_crf", settings.DepthCRF },
    { "group_length", settings.GroupLength }, { "lossless", settings.Lossless } };
  return manifest.dump();
}

bool FieldWriter::OpenParts(bool restart, std::string& warning, std::string& error)
{
  bool discarded = false;
  if (!this->Parts.Open(this->Manifest, restart, discarded, error))
  {
    return false;
  }
  int damaged = 0;
  this->Missing.clear();
  for (int group = 0; group < this->GetGroupCount(); ++group)
  {
    if (!this->FindGroup(group))
    {
      const TrackRole last = this->Encodings.back().Kind.Role;
      damaged += this->Parts.Has(last, group) ? 1 : 0;
      this->Missing.push_back(group);
    }
  }
  if (discarded)
  {
    warning = "What an earlier run left of the file was made of another field or with other "
              "settings: it is discarded.";
  }
  else if (damaged > 0)
  {
    warning =
      std::to_string(damaged) + " group(s) that an earlier run left are damaged: they are redone.";
  }
  return true;
}

bool FieldWriter::FindGroup(int group)
{
  GroupParts parts(this->Encodings.size());
  for (std::size_t track = 0; track < parts.size(); ++track)
  {
    std::string ignored;
    if (!this->Parts.Read(this->Encodings[track].Kind.Role, group, parts[track], ignored) ||
      parts[track].Frames.size() != static_cast<std::size_t>(this->Header.Groups[group]))
    {
      return false;
    }
  }
  for (std::size_t track = 0; track < parts.size(); ++track)
  {
    std::string ignored;
    if (!this->Note(track, group, parts[track], ignored))
    {
      return false;
    }
  }
  return true;
}

bool FieldWriter::EncodeGroups(const std::vector<int>& groups,
  const std::vector<ConstSlice>& slices, const std::function<void()>& idle,
  std::vector<GroupParts>& parts, std::string& error) const
{
  const std::size_t tracks = this->Encodings.size();
  const std::size_t jobs = groups.size() * tracks;
  std::vector<std::size_t> starts;
  std::size_t start = 0;
  for (int group : groups)
  {
    starts.push_back(start);
    start += this->Header.Groups[group];
  }
  parts.assign(groups.size(), GroupParts(tracks));
  std::vector<std::string> errors(jobs);
  const std::thread::id caller = std::this_thread::get_id();
  vtkSMPTools::For(0, static_cast<vtkIdType>(jobs), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType job = begin; job < end; ++job)
      {
        const std::size_t place = job / tracks;
        const Encoding& encoding = this->Encodings[job % tracks];
        const auto from = slices.begin() + static_cast<std::ptrdiff_t>(starts[place]);
        const std::vector<ConstSlice> frames(from, from + this->Header.Groups[groups[place]]);
        EncodeGroup(encoding.Kind, this->Header.Field.Grid.GetResolution(), encoding.Options,
          frames, parts[place][job % tracks], errors[job]);
        if (std::this_thread::get_id() == caller)
        {
          idle();
        }
      }
    });
  const auto failed = std::find_if(
    errors.begin(), errors.end(), [](const std::string& text) { return !text.empty(); });
  error = failed == errors.end() ? std::string() : *failed;
  return error.empty();
}

bool FieldWriter::StoreGroup(int group, const GroupParts& parts, std::string& error)
{
  for (std::size_t track = 0; track < parts.size(); ++track)
  {
    if (!this->Note(track, group, parts[track], error) ||
      !this->Parts.Write(this->Encodings[track].Kind.Role, group, parts[track], error))
    {
      return false;
    }
  }
  this->Missing.erase(std::find(this->Missing.begin(), this->Missing.end(), group));
  return true;
}

bool FieldWriter::Note(std::size_t track, int group, const CodedGroup& part, std::string& error)
{
  Encoding& encoding = this->Encodings[track];
  CodedTrack& coded = this->Header.Tracks[track];
  if (encoding.ParameterSets.empty())
  {
    encoding.ParameterSets = part.ParameterSets;
    Framing framing;
    GetBitstream(encoding.Kind.Coding)
      .ReadConfiguration(part.ParameterSets.data(), part.ParameterSets.size(), framing);
    coded.ParameterSetsCRC = framing.ParameterSetsCRC;
  }
  if (part.ParameterSets != encoding.ParameterSets)
  {
    error = "the encoder gave groups that do not fit together";
    return false;
  }
  coded.GroupCRCs[group] = part.CRC;
  encoding.CoveredFully = encoding.CoveredFully && part.CoveredFully;
  for (std::size_t k = 0; k < part.Frames.size(); ++k)
  {
    this->Header.Delay = std::max(this->Header.Delay, static_cast<int>(k) - part.Frames[k].Index);
  }
  return true;
}

void FieldWriter::DropFullCoverage()
{
  for (std::size_t track = 0; track < this->Encodings.size(); ++track)
  {
    const Encoding& encoding = this->Encodings[track];
    if (encoding.Kind.Role == TrackRole::Coverage && encoding.CoveredFully)
    {
      this->Encodings.erase(this->Encodings.begin() + static_cast<std::ptrdiff_t>(track));
      this->Header.Tracks.erase(this->Header.Tracks.begin() + static_cast<std::ptrdiff_t>(track));
      return;
    }
  }
}

bool FieldWriter::Finish(const std::function<bool(double)>& progress, std::string& error)
{
  this->DropFullCoverage();
  ContainerWriter container;
  const int resolution = this->Header.Field.Grid.GetResolution();
  bool good = container.Open(this->Parts.GetWholeName(), this->Header.ToText(), error);
  for (const Encoding& encoding : this->Encodings)
  {
    good = good && container.AddTrack(encoding.Kind, resolution, encoding.ParameterSets, error);
  }
  good = good && container.Begin(error);
  const std::vector<int> starts = this->Header.GetGroupStarts();
  for (std::size_t group = 0; good && group < this->Header.Groups.size(); ++group)
  {
    for (std::size_t track = 0; good && track < this->Encodings.size(); ++track)
    {
      CodedGroup part;
      const int number = static_cast<int>(group);
      good = this->Parts.Read(this->Encodings[track].Kind.Role, number, part, error) &&
        container.Write(track, starts[group], this->Header.Delay, part, error);
    }
    if (good && !progress(static_cast<double>(group + 1) / this->Header.Groups.size()))
    {
      error = "it was stopped";
      good = false;
    }
  }
  return good && container.End(error) && this->Parts.Publish(error);
}
}
