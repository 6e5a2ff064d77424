// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFileParts.h"

#include "cslfChecksum.h"
#include "cslfDescription.h"
#include "cslfHeaderText.h"
#include "cslfJSONText.h"
#include "cslfJoin.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace cslf
{
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
