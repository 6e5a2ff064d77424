// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a coded file contains besides the light field, such as a mesh or a table. The header lists
 * the parts. The geometry's bytes are in a unit of the first coded picture, those of other parts in
 * a tag of the container, in base64.
 */
#ifndef cslfFileParts_h
#define cslfFileParts_h

#include "cslfJSONForward.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cslf
{
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
