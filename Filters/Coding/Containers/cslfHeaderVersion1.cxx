// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfHeaderVersion1.h"

#include "cslfChecksum.h"
#include "cslfHeaderText.h"
#include "cslfJSONText.h"

#include <cstdint>
#include <stdexcept>

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
}
