// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parts of an unfinished file, one for each group and track, in a folder beside it.
 *
 * A part appears whole, by renaming, and carries a checksum. A manifest tells what the parts are
 * parts of, so that a run that was killed can be gone on with. A lock keeps two processes from
 * writing one file.
 */
#ifndef cslfPartStore_h
#define cslfPartStore_h

#include "Coding/cslfFileLock.h"
#include "Coding/cslfGroupCodec.h"

#include <string>

namespace cslf
{
class PartStore
{
public:
  /// The parts of the file that shall be named `fileName`.
  explicit PartStore(const std::string& fileName);

  /// Removes the folder and what this class put there, if it was opened or newly made.
  ~PartStore();

  PartStore(const PartStore&) = delete;
  PartStore& operator=(const PartStore&) = delete;

  /// Makes the folder or takes over what a killed run left of it, and keeps others out. What is in
  /// it stays if `keep` is set. On failure returns false and says why, in one line.
  bool Reserve(bool keep, std::string& error);

  /// Reserves the folder, unless that is done, for good. Its parts stay if `keep` is set
  /// and they were made under the same manifest, a text that tells all they depend on; `discarded`
  /// tells that there were some of another one although `keep` is set. On failure returns false
  /// and says why, in one line.
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
  ///@}

  /// Where something that helps to go on may be kept, to be removed with the folder.
  std::string GetCacheName() const;

  /// Where the whole file is put together before it is renamed.
  std::string GetWholeName() const;

  /// Renames the whole file to its own name.
  bool Publish(std::string& error) const;

private:
  bool Lock(std::string& error);
  void RemoveCache() const;
  std::string GetName(const std::string& name) const;
  std::string GetPartName(TrackRole role, int group) const;
  bool WriteWhole(
    const std::string& name, const void* data, std::size_t size, std::string& error) const;
  int CountParts() const;
  void RemoveUnfinished() const;
  void RemoveParts() const;

  std::string FileName;
  std::string Folder;
  FileLock Holder;
  bool Reserved = false;
  bool IsNew = false; // no earlier run has left the folder
  bool Opened = false;
};
}

#endif
