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

/// What the header's list says about a part.
struct ListedPart
{
  FilePart Part;
  std::size_t Count = 0; ///< of its bytes
  std::uint32_t CRC = 0;
  bool IsInTag = false; ///< where this version expects it
};

ListedPart ToListedPart(const JSON& json)
{
  ListedPart listed;
  listed.Part.Type = json.at("type").get<std::string>();
  listed.Part.Name = json.at("name").get<std::string>();
  listed.Count = ToInteger<std::size_t>(json.at("bytes"));
  listed.CRC = ToInteger<std::uint32_t>(json.at("crc"));
  listed.IsInTag = json.at("tag") == PartsTagName;
  if (listed.Part.Type.empty() || !IsShort(listed.Part.Type) || !IsShort(listed.Part.Name) ||
    listed.Count > MaximumTagBytes)
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
    bytes += CountTagBytes(other.Bytes.size());
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
      { "crc", ComputeCRC(part.Bytes.data(), part.Bytes.size()) }, { "tag", PartsTagName } });
  }
  return list;
}

std::string JoinParts(const std::vector<FilePart>& parts)
{
  std::string text;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    text += (k == 0 ? "" : " ") + ToBase64(parts[k].Bytes.data(), parts[k].Bytes.size());
  }
  return text;
}

std::vector<FilePart> SplitParts(
  const JSON& list, const std::string& text, std::vector<std::string>& warnings)
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
    if (!listed.IsInTag)
    {
      warnings.push_back(
        "its " + Describe(listed.Part) + " is stored in a way that this version does not support");
      continue;
    }
    const std::size_t length = CountTagBytes(listed.Count) - 1;
    const std::string digits = text.substr(std::min(begin, text.size()), length);
    begin += length + 1;
    if (FromBase64(digits, listed.Count, listed.Part.Bytes) &&
      IsExpected(ComputeCRC(listed.Part.Bytes.data(), listed.Count), listed.CRC))
    {
      parts.push_back(std::move(listed.Part));
    }
    else
    {
      warnings.push_back("its " + Describe(listed.Part) + " is damaged and left out");
    }
  }
  return parts;
}
}
