// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How the header's JSON text is stored: after the number of its format and a checksum of its bytes,
 * in two of the container's tags.
 */
#ifndef cslfHeaderText_h
#define cslfHeaderText_h

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cslfJSONForward.h"

namespace cslf
{
/// Converts the header to version 2. `isOurs` tells whether the text was meant to be a header. On
/// bad input returns nothing and gives the reason in one line. May throw what JSON's functions
/// throw.
std::optional<nlohmann::json> ReadVersion1(
  const std::string& text, bool& isOurs, std::string& error);

/// Texts of a container, by the names of their tags.
using HeaderTags = std::map<std::string, std::string>;

/// The two tags that contain the same header, and the tag that contains the parts. FFmpeg copies
/// these from MP4 to Matroska and back.
constexpr const char* HeaderTagNames[] = { "comment", "description" };
constexpr const char* PartsTagName = "synopsis";

/// The largest tag that Matroska's demuxer reads, in bytes.
constexpr std::size_t MaximumTagBytes = std::size_t(16) << 20;

/// The CRC-32 of some bytes.
std::uint32_t ComputeCRC(const void* bytes, std::size_t count);

/// `CSLF 2 <CRC-32 of the JSON text, 8 hexadecimal digits> <JSON text>`.
std::string SealHeader(const std::string& json);

/// The kind of a tag's text.
struct UnsealedHeader
{
  enum class States
  {
    Foreign, ///< something else
    Damaged,
    OtherFormat, ///< of another number
    Whole
  };
  States State = States::Foreign;
  int Format = 0;
  std::string JSON;
};
UnsealedHeader UnsealHeader(const std::string& text);

///@{
/// Bytes as text. Decoding returns nothing if the text is not the base64 of that many bytes.
std::string ToBase64(const void* bytes, std::size_t count);
bool FromBase64(const std::string& text, std::size_t count, std::vector<unsigned char>& bytes);
///@}

///@{
/// Checksums as text: base64 of their bytes, the highest byte of each first. Throws
/// std::invalid_argument if the text is not such a list.
std::string ToText(const std::vector<std::uint32_t>& checksums);
std::vector<std::uint32_t> ToChecksums(const std::string& text);
///@}
}

#endif
