// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a coded file says about itself: the field's description and how it is coded, one JSON text
 * in the container's comment, with its own checksum. See Documentation/FileFormat.md.
 */
#ifndef cslfFileHeader_h
#define cslfFileHeader_h

#include "Coding/cslfTrack.h"
#include "cslfDescription.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// A track as the header knows it.
struct CodedTrack
{
  Track Kind;
  std::uint32_t ParameterSetsCRC = 0;
  std::vector<std::uint32_t> GroupCRCs; ///< one for each group
};

struct FileHeader
{
  /// The version of the coding that this code reads and writes.
  static constexpr int Version = 1;

  Description Field;
  std::vector<CodedTrack> Tracks; ///< in the order of the container's video streams
  std::vector<int> Slices;        ///< the slice of each frame
  int Coarsest = 0;               ///< how many of the first frames are the coarsest nested grid
  std::vector<int> Groups;        ///< the number of frames of each group

  /// The first frame of each group, and one more: the number of frames.
  std::vector<int> GetGroupStarts() const;

  /// The track of that role, or null.
  const Track* FindTrack(TrackRole role) const;

  std::string ToText() const;

  /// Reads and checks what ToText wrote. `isOurs` tells whether the text was meant to be one. On
  /// bad input returns nothing and says why, in one line.
  static std::optional<FileHeader> FromText(
    const std::string& text, bool& isOurs, std::string& error);
};
}

#endif
