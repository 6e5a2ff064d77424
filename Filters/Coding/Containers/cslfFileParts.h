// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a coded file contains besides the light field, such as a mesh or a table. The header lists
 * the parts, a tag of the container holds their bytes in base64.
 */
#ifndef cslfFileParts_h
#define cslfFileParts_h

#include "cslfJSONForward.h"

#include <string>
#include <vector>

namespace cslf
{
struct FilePart
{
  std::string Type; ///< what the bytes are, such as "model/gltf-binary"
  std::string Name; ///< which of its type, may be empty
  std::vector<unsigned char> Bytes;
};

/// The type and the name of the part that holds a geometry.
constexpr const char* GeometryPartType = "model/vnd.cslf.geometry";
constexpr const char* GeometryPartName = "geometry";

/// Says in one line why a part cannot be added to others. Empty if it can.
std::string FindError(const std::vector<FilePart>& others, const FilePart& part);

/// The header's list.
nlohmann::json ListParts(const std::vector<FilePart>& parts);

/// The tag's text: the base64 of each part, with a blank between two of them.
std::string JoinParts(const std::vector<FilePart>& parts);

/// The parts of the header's list that the tag's text holds undamaged. Appends warnings about the
/// others.
std::vector<FilePart> SplitParts(
  const nlohmann::json& list, const std::string& text, std::vector<std::string>& warnings);
}

#endif
