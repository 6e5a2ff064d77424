// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFileAssembler.h"

#include "Coding/Containers/cslfContainerWriter.h"
#include "Files/cslfAtomicFile.h"
#include "Pipeline/cslfPhase.h"
#include "cslfGroupStore.h"
#include "cslfJSON.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace cslf
{
namespace
{
/// What a container stores beside the header and the frames, as measured: once per file, once per
/// track, for each of a track's groups (more if there are other tracks between them) and frames,
/// and where the difference between a frame's places in coding and in presentation changes.
struct ContainerBytes
{
  double File;
  double Track;
  double Group;
  double GroupBetweenOthers;
  double Frame;
  double Reordering;
};
constexpr ContainerBytes BytesOfMP4 = { 294.0, 690.0, 4.0, 16.0, 4.0, 8.0 };
constexpr ContainerBytes BytesOfMatroska = { 355.0, 275.0, 19.0, 19.0, 7.0, 0.0 };

/// The most that a certificate adds to the header, of which the file has two.
constexpr double CertificateBytes = 2.0 * 400.0;

/// The progress of finishing a file when its groups are joined, before it is measured.
constexpr double JoinedShare = 0.1;

const ContainerBytes& FindContainerBytes(const std::string& fileName)
{
  return std::string(FindContainer(fileName)) == "mp4" ? BytesOfMP4 : BytesOfMatroska;
}
}

FileAssembler::FileAssembler(const std::string& fileName, const EncodeSettings& settings)
  : FileName(fileName)
  , Store(fileName)
  , Settings(settings)
{
}

std::vector<FrameId> FileAssembler::GetFrames(const std::vector<int>& groups) const
{
  const std::vector<int> starts = this->Header.GetGroupStarts();
  std::vector<FrameId> frames;
  for (int group : groups)
  {
    const auto begin = this->Header.Frames.begin();
    frames.insert(frames.end(), begin + starts[group], begin + starts[group + 1]);
  }
  return frames;
}

void FileAssembler::Begin(
  const Description& field, std::uint32_t checksum, const GeometryPlan& plan)
{
  const FrameOrder order = MakeFrameOrder(field.Grid, this->Settings.GroupLength);
  this->Header.Groups.clear();
  this->Header.Frames.clear();
  for (int time = 0; time < field.CountTimes(); ++time)
  {
    this->Header.Groups.insert(this->Header.Groups.end(), order.Groups.begin(), order.Groups.end());
    for (const int slice : order.Slices)
    {
      this->Header.Frames.emplace_back(slice, time);
    }
  }
  this->Header.Coarsest = order.Coarsest;
  this->Costs.assign(this->Header.Groups.size(), GroupCost());
  this->Header.Field = field;
  this->Header.Field.Measured.reset(); // of another file
  this->Header.Field.Channels.clear();
  for (const ChannelId id : ChannelIds)
  {
    if (const Channel* channel = field.FindChannel(id))
    {
      this->Header.Field.Channels.push_back(*channel);
    }
  }
  const ComputedChannels& computed = plan.GetComputed();
  this->Header.Computed = computed;
  std::vector<TrackRole> roles;
  if (computed.HasDepth)
  {
    roles.push_back(DepthRole);
  }
  if (computed.HasCoverage)
  {
    roles.push_back(CoverageRole);
  }
  this->Coder.emplace(this->Settings, field, this->Header.Groups, roles);
  this->Header.Tracks.clear();
  for (const Track& track : this->Coder->GetTracks())
  {
    this->Header.Tracks.push_back(
      { track, 0, std::vector<std::uint32_t>(this->Header.Groups.size(), 0) });
  }
  this->States.assign(this->Header.Tracks.size(), TrackState());
  this->Manifest = this->MakeManifest(checksum, plan);
}

std::string FileAssembler::MakeManifest(std::uint32_t checksum, const GeometryPlan& plan) const
{
  const EncodeSettings& settings = this->Settings;
  nlohmann::json manifest = DescribeSettings(settings);
  manifest.update({ { "version", 6 }, { "description", this->Header.Field.ToJSON() },
    { "measured",
      { { "sample", checksum }, { "geometry", plan.GetChecksum() },
        { "computes_coverage", plan.GetComputed().HasCoverage },
        { "computes_color", plan.GetComputed().HasColor },
        { "computes_all", plan.GetComputed().IsAll } } } });
  if (settings.Target.Kind == RateTarget::Kinds::Bytes ||
    settings.Target.Kind == RateTarget::Kinds::Ratio)
  {
    manifest["certificate"] = static_cast<bool>(this->Certify); // it takes bytes
  }
  return manifest.dump();
}

RateField FileAssembler::GetRateField() const
{
  const Layout& grid = this->Header.Field.Grid;
  const double texels = 1.0 * grid.GetStripWidth() * grid.GetResolution();
  const auto begin = this->Header.Groups.begin();
  return { { begin, begin + this->GetGroupCount() }, texels,
    texels * this->Header.Field.CountFrames(),
    [this](bool hasCoverage) { return this->GetContainerBytes(hasCoverage); } };
}

double FileAssembler::GetContainerBytes(bool hasCoverage) const
{
  FileHeader header = this->Header;
  header.Missing.clear();
  if (!hasCoverage)
  {
    header.Tracks.erase(std::remove_if(header.Tracks.begin(), header.Tracks.end(),
                          [](const CodedTrack& track) { return track.Kind.Role == CoverageRole; }),
      header.Tracks.end());
  }
  const ContainerBytes& bytes = FindContainerBytes(this->FileName);
  double sum = bytes.File + bytes.Track * static_cast<double>(header.Tracks.size());
  for (const auto& [name, text] : header.ToTags())
  {
    sum += static_cast<double>(text.size());
  }
  sum += this->Certify ? CertificateBytes : 0.0;
  return sum + static_cast<double>(this->Carry({}).size());
}

bool FileAssembler::OpenFolder(bool restart, std::string& warning, std::string& error)
{
  for (const auto& [name, text] : this->Header.ToTags())
  {
    if (text.size() > MaximumTagBytes)
    {
      error = "the description of this number of groups exceeds the 16 MiB that readers accept";
      return false;
    }
  }
  bool discarded = false;
  if (!this->Store.Open(this->Manifest, restart, discarded, error))
  {
    return false;
  }
  this->HasFolder = true;
  int damaged = 0;
  this->Header.Missing.clear();
  for (int group = 0; group < this->GetGroupCount(); ++group)
  {
    const Found found = this->FindGroup(group);
    damaged += found == Found::Damaged ? 1 : 0;
    if (found != Found::Whole)
    {
      this->Header.Missing.push_back(group);
    }
  }
  if (discarded)
  {
    warning = "The interrupted run used another field, other settings, another kind of processor "
              "or other versions of the libraries: what it wrote is discarded.";
  }
  else if (damaged > 0)
  {
    warning = std::to_string(damaged) +
      " group(s) of the interrupted run are damaged and are sampled again.";
  }
  return true;
}

bool FileAssembler::IsMissing(int group) const
{
  return std::binary_search(this->Header.Missing.begin(), this->Header.Missing.end(), group);
}

FileAssembler::Found FileAssembler::FindGroup(int group)
{
  GroupTracks tracks(this->Header.Tracks.size());
  Found found = Found::Whole;
  for (std::size_t track = 0; track < tracks.size(); ++track)
  {
    const TrackRole role = this->Header.Tracks[track].Kind.Role;
    std::string ignored;
    if (!this->Store.Has(role, group))
    {
      found = Found::Missing;
    }
    else if (!this->Store.Read(role, group, tracks[track], ignored) ||
      tracks[track].Frames.size() != static_cast<std::size_t>(this->Header.Groups[group]))
    {
      return Found::Damaged;
    }
  }
  if (found == Found::Missing)
  {
    return found;
  }
  for (std::size_t track = 0; track < tracks.size(); ++track)
  {
    std::string ignored;
    if (!this->RecordGroup(track, group, tracks[track], ignored))
    {
      return Found::Damaged;
    }
  }
  this->Costs[group] = this->GetCost(tracks);
  return Found::Whole;
}

GroupCost FileAssembler::GetCost(const GroupTracks& tracks) const
{
  const ContainerBytes& container = FindContainerBytes(this->FileName);
  GroupCost cost;
  for (std::size_t track = 0; track < tracks.size(); ++track)
  {
    const bool isCoverage = this->Header.Tracks[track].Kind.Role == CoverageRole;
    double& bytes = isCoverage ? cost.CoverageBytes : cost.Bytes;
    bytes += tracks.size() > 1 ? container.GroupBetweenOthers : container.Group;
    const std::vector<CodedFrame>& frames = tracks[track].Frames;
    int place = 0;
    // The group before it ends about as this one does.
    int last = frames.empty() ? 0 : frames.back().Index - static_cast<int>(frames.size() - 1);
    for (const CodedFrame& frame : frames)
    {
      const int offset = frame.Index - place++;
      bytes += container.Frame + static_cast<double>(frame.Data.size()) +
        (offset == last ? 0.0 : container.Reordering);
      last = offset;
    }
    cost.CoveredFully = isCoverage ? tracks[track].CoveredFully : cost.CoveredFully;
  }
  cost.SquaredError = tracks.front().SquaredError;
  return cost;
}

bool FileAssembler::StoreGroup(int group, const GroupTracks& tracks, std::string& error)
{
  for (std::size_t track = 0; track < tracks.size(); ++track)
  {
    const TrackRole role = this->Header.Tracks[track].Kind.Role;
    if (!this->RecordGroup(track, group, tracks[track], error))
    {
      return false;
    }
    if (!this->Store.Write(role, group, tracks[track], error))
    {
      // The preview may take the space that the group needs.
      this->Store.DropPreview();
      if (!this->Store.Write(role, group, tracks[track], error))
      {
        return false;
      }
    }
  }
  this->Costs[group] = this->GetCost(tracks);
  this->Header.Missing.erase(
    std::find(this->Header.Missing.begin(), this->Header.Missing.end(), group));
  return true;
}

bool FileAssembler::RecordGroup(
  std::size_t track, int group, const CodedGroup& coded, std::string& error)
{
  TrackState& state = this->States[track];
  CodedTrack& listed = this->Header.Tracks[track];
  if (state.ParameterSets.empty())
  {
    state.ParameterSets = coded.ParameterSets;
    Framing framing;
    GetBitstream(listed.Kind.Coding)
      .ReadConfiguration(coded.ParameterSets.data(), coded.ParameterSets.size(), framing);
    listed.ParameterSetsCRC = framing.ParameterSetsCRC;
  }
  if (coded.ParameterSets != state.ParameterSets)
  {
    error = "the encoder produced groups that do not fit together";
    return false;
  }
  listed.GroupCRCs[group] = coded.CRC;
  state.CoveredFully = state.CoveredFully && coded.CoveredFully;
  for (std::size_t k = 0; k < coded.Frames.size(); ++k)
  {
    this->Delay = std::max(this->Delay, static_cast<int>(k) - coded.Frames[k].Index);
  }
  return true;
}

void FileAssembler::DropFullCoverage()
{
  for (std::size_t track = this->States.size(); track-- > 0;)
  {
    const TrackRole role = this->Header.Tracks[track].Kind.Role;
    if (role.Samples == Plane::Coverage && this->States[track].CoveredFully)
    {
      this->States.erase(this->States.begin() + static_cast<std::ptrdiff_t>(track));
      this->Header.Tracks.erase(this->Header.Tracks.begin() + static_cast<std::ptrdiff_t>(track));
    }
  }
}

double FileAssembler::GetStoredBytes() const
{
  double bytes = this->GetContainerBytes(true);
  for (int group = 0; group < this->GetGroupCount(); ++group)
  {
    const GroupCost& cost = this->Costs[group];
    bytes += this->IsMissing(group) ? 0.0 : cost.Bytes + cost.CoverageBytes;
  }
  return bytes;
}

double FileAssembler::GetWantedBytes() const
{
  const RateTarget& target = this->Settings.Target;
  const Layout& grid = this->Header.Field.Grid;
  const double texels =
    1.0 * grid.GetStripWidth() * grid.GetResolution() * this->Header.Field.CountFrames();
  switch (target.Kind)
  {
    case RateTarget::Kinds::Bytes:
      return target.Value;
    case RateTarget::Kinds::Ratio:
      return RawTexelBytes * texels / target.Value;
    default:
      return 0.0;
  }
}

/// The bytes of the groups that are not stored yet.
double FileAssembler::GetMissingBytes() const
{
  const double wanted = this->GetWantedBytes();
  const double stored = this->GetStoredBytes();
  if (wanted > 0.0)
  {
    return std::max(0.0, wanted - stored);
  }
  double frames = 0.0;
  double missing = 0.0;
  for (int group = 0; group < this->GetGroupCount(); ++group)
  {
    (this->IsMissing(group) ? missing : frames) += this->CountFrames(group);
  }
  return frames > 0.0 ? stored / frames * missing : 0.0;
}

bool FileAssembler::HasRoom(std::string& error) const
{
  const double stored = this->GetStoredBytes();
  const double rest = this->GetMissingBytes();
  // The remaining data is written twice: as single groups, and in the file that joins them.
  const double needed = stored + 2.0 * rest;
  const double least = this->GetWantedBytes() > 0.0 ? needed : stored + rest;
  if (cslf::HasRoom(this->Store.GetFolder(), needed, least, error))
  {
    return true;
  }
  // The preview is not needed.
  this->Store.DropPreview();
  return cslf::HasRoom(this->Store.GetFolder(), needed, least, error);
}

bool FileAssembler::CanPreview() const
{
  return !this->Header.Missing.empty() &&
    this->Header.GetGroupStarts()[this->Header.Missing.front()] >= this->Header.Coarsest;
}

bool FileAssembler::WritePreview(std::string& error)
{
  // Besides what HasRoom says, for this file.
  const double needed = 2.0 * (this->GetStoredBytes() + this->GetMissingBytes());
  const auto always = [](double) { return true; };
  if (cslf::HasRoom(this->Store.GetFolder(), needed, needed, error) &&
    this->Join(this->Store.GetUnfinishedPreview(), always, error) &&
    this->Store.PublishPreview(error))
  {
    return true;
  }
  this->Store.DropPreview();
  return false;
}

int FileAssembler::CountStored() const
{
  return this->HasFolder ? this->GetGroupCount() - static_cast<int>(this->Header.Missing.size())
                         : 0;
}

std::string FileAssembler::DescribeKept(int stored) const
{
  return "; " + std::to_string(stored) + " of " + std::to_string(this->GetGroupCount()) +
    " groups of viewpoints are kept in " + this->Store.GetFolder() +
    ", and the next run resumes from them";
}

bool FileAssembler::Finish(bool replaces, const std::function<bool(double)>& progress,
  std::string& warning, std::string& error)
{
  this->DropFullCoverage();
  this->Store.DropPreview();
  return this->HasRoom(error) &&
    (this->Certify ? this->AddCertificate(progress, error)
                   : this->Join(this->Store.GetWholeName(), progress, error)) &&
    this->Store.Publish(replaces, warning, error);
}

/// Joins the groups, measures the file, and joins them again with the result.
bool FileAssembler::AddCertificate(const std::function<bool(double)>& progress, std::string& error)
{
  const std::string whole = this->Store.GetWholeName();
  if (!this->Join(whole, Within(progress, 0.0, JoinedShare), error))
  {
    return false;
  }
  this->Header.Field.Measured = this->Certify(whole);
  if (!progress(MeasuredShare))
  {
    error = Stopped;
    return false;
  }
  return !this->Header.Field.Measured ||
    this->Join(whole, Within(progress, MeasuredShare, 1.0), error);
}

/// The first picture's packet, together with the geometry.
std::vector<std::uint8_t> FileAssembler::Carry(const std::vector<std::uint8_t>& packet) const
{
  const FilePart* geometry = this->Header.FindGeometry();
  return geometry
    ? GetBitstream(this->Header.Tracks.front().Kind.Coding).Load(packet, geometry->Bytes)
    : packet;
}

/// Joins the stored groups.
bool FileAssembler::Join(
  const std::string& fileName, const std::function<bool(double)>& progress, std::string& error)
{
  ContainerWriter container;
  const int resolution = this->Header.Field.Grid.GetResolution();
  bool good = container.Open(fileName, this->Header.ToTags(), error);
  for (std::size_t track = 0; track < this->States.size(); ++track)
  {
    good = good &&
      container.AddTrack(
        this->Header.Tracks[track].Kind, resolution, this->States[track].ParameterSets, error);
  }
  good = good && container.Begin(error);
  const std::vector<int> starts = this->Header.GetGroupStarts();
  for (int group = 0; good && group < this->GetGroupCount(); ++group)
  {
    const std::size_t tracks = this->IsMissing(group) ? 0 : this->States.size();
    for (std::size_t track = 0; good && track < tracks; ++track)
    {
      CodedGroup coded;
      good = this->Store.Read(this->Header.Tracks[track].Kind.Role, group, coded, error);
      if (good && group == 0 && track == 0)
      {
        coded.Frames.front().Data = this->Carry(coded.Frames.front().Data);
      }
      good = good && container.Write(track, starts[group], this->Delay, coded, error);
    }
    if (good && !progress((group + 1.0) / this->GetGroupCount()))
    {
      error = Stopped;
      good = false;
    }
  }
  return good && container.End(error);
}
}
