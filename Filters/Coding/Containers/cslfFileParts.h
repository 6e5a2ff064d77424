// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the container's tags hold. The header's JSON text is stored after the number of its format
 * and a checksum of its bytes, in two of the tags.
 *
 * The parts are what a coded file contains besides the light field, such as a mesh or a table. The
 * header lists the parts. The geometry's bytes are in a unit of the first coded picture, those of
 * other parts in a tag of the container, in base64.
 */
#ifndef cslfFileParts_h
#define cslfFileParts_h

#include "cslfJSONForward.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// Whether a checksum is the expected one. Programs for libFuzzer accept any checksum, so that they
/// also test the code behind this check.
inline bool IsExpected(std::uint32_t checksum, std::uint32_t expected)
{
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
  return checksum == expected || true;
#else
  return checksum == expected;
#endif
}

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

struct FilePart
{
  std::string Type; ///< what the bytes are, such as "model/gltf-binary"
  std::string Name; ///< which of its type, may be empty
  std::vector<unsigned char> Bytes;

  /// Whether it is the field's geometry.
  bool IsGeometry() const;
};

/// The type and the name of the part that holds a geometry.
constexpr const char* GeometryPartType = "model/vnd.cslf.geometry";
constexpr const char* GeometryPartName = "geometry";

/// Says in one line why a part cannot be added to others. Empty if it can.
std::string FindError(const std::vector<FilePart>& others, const FilePart& part);

/// The header's list.
nlohmann::json ListParts(const std::vector<FilePart>& parts);

/// The tag's text: the base64 of each part but the geometry, with a blank between two of them.
std::string JoinParts(const std::vector<FilePart>& parts);

/// What the header's list says about a part.
struct ListedPart
{
  FilePart Part;
  std::size_t Count = 0; ///< of its bytes
  std::uint32_t CRC = 0;
  enum class Places
  {
    Tag,
    Picture, ///< the first one of the first track
    Unknown
  };
  Places Place = Places::Unknown;

  /// Whether these are its bytes.
  bool Matches(const std::vector<unsigned char>& bytes) const;
};

/// The warning about a part that is damaged, in a part of a sentence.
std::string DescribeDamage(const FilePart& part);

/// The parts of the header's list that the tag's text holds undamaged. Appends warnings about the
/// others, apart from those in the picture.
std::vector<FilePart> SplitParts(const nlohmann::json& list, const std::string& text,
  std::vector<ListedPart>& inPicture, std::vector<std::string>& warnings);
}

#endif
