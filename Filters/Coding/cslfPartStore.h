// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parts of an unfinished file, one for each group and track, in a folder beside it.
 *
 * A part appears whole, by renaming, so whatever lies there under its own name can be trusted as
 * far as its checksum goes. The layout of a part is private to the machine that wrote it.
 */
#ifndef cslfPartStore_h
#define cslfPartStore_h

#include "Coding/cslfGroupCodec.h"

#include <string>

namespace cslf
{
class PartStore
{
public:
  /// The parts of the file that shall be named `fileName`.
  explicit PartStore(const std::string& fileName);

  /// Removes the folder and what this class put there.
  ~PartStore();

  PartStore(const PartStore&) = delete;
  PartStore& operator=(const PartStore&) = delete;

  /// Makes the folder, empty of parts. On failure returns false and says why, in one line.
  bool Create(std::string& error);

  bool Write(TrackRole role, int group, const CodedGroup& part, std::string& error) const;
  bool Read(TrackRole role, int group, CodedGroup& part, std::string& error) const;

  /// Where the whole file is put together before it is renamed.
  std::string GetWholeName() const;

  /// Renames the whole file to its own name.
  bool Publish(std::string& error) const;

private:
  std::string GetPartName(TrackRole role, int group) const;
  void Clear() const;

  std::string FileName;
  std::string Folder;
  bool Created = false;
};
}

#endif
