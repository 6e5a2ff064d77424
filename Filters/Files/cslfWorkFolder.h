// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The folder `OUT.partial` in which the file or folder `OUT` is made.
 *
 * A lock in it keeps other writers of OUT out, and marks it as ours. What is being written lies in
 * a folder of its own in there, whose name nobody else has, and is renamed when it is whole. So
 * what a killed run leaves is known again and the next run clears it away. Nothing else is ever
 * removed: where other files lie in OUT.partial, they stay, and so does the folder.
 */
#ifndef cslfWorkFolder_h
#define cslfWorkFolder_h

#include "Files/cslfFileLock.h"
#include "vtkCSLFModule.h" // for export macro

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cslf
{
/// Where something is written, and where it is kept when it is whole. Empty names stand for
/// nowhere.
struct KeptFile
{
  std::string Unfinished;
  std::string Kept;
};

class WorkFolder
{
public:
  /// Whether a file of that name is one that is made in here.
  using Judge = std::function<bool(const std::string& name)>;

  /// The names of those files of a folder that are ours, in the order to remove them in.
  using Lister = std::function<std::vector<std::string>(const std::string& folder)>;

  /// `isOurs` judges the files that are kept in here for a later run, and those being written.
  /// Where OUT is a folder, `list` tells what such a folder holds.
  WorkFolder(const std::string& target, Judge isOurs, Lister list = nullptr);

  /// Clears away what was being written. If nothing is kept for a later run, removes the folder.
  ~WorkFolder();

  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  /// Makes the folder or takes over what a killed run has left, and keeps others out. On failure
  /// returns false and says why, in one line.
  bool Reserve(std::string& error);

  bool IsReserved() const { return !this->Scratch.empty(); }

  /// Whether an earlier run has left the folder.
  bool IsKnown() const { return this->Known; }

  /// OUT, or what it links to.
  const std::string& GetTarget() const { return this->Target; }

  ///@{
  /// The folder, and something kept in it.
  const std::string& GetName() const { return this->Folder; }
  std::string GetName(const std::string& name) const { return this->Folder + "/" + name; }
  ///@}

  /// Something that is being written.
  std::string GetScratchName(const std::string& name) const { return this->Scratch + "/" + name; }

  /// Writes a file and keeps it. It is not waited for until it is on the disk, so whoever reads it
  /// has to check that it is whole.
  bool Write(
    const std::string& name, const void* bytes, std::size_t count, std::string& error) const;

  /// The files that are kept.
  std::vector<std::string> FindKept() const;

  /// Removes a file that is kept.
  void Remove(const std::string& name) const;

  /// Gives the finished folder that lies under the scratch name to OUT, in the place of an earlier
  /// one, of which `list` tells what may be removed.
  bool PublishFolder(const std::string& name, std::string& error) const;

  /// To be called in the end: clears away all that is ours, and tells what keeps the folder there.
  void Close(std::string& warning);

private:
  bool Lock(std::string& error);
  bool Claim(FileLock::Outcome outcome, std::string& error);
  void ClearDead() const;
  void ClearScratch(const std::string& scratch) const;
  void ClearFolder(const std::string& folder) const;
  void RemoveAll();

  std::string Target;
  std::string Folder;
  std::string Scratch; ///< what is being written; empty unless the folder is reserved
  Judge IsOurs;
  Lister List;
  FileLock Holder;
  bool IsLocked = false;
  bool Known = false; ///< an earlier run has marked it
};

/// What OUT is meant by a name: what a link leads to, without a separator at the end.
VTKCSLF_EXPORT std::string ResolveTarget(const std::string& name);
}

#endif
