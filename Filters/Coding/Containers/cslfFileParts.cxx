// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFileParts.h"

#include "cslfDescription.h"
#include "cslfJSONText.h"
#include "cslfJoin.h"

#include <vtkBase64Utilities.h>

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace cslf
{
namespace
{
using JSON = nlohmann::json;

constexpr const char* ChecksumKey = "checksum";

/// Files of version 1 leave out values that were the same in all of them.
void Complete(JSON& track)
{
  const std::string transfer = track.value("transfer", "");
  if (transfer == "mu-law-40")
  {
    track["transfer"] = "mu-law";
    track["mu"] = 40;
  }
  else if (transfer == "smpte2084")
  {
    track["reference_white"] = 203;
  }
  if (track.at("role") == "coverage")
  {
    track["tolerance"] = track.at("lossless") == true ? 0 : 8;
  }
  track["crc"] = ToText(ToIntegers<std::uint32_t>(track.at("crc")));
}
}

std::optional<JSON> ReadVersion1(const std::string& text, bool& isOurs, std::string& error)
{
  JSON json = ParseJSON(text);
  isOurs = json.is_object() && json.contains("coding") && json.contains(ChecksumKey);
  if (!isOurs)
  {
    error = "it is not a light field";
    return std::nullopt;
  }
  const auto expected = ToInteger<std::uint32_t>(json.at(ChecksumKey));
  json.erase(ChecksumKey);
  const std::string canonical = json.dump();
  if (!IsExpected(ComputeCRC(canonical.data(), canonical.size()), expected))
  {
    error = "its description is damaged";
    return std::nullopt;
  }
  if (ToInteger(json.at("version")) != 1 || ToInteger(json.at("coding").at("version")) != 1)
  {
    throw std::invalid_argument("its version is not valid");
  }
  for (JSON& track : json.at("coding").at("tracks"))
  {
    Complete(track);
  }
  return json;
}

namespace
{
constexpr std::string_view Mark = "CSLF ";
constexpr std::size_t ChecksumDigits = 8;

/// Takes a number and the blank after it from the start of a text.
template <typename Number>
bool TakeNumber(std::string_view& text, int base, Number& number)
{
  const char* const end = text.data() + text.size();
  const auto [next, failure] = std::from_chars(text.data(), end, number, base);
  if (failure != std::errc() || next == end || *next != ' ')
  {
    return false;
  }
  text.remove_prefix(static_cast<std::size_t>(next - text.data()) + 1);
  return true;
}

std::size_t CountDigits(std::size_t bytes)
{
  return (bytes + 2) / 3 * 4;
}

const unsigned char* ToBytes(const std::string& text)
{
  return reinterpret_cast<const unsigned char*>(text.data());
}
}

std::uint32_t ComputeCRC(const void* bytes, std::size_t count)
{
  return static_cast<std::uint32_t>(::crc32_z(0, static_cast<const Bytef*>(bytes), count));
}

std::string SealHeader(const std::string& json)
{
  char checksum[ChecksumDigits + 1];
  std::snprintf(checksum, sizeof(checksum), "%08x",
    static_cast<unsigned int>(ComputeCRC(json.data(), json.size())));
  return std::string(Mark) + std::to_string(Description::Format) + " " + checksum + " " + json;
}

UnsealedHeader UnsealHeader(const std::string& text)
{
  UnsealedHeader header;
  std::string_view rest = text;
  if (rest.substr(0, Mark.size()) != Mark)
  {
    return header;
  }
  rest.remove_prefix(Mark.size());
  header.State = UnsealedHeader::States::Damaged;
  if (!TakeNumber(rest, 10, header.Format))
  {
    return header;
  }
  if (header.Format != Description::Format)
  {
    header.State = UnsealedHeader::States::OtherFormat;
    return header;
  }
  std::uint32_t checksum = 0;
  if (rest.find(' ') == ChecksumDigits && TakeNumber(rest, 16, checksum) &&
    rest.size() <= MaximumTagBytes && IsExpected(ComputeCRC(rest.data(), rest.size()), checksum))
  {
    header.State = UnsealedHeader::States::Whole;
    header.JSON = rest;
  }
  return header;
}

std::string ToBase64(const void* bytes, std::size_t count)
{
  std::string text(CountDigits(count), '\0');
  vtkBase64Utilities::Encode(
    static_cast<const unsigned char*>(bytes), count, reinterpret_cast<unsigned char*>(text.data()));
  return text;
}

bool FromBase64(const std::string& text, std::size_t count, std::vector<unsigned char>& bytes)
{
  if (text.size() != CountDigits(count))
  {
    return false;
  }
  bytes.resize(count);
  return count == 0 ||
    vtkBase64Utilities::DecodeSafely(ToBytes(text), text.size(), bytes.data(), count) == count;
}

std::string ToText(const std::vector<std::uint32_t>& checksums)
{
  std::vector<unsigned char> bytes;
  for (std::uint32_t checksum : checksums)
  {
    for (int shift = 24; shift >= 0; shift -= 8)
    {
      bytes.push_back(static_cast<unsigned char>(checksum >> shift));
    }
  }
  return ToBase64(bytes.data(), bytes.size());
}

std::vector<std::uint32_t> ToChecksums(const std::string& text)
{
  // Up to two of the last four digits are padding.
  const std::size_t most = text.size() / 4 * 3;
  const std::size_t padding = text.size() - std::min(text.size(), text.find_last_not_of('=') + 1);
  std::vector<unsigned char> bytes;
  if (padding > most || (most - padding) % 4 != 0 || !FromBase64(text, most - padding, bytes))
  {
    throw std::invalid_argument("its checksums are not valid");
  }
  std::vector<std::uint32_t> checksums(bytes.size() / 4, 0);
  for (std::size_t k = 0; k < bytes.size(); ++k)
  {
    checksums[k / 4] = checksums[k / 4] << 8 | bytes[k];
  }
  return checksums;
}

namespace
{
using JSON = nlohmann::json;

constexpr std::size_t MaximumParts = 1000;

std::size_t CountTagBytes(std::size_t bytes)
{
  return (bytes + 2) / 3 * 4 + 1;
}

bool IsShort(const std::string& text)
{
  return text.size() <= MaximumNameLength && MakePrintable(text) == text;
}

bool IsUTF8(const std::string& text)
{
  try
  {
    return !JSON(text).dump().empty();
  }
  catch (const JSON::exception&)
  {
    return false;
  }
}

/// The most bytes of a part in a picture.
constexpr std::size_t MaximumPictureBytes = std::size_t(256) << 20;

constexpr const char* TagKey = "tag";
constexpr const char* FrameKey = "frame";

ListedPart ToListedPart(const JSON& json)
{
  ListedPart listed;
  listed.Part.Type = json.at("type").get<std::string>();
  listed.Part.Name = json.at("name").get<std::string>();
  listed.Count = ToInteger<std::size_t>(json.at("bytes"));
  listed.CRC = ToInteger<std::uint32_t>(json.at("crc"));
  using Places = ListedPart::Places;
  listed.Place = json.contains(FrameKey)
    ? (json.at(FrameKey) == 0 ? Places::Picture : Places::Unknown)
    : (json.at(TagKey) == PartsTagName ? Places::Tag : Places::Unknown);
  if (listed.Part.Type.empty() || !IsShort(listed.Part.Type) || !IsShort(listed.Part.Name) ||
    listed.Count > (listed.Place == Places::Picture ? MaximumPictureBytes : MaximumTagBytes))
  {
    throw std::invalid_argument("a part has an invalid entry");
  }
  return listed;
}

std::string Describe(const FilePart& part)
{
  return (part.Name.empty() ? "part" : "part \"" + part.Name + "\"") + " (" + part.Type + ")";
}
}

bool FilePart::IsGeometry() const
{
  return this->Type == GeometryPartType && this->Name == GeometryPartName;
}

bool ListedPart::Matches(const std::vector<unsigned char>& bytes) const
{
  return bytes.size() == this->Count &&
    IsExpected(ComputeCRC(bytes.data(), bytes.size()), this->CRC);
}

std::string DescribeDamage(const FilePart& part)
{
  return "its " + Describe(part) + " is damaged and left out";
}

std::string FindError(const std::vector<FilePart>& others, const FilePart& part)
{
  if (part.Type.empty() || !IsShort(part.Type) || !IsShort(part.Name) || !IsUTF8(part.Type) ||
    !IsUTF8(part.Name))
  {
    return "A part needs a type. Its type and name must have at most " +
      std::to_string(MaximumNameLength) + " bytes of UTF-8 without control characters.";
  }
  std::size_t bytes = CountTagBytes(part.Bytes.size());
  for (const FilePart& other : others)
  {
    if (other.Type == part.Type && other.Name == part.Name)
    {
      return "There are two parts of the same type and name: " + Describe(part) + ".";
    }
    bytes += other.IsGeometry() ? 0 : CountTagBytes(other.Bytes.size());
  }
  if (bytes > MaximumTagBytes || others.size() >= MaximumParts)
  {
    return "The parts of a file are limited to 12 MiB in total and to " +
      std::to_string(MaximumParts) + " parts: " + Describe(part) + " does not fit.";
  }
  return {};
}

JSON ListParts(const std::vector<FilePart>& parts)
{
  JSON list = JSON::array();
  for (const FilePart& part : parts)
  {
    list.push_back({ { "type", part.Type }, { "name", part.Name }, { "bytes", part.Bytes.size() },
      { "crc", ComputeCRC(part.Bytes.data(), part.Bytes.size()) } });
    if (part.IsGeometry())
    {
      list.back()[FrameKey] = 0;
    }
    else
    {
      list.back()[TagKey] = PartsTagName;
    }
  }
  return list;
}

std::string JoinParts(const std::vector<FilePart>& parts)
{
  std::string text;
  const char* separator = "";
  for (const FilePart& part : parts)
  {
    if (!part.IsGeometry())
    {
      // Also after a part without bytes.
      text += separator + ToBase64(part.Bytes.data(), part.Bytes.size());
      separator = " ";
    }
  }
  return text;
}

std::vector<FilePart> SplitParts(const JSON& list, const std::string& text,
  std::vector<ListedPart>& inPicture, std::vector<std::string>& warnings)
{
  std::vector<FilePart> parts;
  std::size_t begin = 0;
  for (const JSON& item : list)
  {
    ListedPart listed;
    try
    {
      listed = ToListedPart(item);
    }
    catch (const std::exception&)
    {
      // The start of the next one is then unknown.
      warnings.emplace_back("its list of parts is invalid from one of its entries on");
      break;
    }
    if (listed.Place == ListedPart::Places::Picture)
    {
      inPicture.push_back(std::move(listed));
      continue;
    }
    if (listed.Place == ListedPart::Places::Unknown)
    {
      warnings.push_back(
        "its " + Describe(listed.Part) + " is stored in a way that this version does not support");
      continue;
    }
    const std::size_t length = CountTagBytes(listed.Count) - 1;
    const std::string digits = text.substr(std::min(begin, text.size()), length);
    begin += length + 1;
    if (FromBase64(digits, listed.Count, listed.Part.Bytes) && listed.Matches(listed.Part.Bytes))
    {
      parts.push_back(std::move(listed.Part));
    }
    else
    {
      warnings.push_back(DescribeDamage(listed.Part));
    }
  }
  return parts;
}
}
