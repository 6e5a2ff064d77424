// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfFileHeader.h"

#include "Coding/cslfChecksum.h"
#include "Coding/cslfDepthCurve.h"
#include "Coding/cslfFrameOrder.h"
#include "cslfJSONText.h"

#include <vtkType.h>

#include <zlib.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace cslf
{
namespace
{
using JSON = nlohmann::json;

constexpr const char* CodingKey = "coding";
constexpr const char* ChecksumKey = "checksum";

/// The CRC-32 of a JSON object's text.
std::uint32_t ComputeChecksum(const JSON& json)
{
  const std::string text = json.dump();
  return static_cast<std::uint32_t>(
    ::crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size())));
}

/// What tracks of float colour and of depth say of their samples.
constexpr const char* TransferKey = "transfer";
constexpr const char* PQName = "smpte2084";

/// Where tracks of colour have fewer samples of chroma; in the middle where this is absent.
constexpr const char* SitingKey = "chroma_location";
constexpr const char* LeftName = "left";
const std::string CurveName = "mu-law-" + std::to_string(DepthMu);

JSON ToJSON(const CodedTrack& track)
{
  JSON json = { { "role", NameOfRole(track.Kind.Role) },
    { "codec", NameOfCodec(track.Kind.Coding) },
    { "pixel_format", NameOfFormat(track.Kind.Format) },
    { "bits", BitsOfFormat(track.Kind.Format) }, { "lossless", track.Kind.Lossless },
    { "parameter_sets_crc", track.ParameterSetsCRC }, { "crc", track.GroupCRCs } };
  if (track.Kind.IsRadiance)
  {
    json[TransferKey] = PQName;
  }
  if (track.Kind.IsCurved)
  {
    json[TransferKey] = CurveName;
  }
  if (HasSparseChroma(track.Kind) && track.Kind.Siting == AVCHROMA_LOC_LEFT)
  {
    json[SitingKey] = LeftName;
  }
  return json;
}

CodedTrack ToTrack(const JSON& json)
{
  CodedTrack track;
  const auto role = RoleOfName(json.at("role").get<std::string>());
  const auto codec = CodecOfName(json.at("codec").get<std::string>());
  if (!role || !codec)
  {
    throw std::invalid_argument("it has a track of an unknown role or codec");
  }
  const auto format = FindPixelFormat(*role, json.at("pixel_format").get<std::string>());
  if (!format)
  {
    throw std::invalid_argument(
      std::string("its track \"") + NameOfRole(*role) + "\" has an unknown pixel format");
  }
  const std::string transfer = json.value(TransferKey, "");
  track.Kind = { *role, *format, json.at("lossless").get<bool>(), *codec,
    *role == TrackRole::Color && transfer == PQName,
    *role == TrackRole::Depth && transfer == CurveName };
  const std::string siting = json.value(SitingKey, "");
  if (!siting.empty() && siting != LeftName)
  {
    throw std::invalid_argument("its chroma has an unknown location");
  }
  track.Kind.Siting = siting.empty() ? AVCHROMA_LOC_CENTER : AVCHROMA_LOC_LEFT;
  const bool isKnown =
    track.Kind.IsRadiance ? CanHoldRadiance(*format) : track.Kind.IsCurved || transfer.empty();
  if (!isKnown)
  {
    throw std::invalid_argument(
      std::string("its track \"") + NameOfRole(*role) + "\" has an unknown transfer curve");
  }
  track.ParameterSetsCRC = ToInteger<std::uint32_t>(json.at("parameter_sets_crc"));
  track.GroupCRCs = ToIntegers<std::uint32_t>(json.at("crc"));
  return track;
}

std::vector<CodedTrack> ToTracks(const JSON& json, const Description& field)
{
  std::vector<CodedTrack> tracks;
  int roles = 0;
  for (const JSON& item : RequireArray(json))
  {
    tracks.push_back(ToTrack(item));
    const int role = 1 << static_cast<int>(tracks.back().Kind.Role);
    if ((roles & role) != 0)
    {
      throw std::invalid_argument("it has two tracks of one role");
    }
    roles |= role;
  }
  const auto bit = [](TrackRole role) { return 1 << static_cast<int>(role); };
  const int depth = roles & ~(bit(TrackRole::Color) | bit(TrackRole::Coverage));
  const bool depthFits = field.FindChannel(DepthName) ? depth == bit(TrackRole::Depth) ||
      depth == (bit(TrackRole::DepthHigh) | bit(TrackRole::DepthLow))
                                                      : depth == 0;
  const bool isFloat = field.FindChannel(ColorName)->Type == VTK_FLOAT;
  if (tracks.empty() || tracks.front().Kind.Role != TrackRole::Color || !depthFits ||
    tracks.front().Kind.IsRadiance != isFloat)
  {
    throw std::invalid_argument("its tracks are not those of its channels");
  }
  return tracks;
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

/// `count` is the number of groups that the checksums promise.
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

std::vector<int> ToSlices(const JSON& json, int count)
{
  std::vector<SliceRun> runs;
  for (const JSON& item : RequireArray(json))
  {
    runs.push_back({ ToInteger(item.at(0)), ToInteger(item.at(1)), ToInteger(item.at(2)) });
  }
  return FromRuns(runs, count);
}

void CheckChannels(const Description& field)
{
  for (const Channel& channel : field.Channels)
  {
    const bool known = channel.Components == (channel.Name == ColorName ? 4 : 1) &&
      ((channel.Name == ColorName &&
         (channel.Type == VTK_UNSIGNED_CHAR || channel.Type == VTK_FLOAT)) ||
        (channel.Name == DepthName && channel.Type == VTK_UNSIGNED_SHORT));
    if (!known)
    {
      throw std::invalid_argument("its channel \"" + channel.Name + "\" is not of a known kind");
    }
  }
  if (!field.FindChannel(ColorName))
  {
    throw std::invalid_argument("it has no colour");
  }
}

FileHeader Parse(const JSON& json)
{
  FileHeader header;
  std::string error;
  const auto field = Description::FromJSON(json, error);
  if (!field)
  {
    throw std::invalid_argument(error);
  }
  header.Field = *field;
  CheckChannels(header.Field);

  const JSON& coding = json.at(CodingKey);
  const int version = ToInteger(coding.at("version"));
  if (version != FileHeader::Version)
  {
    throw std::invalid_argument("its coding has version " + std::to_string(version) +
      ", known is " + std::to_string(FileHeader::Version));
  }
  header.Tracks = ToTracks(coding.at("tracks"), header.Field);
  const std::size_t groups = header.Tracks.front().GroupCRCs.size();
  header.Groups = ToGroups(coding.at("groups"), groups);
  const bool equal = std::all_of(header.Tracks.begin(), header.Tracks.end(),
    [groups](const CodedTrack& track) { return track.GroupCRCs.size() == groups; });
  const int slices = header.Field.Grid.GetSlices();
  if (!equal || header.Groups.size() != groups ||
    std::accumulate(header.Groups.begin(), header.Groups.end(), 0LL) != slices)
  {
    throw std::invalid_argument("its groups do not add up to its viewpoints");
  }
  header.Slices = ToSlices(coding.at("order"), slices);
  if (header.Slices.empty())
  {
    throw std::invalid_argument("its frames are not each viewpoint once");
  }
  header.Coarsest = ToInteger(coding.at("coarsest"));
  if (coding.at("frame_rate") != FrameRate || header.Coarsest < 0 || header.Coarsest > slices)
  {
    throw std::invalid_argument("its timing is not valid");
  }
  return header;
}
}

std::vector<int> FileHeader::GetGroupStarts() const
{
  std::vector<int> starts(this->Groups.size() + 1, 0);
  std::partial_sum(this->Groups.begin(), this->Groups.end(), starts.begin() + 1);
  return starts;
}

const Track* FileHeader::FindTrack(TrackRole role) const
{
  const auto found = std::find_if(this->Tracks.begin(), this->Tracks.end(),
    [role](const CodedTrack& track) { return track.Kind.Role == role; });
  return found == this->Tracks.end() ? nullptr : &found->Kind;
}

std::string FileHeader::ToText() const
{
  JSON tracks = JSON::array();
  for (const CodedTrack& track : this->Tracks)
  {
    tracks.push_back(ToJSON(track));
  }
  JSON order = JSON::array();
  for (const SliceRun& run : ToRuns(this->Slices))
  {
    order.push_back({ run.Start, run.Step, run.Count });
  }
  JSON json = this->Field.ToJSON();
  json[CodingKey] = { { "version", Version }, { "frame_rate", FrameRate }, { "tracks", tracks },
    { "order", order }, { "coarsest", this->Coarsest }, { "groups", GroupsToJSON(this->Groups) } };
  json[ChecksumKey] = ComputeChecksum(json);
  return json.dump();
}

std::optional<FileHeader> FileHeader::FromText(
  const std::string& text, bool& isOurs, std::string& error)
{
  JSON json = ParseJSON(text);
  isOurs = json.is_object() && json.contains(CodingKey) && json.contains(ChecksumKey);
  if (!isOurs)
  {
    error = "it is no light field";
    return std::nullopt;
  }
  try
  {
    const auto expected = ToInteger<std::uint32_t>(json.at(ChecksumKey));
    json.erase(ChecksumKey);
    if (!IsExpected(ComputeChecksum(json), expected))
    {
      error = "its description is damaged";
      return std::nullopt;
    }
    return Parse(json);
  }
  catch (const std::exception& exception)
  {
    error = exception.what();
    return std::nullopt;
  }
}
}
