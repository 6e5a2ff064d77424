// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFileHeader.h"

#include "Coding/Frames/cslfColorFrames.h"
#include "Coding/Frames/cslfFrameOrder.h"
#include "cslfFileParts.h"
#include "cslfJSONText.h"
#include "cslfJoin.h"

#include <vtkType.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <stdexcept>

namespace cslf
{
namespace
{
using JSON = nlohmann::json;

constexpr const char* CodingKey = "coding";
constexpr const char* PartsKey = "parts";
/// The key of the groups that an unfinished file does not contain yet.
constexpr const char* MissingKey = "missing_groups";

///@{
/// The feature that readers of files without depth need, the key of the channels that they compute,
/// and the names of these.
constexpr const char* RequiredKey = "required";
constexpr const char* GeometryFeature = "geometry";
constexpr const char* ComputedKey = "from_geometry";
constexpr const char* EverythingName = "all";
///@}

///@{
/// The keys of the sample encoding of tracks of float colour and depth, and of the curves'
/// parameters.
constexpr const char* TransferKey = "transfer";
constexpr const char* PQName = "smpte2084";
constexpr const char* WhiteKey = "reference_white";
constexpr const char* CurveName = "mu-law";
constexpr const char* MuKey = "mu";
///@}
/// The key of coverage tracks.
constexpr const char* ToleranceKey = "tolerance";
/// The key for the location of subsampled chroma. If it is absent, chroma lies in the middle.
constexpr const char* SitingKey = "chroma_location";
constexpr const char* LeftName = "left";

JSON ToJSON(const CodedTrack& track)
{
  const Track& kind = track.Kind;
  JSON json = { { "role", NameOfRole(kind.Role) }, { "codec", NameOfCodec(kind.Coding) },
    { "pixel_format", NameOfFormat(kind.Format) }, { "bits", BitsOfFormat(kind.Format) },
    { "lossless", kind.Lossless }, { "parameter_sets_crc", track.ParameterSetsCRC },
    { "crc", ToText(track.GroupCRCs) } };
  if (kind.IsRadiance)
  {
    json[TransferKey] = PQName;
    json[WhiteKey] = kind.Constants.White;
  }
  if (kind.IsCurved)
  {
    json[TransferKey] = CurveName;
    json[MuKey] = kind.Constants.Mu;
  }
  if (kind.Role.Samples == Plane::Coverage)
  {
    json[ToleranceKey] = kind.GetTolerance();
  }
  if (HasSparseChroma(kind) && kind.Siting == AVCHROMA_LOC_LEFT)
  {
    json[SitingKey] = LeftName;
  }
  return json;
}

std::invalid_argument TrackError(const std::string& role, const char* what)
{
  return std::invalid_argument("its track \"" + MakePrintable(role) + "\" has " + what);
}

/// A number in an object, within limits.
double ToNumber(const JSON& object, const char* key, double lowest, double highest)
{
  const auto number = object.at(key).get<double>();
  if (!(number >= lowest && number <= highest))
  {
    throw std::invalid_argument(std::string("its \"") + key + "\" is not valid");
  }
  return number;
}

void ReadTransfer(const JSON& json, Track& kind)
{
  const std::string transfer = json.value(TransferKey, "");
  if (kind.Role.Samples == Plane::Colors && transfer == PQName && CanHoldRadiance(kind.Format))
  {
    kind.IsRadiance = true;
    kind.Constants.White = ToNumber(json, WhiteKey, 1.0, PeakLuminance);
  }
  else if (kind.Role.Samples == Plane::Numbers && transfer == CurveName)
  {
    kind.IsCurved = true;
    kind.Constants.Mu = ToNumber(json, MuKey, 1e-3, 1e6);
  }
  else if (!transfer.empty())
  {
    throw TrackError(NameOfRole(kind.Role), "an unknown transfer curve");
  }
}

CodedTrack ToTrack(TrackRole role, const JSON& json)
{
  CodedTrack track;
  track.Kind.Role = role;
  const auto codec = CodecOfName(json.at("codec").get<std::string>());
  const auto format = FindPixelFormat(role.Samples, json.at("pixel_format").get<std::string>());
  if (!codec || !format)
  {
    throw TrackError(NameOfRole(role), "an unknown codec or pixel format");
  }
  track.Kind.Coding = *codec;
  track.Kind.Format = *format;
  track.Kind.Lossless = json.at("lossless").get<bool>();
  ReadTransfer(json, track.Kind);
  const std::string siting = json.value(SitingKey, "");
  if (!siting.empty() && siting != LeftName)
  {
    throw TrackError(NameOfRole(role), "an unknown chroma location");
  }
  track.Kind.Siting = siting.empty() ? AVCHROMA_LOC_CENTER : AVCHROMA_LOC_LEFT;
  if (role.Samples == Plane::Coverage)
  {
    ToNumber(json, ToleranceKey, 0.0, track.Kind.Lossless ? 0.0 : 127.0);
    track.Kind.Constants.CoverageTolerance = ToInteger(json.at(ToleranceKey));
  }
  track.ParameterSetsCRC = ToInteger<std::uint32_t>(json.at("parameter_sets_crc"));
  track.GroupCRCs = ToChecksums(json.at("crc").get<std::string>());
  return track;
}

/// Reads the tracks of known roles, and the stream that contains each.
void ReadTracks(const JSON& json, FileHeader& header)
{
  std::set<TrackRole> roles;
  for (const JSON& item : RequireArray(json))
  {
    const std::string name = item.at("role").get<std::string>();
    const auto role = RoleOfName(name);
    const auto codec = CodecOfName(item.at("codec").get<std::string>());
    if (!role)
    {
      header.Warnings.push_back(
        "its track \"" + MakePrintable(name) + "\" has a kind that this version does not support");
    }
    else if (!roles.insert(*role).second)
    {
      throw std::invalid_argument("it has two tracks with the same role");
    }
    if (codec)
    {
      header.Streams.push_back({ *codec, role ? static_cast<int>(header.Tracks.size()) : -1 });
    }
    if (role)
    {
      header.Tracks.push_back(ToTrack(*role, item));
    }
  }
}

/// Whether a channel of numbers has either one track or one for each byte, if the field has it and
/// readers do not compute it; and whether a colour has its track, and only then coverage.
bool FitsTracks(const FileHeader& header, ChannelId id)
{
  const auto has = [&](Plane plane) { return header.FindTrack({ id, plane }) != nullptr; };
  const Channel* channel = header.Field.FindChannel(id);
  if (KindOf(id) != SampleKind::Number16)
  {
    const Track* colors = header.FindTrack({ id, Plane::Colors });
    return channel ? colors && colors->IsRadiance == (channel->Type == VTK_FLOAT)
                   : !colors && !has(Plane::Coverage);
  }
  const bool hasByte = has(Plane::HighByte) || has(Plane::LowByte);
  if (!channel || (id == KnownChannel::Depth && header.Computed.HasDepth))
  {
    return !has(Plane::Numbers) && !hasByte;
  }
  return has(Plane::Numbers) ? !hasByte : has(Plane::HighByte) && has(Plane::LowByte);
}

void CheckTracks(const FileHeader& header)
{
  const bool fits = std::all_of(
    ChannelIds.begin(), ChannelIds.end(), [&](ChannelId id) { return FitsTracks(header, id); });
  const bool hasTwoCoverages = header.Computed.HasCoverage && header.FindTrack(CoverageRole);
  if (header.Tracks.empty() || !(header.Tracks.front().Kind.Role == ColorRole) || !fits ||
    hasTwoCoverages)
  {
    throw std::invalid_argument("its tracks do not match its channels");
  }
  // A texel's chroma comes from its own tile, but odd tiles would share it with their neighbours.
  if (NeedsEvenSize(header.Tracks.front().Kind.Format) &&
    header.Field.Grid.GetResolution() % 2 != 0)
  {
    throw TrackError(NameOfRole(ColorRole), "a pixel format that needs an even resolution");
  }
}

/// Groups as [length, how many of that length] pairs.
JSON GroupsToJSON(const std::vector<int>& groups)
{
  JSON json = JSON::array();
  for (int length : groups)
  {
    if (!json.empty() && json.back()[0] == length)
    {
      json.back()[1] = json.back()[1].get<int>() + 1;
    }
    else
    {
      json.push_back({ length, 1 });
    }
  }
  return json;
}

/// `count` is the number of groups according to the checksums.
std::vector<int> ToGroups(const JSON& json, std::size_t count)
{
  std::vector<int> groups;
  for (const JSON& item : RequireArray(json))
  {
    const int length = ToInteger(item.at(0));
    const int times = ToInteger(item.at(1));
    if (length < 1 || length > MaximumGroupLength || times < 1 ||
      static_cast<std::size_t>(times) > count - groups.size())
    {
      throw std::invalid_argument("its groups are not valid");
    }
    groups.insert(groups.end(), times, length);
  }
  return groups;
}

/// Ascending numbers as [first, count] pairs.
JSON MissingToJSON(const std::vector<int>& numbers)
{
  JSON json = JSON::array();
  for (int number : numbers)
  {
    if (!json.empty() && json.back()[0].get<int>() + json.back()[1].get<int>() == number)
    {
      json.back()[1] = json.back()[1].get<int>() + 1;
    }
    else
    {
      json.push_back({ number, 1 });
    }
  }
  return json;
}

/// The numbers are below `count`.
std::vector<int> ToMissing(const JSON& json, int count)
{
  std::vector<int> numbers;
  for (const JSON& item : RequireArray(json))
  {
    const int first = ToInteger(item.at(0));
    const int length = ToInteger(item.at(1));
    const int least = numbers.empty() ? 0 : numbers.back() + 1;
    if (first < least || first >= count || length < 1 || length > count - first)
    {
      throw std::invalid_argument("its missing groups are not valid");
    }
    numbers.resize(numbers.size() + length);
    std::iota(numbers.end() - length, numbers.end(), first);
  }
  return numbers;
}

/// The frames of a field, each once, or nothing.
std::vector<FrameId> ToFrames(const JSON& json, const Description& field)
{
  std::vector<SliceRun> runs;
  for (const JSON& item : RequireArray(json))
  {
    runs.push_back({ ToInteger(item.at(0)), ToInteger(item.at(1)), ToInteger(item.at(2)) });
  }
  std::vector<FrameId> frames;
  for (const int index : FromRuns(runs, field.CountFrames()))
  {
    frames.push_back(field.GetFrame(index));
  }
  return frames;
}

/// Keeps the channels that coded files can contain in the form that this version knows.
void ReadChannels(FileHeader& header)
{
  std::vector<Channel> known;
  for (const Channel& channel : header.Field.Channels)
  {
    if (FindKnownChannel(channel.Name))
    {
      known.push_back(channel);
    }
    else
    {
      header.Field.Unknown.push_back(channel.Name);
    }
  }
  header.Field.Channels = known;
  for (const std::string& name : header.Field.Unknown)
  {
    header.Warnings.push_back(
      "its channel \"" + MakePrintable(name) + "\" has a kind that this version does not support");
  }
  header.Field.Unknown.clear();
  const bool hasFloatNumbers = std::any_of(known.begin(), known.end(),
    [](const Channel& channel) { return FindForm(channel)->Kind == SampleKind::FloatNumber; });
  if (!header.Field.FindChannel(KnownChannel::Color) || hasFloatNumbers)
  {
    throw std::invalid_argument("it has no colour, or depth of another type than a file can hold");
  }
}

/// Reads which channels are those of the geometry. Only files that require its use have such.
void ReadComputed(const JSON& coding, bool isRequired, FileHeader& header)
{
  const JSON names = coding.value(ComputedKey, JSON::array());
  for (const JSON& name : RequireArray(names))
  {
    const auto role = RoleOfName(name.get<std::string>());
    const bool isDepth = role == std::make_optional(DepthRole);
    const bool isCoverage = role == std::make_optional(CoverageRole);
    const bool isColor = role == std::make_optional(ColorRole);
    const bool isAll = name == EverythingName;
    if (!isDepth && !isCoverage && !isColor && !isAll)
    {
      throw std::invalid_argument("it computes an unknown channel from its geometry");
    }
    header.Computed.HasDepth = header.Computed.HasDepth || isDepth;
    header.Computed.HasCoverage = header.Computed.HasCoverage || isCoverage;
    header.Computed.HasColor = header.Computed.HasColor || isColor;
    header.Computed.IsAll = header.Computed.IsAll || isAll;
  }
  if (header.Computed.HasDepth != isRequired)
  {
    throw std::invalid_argument("what it computes from its geometry is not what it requires");
  }
  const ComputedChannels& computed = header.Computed;
  const bool hasDepth = header.Field.FindChannel(KnownChannel::Depth) != nullptr;
  const bool hasBytes = header.Field.FindChannel(KnownChannel::Color)->Type == VTK_UNSIGNED_CHAR;
  if ((computed.HasDepth ? !hasDepth : computed.HasCoverage) ||
    (computed.HasColor && !(computed.HasDepth && hasBytes)) ||
    (computed.IsAll && !(computed.HasColor && computed.HasCoverage)))
  {
    throw std::invalid_argument("it computes other channels from its geometry than it has");
  }
}

/// The description without the features of files that this version supports.
JSON WithoutFeatures(JSON json)
{
  if (json.contains(RequiredKey) && json.at(RequiredKey).is_array())
  {
    JSON& required = json.at(RequiredKey);
    required.erase(
      std::remove(required.begin(), required.end(), JSON(GeometryFeature)), required.end());
  }
  return json;
}

FileHeader Parse(const JSON& json, const HeaderTags& tags)
{
  FileHeader header;
  std::string error;
  const auto field = Description::FromJSON(WithoutFeatures(json), error);
  if (!field)
  {
    throw std::invalid_argument(error);
  }
  header.Field = *field;
  ReadChannels(header);

  const JSON& coding = json.at(CodingKey);
  const JSON required = json.value(RequiredKey, JSON::array());
  ReadComputed(coding,
    std::find(required.begin(), required.end(), JSON(GeometryFeature)) != required.end(), header);
  ReadTracks(coding.at("tracks"), header);
  CheckTracks(header);
  const int frames = header.Field.CountFrames();
  header.Groups = ToGroups(coding.at("groups"),
    header.Computed.IsAll ? static_cast<std::size_t>(frames)
                          : header.Tracks.front().GroupCRCs.size());
  const std::size_t groups = header.Groups.size();
  const auto coded = static_cast<std::size_t>(header.GetCodedGroups());
  const bool equal = groups > 0 &&
    std::all_of(header.Tracks.begin(), header.Tracks.end(),
      [coded](const CodedTrack& track) { return track.GroupCRCs.size() == coded; });
  for (CodedTrack& track : header.Tracks)
  {
    track.GroupCRCs.resize(groups, 0);
  }
  if (!equal || std::accumulate(header.Groups.begin(), header.Groups.end(), 0LL) != frames)
  {
    throw std::invalid_argument("its groups do not match the number of its viewpoints");
  }
  if (coding.contains(MissingKey))
  {
    header.Missing = ToMissing(coding.at(MissingKey), static_cast<int>(coded));
  }
  header.Frames = ToFrames(coding.at("order"), header.Field);
  if (header.Frames.empty())
  {
    throw std::invalid_argument("its frames do not contain each viewpoint exactly once");
  }
  header.Coarsest = ToInteger(coding.at("coarsest"));
  if (coding.at("frame_rate") != FrameRate || header.Coarsest < 0 || header.Coarsest > frames)
  {
    throw std::invalid_argument("its timing is not valid");
  }
  if (json.contains(PartsKey))
  {
    const auto text = tags.find(PartsTagName);
    header.Parts = SplitParts(RequireArray(json.at(PartsKey)),
      text == tags.end() ? std::string() : text->second, header.InPicture, header.Warnings);
  }
  return header;
}

/// The header's JSON from the first tag that contains it completely.
std::optional<JSON> FindJSON(
  const HeaderTags& tags, std::string& warning, bool& isOurs, std::string& error)
{
  using States = UnsealedHeader::States;
  std::optional<JSON> json;
  for (const char* name : HeaderTagNames)
  {
    const auto tag = tags.find(name);
    const UnsealedHeader header = UnsealHeader(tag == tags.end() ? std::string() : tag->second);
    isOurs = isOurs || header.State != States::Foreign;
    if (header.State == States::Whole && !json)
    {
      std::string problem;
      json = ParseJSON(header.JSON, &problem);
      if (json->is_discarded())
      {
        error = "its description is " + problem;
        return std::nullopt;
      }
    }
    else if (header.State == States::OtherFormat)
    {
      error = "it was written by " +
        std::string(header.Format > Description::Format ? "a newer" : "another") +
        " CSLF: format " + std::to_string(header.Format) + ", this reads " +
        std::to_string(Description::Format) + " and 1";
    }
    if (header.State != States::Whole)
    {
      warning = std::string("one of the two copies of its description, in the tag \"") + name +
        "\" is damaged";
    }
  }
  return json;
}
}

std::vector<int> FileHeader::GetGroupStarts() const
{
  std::vector<int> starts(this->Groups.size() + 1, 0);
  std::partial_sum(this->Groups.begin(), this->Groups.end(), starts.begin() + 1);
  return starts;
}

std::vector<int> FileHeader::GetMissingSlices(int time) const
{
  const std::vector<int> starts = this->GetGroupStarts();
  std::vector<int> slices;
  for (int group : this->Missing)
  {
    for (int place = starts[group]; place < starts[group + 1]; ++place)
    {
      if (this->Frames[place].Time == time)
      {
        slices.push_back(this->Frames[place].Slice);
      }
    }
  }
  std::sort(slices.begin(), slices.end());
  return slices;
}

const Track* FileHeader::FindTrack(TrackRole role) const
{
  const auto found = std::find_if(this->Tracks.begin(), this->Tracks.end(),
    [role](const CodedTrack& track) { return track.Kind.Role == role; });
  return found == this->Tracks.end() ? nullptr : &found->Kind;
}

const FilePart* FileHeader::FindGeometry() const
{
  const auto found = std::find_if(
    this->Parts.begin(), this->Parts.end(), [](const FilePart& part) { return part.IsGeometry(); });
  return found == this->Parts.end() ? nullptr : &*found;
}

HeaderTags FileHeader::ToTags() const
{
  JSON tracks = JSON::array();
  for (CodedTrack track : this->Tracks)
  {
    track.GroupCRCs.resize(static_cast<std::size_t>(this->GetCodedGroups()));
    tracks.push_back(ToJSON(track));
  }
  JSON order = JSON::array();
  std::vector<int> indices;
  std::transform(this->Frames.begin(), this->Frames.end(), std::back_inserter(indices),
    [this](FrameId frame) { return this->Field.GetIndex(frame); });
  for (const SliceRun& run : ToRuns(indices))
  {
    order.push_back({ run.Start, run.Step, run.Count });
  }
  JSON json = this->Field.ToJSON();
  json[CodingKey] = { { "frame_rate", FrameRate }, { "tracks", tracks }, { "order", order },
    { "coarsest", this->Coarsest }, { "groups", GroupsToJSON(this->Groups) } };
  if (!this->Missing.empty())
  {
    json[CodingKey][MissingKey] = MissingToJSON(this->Missing);
  }
  if (this->Computed.HasDepth)
  {
    json[RequiredKey] = JSON::array({ GeometryFeature });
    json[CodingKey][ComputedKey] = JSON::array({ NameOfRole(DepthRole) });
  }
  if (this->Computed.HasCoverage)
  {
    json[CodingKey][ComputedKey].push_back(NameOfRole(CoverageRole));
  }
  if (this->Computed.HasColor)
  {
    json[CodingKey][ComputedKey].push_back(NameOfRole(ColorRole));
  }
  if (this->Computed.IsAll)
  {
    json[CodingKey][ComputedKey].push_back(EverythingName);
  }
  HeaderTags tags;
  if (!this->Parts.empty())
  {
    json[PartsKey] = ListParts(this->Parts);
    const std::string text = JoinParts(this->Parts);
    if (!text.empty())
    {
      tags[PartsTagName] = text;
    }
  }
  const std::string text = SealHeader(json.dump());
  for (const char* name : HeaderTagNames)
  {
    tags[name] = text;
  }
  return tags;
}

std::optional<FileHeader> FileHeader::FromTags(
  const HeaderTags& tags, bool& isOurs, std::string& error)
{
  isOurs = false;
  error.clear();
  try
  {
    std::string warning;
    std::optional<JSON> json = FindJSON(tags, warning, isOurs, error);
    if (!json && !isOurs)
    {
      const auto comment = tags.find(HeaderTagNames[0]);
      json = ReadVersion1(comment == tags.end() ? std::string() : comment->second, isOurs, error);
      warning.clear();
    }
    if (!json)
    {
      error = error.empty() ? "its description is damaged" : error;
      return std::nullopt;
    }
    FileHeader header = Parse(*json, tags);
    if (!warning.empty())
    {
      header.Warnings.push_back(warning);
    }
    return header;
  }
  catch (const std::exception& exception)
  {
    error = DescribeException(exception);
    return std::nullopt;
  }
}
}
