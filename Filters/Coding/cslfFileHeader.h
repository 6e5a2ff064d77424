// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What a coded file says about itself: the field's description, how it is coded and what else it
 * carries. See Documentation/FileFormat.md.
 */
#ifndef cslfFileHeader_h
#define cslfFileHeader_h

#include "Coding/cslfFileParts.h"
#include "Coding/cslfHeaderText.h"
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

/// A video stream of the container, which holds a track.
struct CodedStream
{
  Codec Coding = Codec::HEVC;
  int Track = -1; ///< of the header's, or -1 for one whose role this version does not know
};

struct FileHeader
{
  Description Field;
  std::vector<CodedTrack> Tracks;   ///< of the roles that this version knows
  std::vector<CodedStream> Streams; ///< of a file that was read, in the container's order
  std::vector<int> Slices;          ///< the slice of each frame
  int Coarsest = 0;                 ///< how many of the first frames are the coarsest nested grid
  std::vector<int> Groups;          ///< the number of frames of each group
  std::vector<FilePart> Parts;
  /// What has to be said of a file that was read, each in a part of a sentence.
  std::vector<std::string> Warnings;

  /// The first frame of each group, and one more: the number of frames.
  std::vector<int> GetGroupStarts() const;

  /// The track of that role, or null.
  const Track* FindTrack(TrackRole role) const;

  /// All that the container's tags have to hold.
  HeaderTags ToTags() const;

  /// Reads and checks what ToTags wrote, or what version 1 did. `isOurs` tells whether the texts
  /// were meant to be that. On bad input returns nothing and says why, in one line.
  static std::optional<FileHeader> FromTags(
    const HeaderTags& tags, bool& isOurs, std::string& error);
};
}

#endif
