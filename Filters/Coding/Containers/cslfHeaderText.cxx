// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfHeaderText.h"

#include "cslfChecksum.h"
#include "cslfDescription.h"
#include "cslfJSONText.h"

#include <vtkBase64Utilities.h>

#include <zlib.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string_view>

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
}
