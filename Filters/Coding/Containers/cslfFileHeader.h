// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The header of a coded file: the field's description, how it is coded and what else the file
 * contains. See Documentation/FileFormat.md.
 */
#ifndef cslfFileHeader_h
#define cslfFileHeader_h

#include "Coding/Codecs/cslfTrack.h"
#include "cslfDescription.h"
#include "cslfFileParts.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cslf
{
/// A track in the header.
struct CodedTrack
{
  Track Kind;
  std::uint32_t ParameterSetsCRC = 0;
  std::vector<std::uint32_t> GroupCRCs; ///< one for each group; those that are not coded have any
};

/// A video stream of the container, which contains a track.
struct CodedStream
{
  Codec Coding = Codec::HEVC;
  int Track = -1; ///< the header's track, or -1 for a role that this version does not know
};

/// What readers compute from the geometry that is one of the parts.
struct ComputedChannels
{
  bool HasDepth = false;
  bool HasCoverage = false; ///< only together with depth
  bool HasColor = false;    ///< where the geometry has it, only together with depth
  /// The geometry has all colours, and the others are computed, too: the file has only the first
  /// group, whose frames have no meaning.
  bool IsAll = false;
};

struct FileHeader
{
  Description Field;
  std::vector<CodedTrack> Tracks;   ///< of the roles that this version knows
  std::vector<CodedStream> Streams; ///< of a file that was read, in the container's order
  std::vector<FrameId> Frames;      ///< in coding order
  int Coarsest = 0;         ///< how many of the first frames belong to the coarsest nested grid
  std::vector<int> Groups;  ///< the number of frames of each group
  std::vector<int> Missing; ///< the groups that an unfinished file does not contain yet, ascending
  std::vector<FilePart> Parts;
  std::vector<ListedPart> InPicture; ///< parts of a file that is being read, not in Parts yet
  ComputedChannels Computed;
  /// Warnings about a file that was read, each in a part of a sentence.
  std::vector<std::string> Warnings;

  /// The first frame of each group, and one more: the number of frames.
  std::vector<int> GetGroupStarts() const;

  /// How many of the first groups the file has when it is finished.
  int GetCodedGroups() const
  {
    return this->Computed.IsAll ? 1 : static_cast<int>(this->Groups.size());
  }

  /// The slices of a time that the missing groups contain, ascending.
  std::vector<int> GetMissingSlices(int time) const;

  /// The track of that role, or null.
  const Track* FindTrack(TrackRole role) const;

  /// The part with the geometry, or null.
  const FilePart* FindGeometry() const;

  /// The contents of all of the container's tags.
  HeaderTags ToTags() const;

  /// Reads and checks what ToTags wrote, or what version 1 did. `isOurs` tells whether the texts
  /// were meant to be that. On bad input returns nothing and gives the reason in one line.
  static std::optional<FileHeader> FromTags(
    const HeaderTags& tags, bool& isOurs, std::string& error);
};
}

#endif
