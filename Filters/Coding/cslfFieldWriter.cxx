// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfFieldWriter.h"

#include "Coding/cslfContainerWriter.h"
#include "Coding/cslfGroupError.h"
#include "Coding/cslfTrackFactors.h"

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

/// What a container holds once for the file, beside the header, and for each track: measured.
struct ContainerBytes
{
  double File;
  double Track;
};
constexpr ContainerBytes BytesOfMP4 = { 270.0, 690.0 };
constexpr ContainerBytes BytesOfMatroska = { 325.0, 275.0 };
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
  const std::string fault = FindFault(settings.Target, settings.Lossless);
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
  if (settings.Target.Kind == RateTarget::Kinds::PSNR)
  {
    return "A target of PSNR is for colour of bytes, the field's is float.";
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

FieldWriter::FieldWriter(const std::string& fileName, const EncodeSettings& settings)
  : FileName(fileName)
  , Parts(fileName)
  , Settings(settings)
{
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
  FrameOrder order = MakeFrameOrder(field.Grid, this->Settings.GroupLength);
  this->Header.Groups = std::move(order.Groups);
  this->Header.Coarsest = order.Coarsest;
  this->Header.Slices = std::move(order.Slices);
  this->Costs.assign(this->Header.Groups.size(), GroupCost());
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
    { "group_length", settings.GroupLength }, { "lossless", settings.Lossless },
    { "target", static_cast<int>(settings.Target.Kind) },
    { "target_value", settings.Target.Value } };
  return manifest.dump();
}

RateField FieldWriter::GetRateField() const
{
  const Layout& grid = this->Header.Field.Grid;
  return { this->Header.Groups, 1.0 * grid.GetStripWidth() * grid.GetResolution(),
    [this](bool hasCoverage) { return this->GetContainerBytes(hasCoverage); } };
}

double FieldWriter::GetContainerBytes(bool hasCoverage) const
{
  // Checksums are as long as they get, but for a few.
  FileHeader header = this->Header;
  for (CodedTrack& track : header.Tracks)
  {
    std::fill(track.GroupCRCs.begin(), track.GroupCRCs.end(), ~std::uint32_t(0));
  }
  if (!hasCoverage)
  {
    header.Tracks.erase(header.Tracks.begin() + 1);
  }
  const bool isMP4 = std::string(FindContainer(this->FileName)) == "mp4";
  const ContainerBytes& bytes = isMP4 ? BytesOfMP4 : BytesOfMatroska;
  return bytes.File + static_cast<double>(header.ToText().size()) +
    bytes.Track * static_cast<double>(header.Tracks.size());
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

bool FieldWriter::IsMissing(int group) const
{
  return std::binary_search(this->Missing.begin(), this->Missing.end(), group);
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
  this->Costs[group] = this->GetCost(parts);
  return true;
}

EncodeOptions FieldWriter::GetOptions(const Encoding& encoding, double factor) const
{
  EncodeOptions options = encoding.Options;
  const bool isFixed = this->Settings.Target.Kind == RateTarget::Kinds::Factor;
  options.CRF = encoding.Kind.Role == TrackRole::Color ? factor
    : isFixed                                          ? options.CRF
                                                       : FindTrackFactor(options.CRF, factor);
  return options;
}

bool FieldWriter::EncodeGroups(const std::vector<CodingTask>& tasks,
  const std::vector<ConstSlice>& slices, const std::function<void()>& idle,
  std::vector<GroupParts>& parts, std::string& error) const
{
  struct Job
  {
    std::vector<ConstSlice> Frames;
    const Encoding* Kind;
    double Factor;
    CodedGroup* Part;
    std::string Error;
  };
  std::size_t count = 0;
  for (const CodingTask& task : tasks)
  {
    count += task.Factors.size();
  }
  parts.assign(count, GroupParts(this->Encodings.size()));
  std::vector<Job> jobs;
  std::size_t place = 0;
  auto from = slices.begin();
  for (const CodingTask& task : tasks)
  {
    const std::vector<ConstSlice> frames(from, from + this->Header.Groups[task.Group]);
    from += this->Header.Groups[task.Group];
    for (double factor : task.Factors)
    {
      for (std::size_t track = 0; track < this->Encodings.size(); ++track)
      {
        jobs.push_back({ frames, &this->Encodings[track], factor, &parts[place][track], {} });
      }
      ++place;
    }
  }
  const std::thread::id caller = std::this_thread::get_id();
  vtkSMPTools::For(0, static_cast<vtkIdType>(jobs.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        Job& job = jobs[k];
        EncodeGroup(job.Kind->Kind, this->Header.Field.Grid.GetResolution(),
          this->GetOptions(*job.Kind, job.Factor), job.Frames, *job.Part, job.Error);
        if (std::this_thread::get_id() == caller)
        {
          idle();
        }
      }
    });
  const auto failed =
    std::find_if(jobs.begin(), jobs.end(), [](const Job& job) { return !job.Error.empty(); });
  error = failed == jobs.end() ? std::string() : failed->Error;
  return error.empty() && this->MeasureErrors(tasks, slices, parts, error);
}

bool FieldWriter::IsMeasured(const CodingTask& task) const
{
  return !this->Settings.Lossless && !HasRadiance(this->Header.Field) &&
    (!task.IsTrial || this->Settings.Target.Kind == RateTarget::Kinds::PSNR);
}

bool FieldWriter::MeasureErrors(const std::vector<CodingTask>& tasks,
  const std::vector<ConstSlice>& slices, std::vector<GroupParts>& parts, std::string& error) const
{
  struct Job
  {
    std::vector<ConstSlice> Frames;
    GroupParts* Parts;
    std::string Error;
  };
  std::vector<Job> jobs;
  std::size_t place = 0;
  auto from = slices.begin();
  for (const CodingTask& task : tasks)
  {
    const std::vector<ConstSlice> frames(from, from + this->Header.Groups[task.Group]);
    from += this->Header.Groups[task.Group];
    for (std::size_t k = 0; k < task.Factors.size(); ++k, ++place)
    {
      if (this->IsMeasured(task))
      {
        jobs.push_back({ frames, &parts[place], {} });
      }
    }
  }
  const Track& color = this->Encodings[0].Kind;
  const Track& coverage = this->Encodings[1].Kind;
  vtkSMPTools::For(0, static_cast<vtkIdType>(jobs.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType k = begin; k < end; ++k)
      {
        GroupParts& group = *jobs[k].Parts;
        MeasureSquaredError({ color, &group[0] }, { coverage, &group[1] },
          this->Header.Field.Grid.GetResolution(), jobs[k].Frames, group[0].SquaredError,
          jobs[k].Error);
      }
    });
  const auto failed =
    std::find_if(jobs.begin(), jobs.end(), [](const Job& job) { return !job.Error.empty(); });
  error = failed == jobs.end() ? std::string() : failed->Error;
  return error.empty();
}

GroupCost FieldWriter::GetCost(const GroupParts& parts) const
{
  GroupCost cost;
  for (std::size_t track = 0; track < parts.size(); ++track)
  {
    const bool isCoverage = this->Encodings[track].Kind.Role == TrackRole::Coverage;
    for (const CodedFrame& frame : parts[track].Frames)
    {
      (isCoverage ? cost.CoverageBytes : cost.Bytes) += static_cast<double>(frame.Data.size());
    }
    cost.CoveredFully = isCoverage ? parts[track].CoveredFully : cost.CoveredFully;
  }
  std::vector<Track> tracks;
  for (const Encoding& encoding : this->Encodings)
  {
    tracks.push_back(encoding.Kind);
  }
  const double container =
    MeasureContainer(this->FileName, tracks, this->Header.Field.Grid.GetResolution(), parts);
  const double share = 1.0 / static_cast<double>(tracks.size());
  cost.CoverageBytes += share * container;
  cost.Bytes += (1.0 - share) * container;
  cost.SquaredError = parts.front().SquaredError;
  return cost;
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
  this->Costs[group] = this->GetCost(parts);
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
