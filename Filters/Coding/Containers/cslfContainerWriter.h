// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An MP4 or Matroska file of coded groups.
 */
#ifndef cslfContainerWriter_h
#define cslfContainerWriter_h

#include "Coding/Groups/cslfGroupEncoder.h"
#include "cslfFileParts.h"

#include <cstddef>
#include <string>
#include <vector>

namespace cslf
{
/// FFmpeg's name of the container for a file's extension, or null.
const char* FindContainer(const std::string& fileName);

/// Open, AddTrack for each track, Begin, Write for each group and track, End. Every step returns
/// false on failure and gives the reason in one line. The file is then unusable.
class ContainerWriter
{
public:
  bool Open(const std::string& fileName, const HeaderTags& tags, std::string& error);

  bool AddTrack(const Track& track, int resolution, const std::vector<std::uint8_t>& parameterSets,
    std::string& error);
  bool Begin(std::string& error);

  /// Adds a group whose first frame is the track's frame `start`. Packets are timed for a decoder
  /// that runs `delay` frames ahead.
  bool Write(std::size_t track, int start, int delay, const CodedGroup& group, std::string& error);
  bool End(std::string& error);

private:
  AVOutput Output;
};
}

#endif
