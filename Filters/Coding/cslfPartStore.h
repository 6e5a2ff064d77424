// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parts of an unfinished file, one for each group and track, in a folder beside it.
 *
 * A part appears whole, by renaming, and carries a checksum and the number of its manifest, a text
 * that tells all that the parts depend on. However a run ends before the file is whole, the parts
 * stay for the next one.
 */
#ifndef cslfPartStore_h
#define cslfPartStore_h

#include "Coding/cslfGroupCodec.h"
#include "Files/cslfWorkFolder.h"

#include <cstdint>
#include <string>

namespace cslf
{
class PartStore
{
public:
  /// The parts of the file that shall be named `fileName`.
  explicit PartStore(const std::string& fileName);

  /// Keeps what helps to go on, if the store was opened or an earlier run has left the folder.
  ~PartStore();

  PartStore(const PartStore&) = delete;
  PartStore& operator=(const PartStore&) = delete;

  /// Makes the folder or takes over what a killed run left of it, and keeps others out. What is in
  /// it stays if `keep` is set. On failure returns false and says why, in one line.
  bool Reserve(bool keep, std::string& error);

  /// Reserves the folder, unless that is done. Its parts stay if `keep` is set and they were made
  /// under the same manifest; `discarded` tells that there were some of another one although `keep`
  /// is set. On failure returns false and says why, in one line.
  bool Open(const std::string& manifest, bool keep, bool& discarded, std::string& error);

  /// Whether there is a part of that name, damaged or not.
  bool Has(TrackRole role, int group) const;

  bool Write(TrackRole role, int group, const CodedGroup& part, std::string& error) const;
  bool Read(TrackRole role, int group, CodedGroup& part, std::string& error) const;

  ///@{
  /// What was found out about the field before its parts were made, kept under the same manifest;
  /// empty if there is nothing.
  bool WriteTrials(const std::string& text, std::string& error) const;
  std::string ReadTrials() const;
  void DropTrials() const;
  ///@}

  /// Where something that helps to go on may be kept, to be removed with the folder.
  KeptFile GetCacheFile() const;

  /// Where the whole file is put together before it is renamed.
  std::string GetWholeName() const;

  /// Brings the whole file to the disk, renames it to its own name, and only then removes the
  /// parts. A warning tells what keeps the folder there.
  bool Publish(std::string& warning, std::string& error);

  const std::string& GetFolder() const { return this->Work.GetName(); }

private:
  static std::string GetPartName(TrackRole role, int group);
  bool DropOthers() const;

  WorkFolder Work;
  std::uint32_t Manifest = 0;
  bool Opened = false;
};
}

#endif
