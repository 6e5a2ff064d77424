// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An MP4 or Matroska file of coded groups.
 */
#ifndef cslfContainerWriter_h
#define cslfContainerWriter_h

#include "Coding/cslfGroupCodec.h"
#include "Coding/cslfHeaderText.h"

#include <cstddef>
#include <string>
#include <vector>

namespace cslf
{
/// FFmpeg's name of the container that a file's extension asks for, or null.
const char* FindContainer(const std::string& fileName);

/// Open, AddTrack for each track, Begin, Write for each group and track, End. Every step returns
/// false on failure and says why, in one line; the file is then of no use.
class ContainerWriter
{
public:
  ContainerWriter() = default;
  ~ContainerWriter();
  ContainerWriter(const ContainerWriter&) = delete;
  ContainerWriter& operator=(const ContainerWriter&) = delete;

  bool Open(const std::string& fileName, const HeaderTags& tags, std::string& error);

  /// Opens a container as a file of that name would be, but without a file.
  bool OpenInMemory(const std::string& fileName, std::string& error);

  bool AddTrack(const Track& track, int resolution, const std::vector<std::uint8_t>& parameterSets,
    std::string& error);
  bool Begin(std::string& error);

  /// Adds a group whose first frame is the track's frame `start`. Packets are timed for a decoder
  /// that runs `delay` frames ahead.
  bool Write(std::size_t track, int start, int delay, const CodedGroup& group, std::string& error);
  bool End(std::string& error);

  /// The bytes of what was opened in memory, after End.
  std::size_t GetSize() const { return this->Size; }

private:
  bool Allocate(const std::string& fileName, const std::string& url, std::string& error);

  AVOutput Output;
  bool InMemory = false;
  std::size_t Size = 0;
};

/// What a container adds to each group of tracks, given by one of their groups: beside the frames'
/// bytes, and without what it has once only. 0 where that cannot be told.
double MeasureContainer(const std::string& fileName, const std::vector<Track>& tracks,
  int resolution, const std::vector<CodedGroup>& parts);
}

#endif
