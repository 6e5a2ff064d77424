// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The folder `OUT.partial` in which the file or folder `OUT` is made.
 *
 * A lock file in it excludes other writers of OUT, and marks the folder as ours. Files are written
 * in a subfolder with a unique name, and renamed when they are complete. So the next run recognises
 * and removes what a killed run leaves. Nothing else is ever removed: other files in OUT.partial
 * stay, and then the folder stays, too.
 *
 * New files and folders have the permissions that the process's umask leaves them. What replaces an
 * earlier file or folder gets its permissions, and is made where only those can enter who may read
 * the earlier one.
 */
#ifndef cslfWorkFolder_h
#define cslfWorkFolder_h

#include "cslfLockedFile.h"
#include "vtkCSLFModule.h" // for export macro

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cslf
{
class FileLock
{
public:
  enum class Outcome
  {
    Locked,
    Busy,    ///< another process holds it
    Foreign, ///< a file of that name exists and is not ours
    Removed  ///< the file or its folder was removed meanwhile: try again
  };

  FileLock() = default;

  /// Releases the lock.
  ~FileLock();

  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Creates the file if it is missing, and locks it. On other errors gives the reason in one line.
  Outcome Acquire(const std::string& fileName, std::string& error);

  /// After Acquire: whether the file has our mark from an earlier run.
  bool IsMarked() const { return this->Marked; }

  /// Marks it.
  bool Mark(std::string& error);

  /// Removes a file that is marked or was created by Acquire, while it is locked.
  void Remove();

private:
  Outcome ReadMark();
  bool HoldByFile(std::string& error);
  void Release();
  void RemoveHolder();

  LockedFile File;
  std::string FileName;
  std::string Holder; ///< the second file, if this process has made it
  bool Marked = false;
};

/// Where something is written, and where it is when it is complete. Empty names mean nowhere.
struct PersistentFile
{
  std::string Unfinished;
  std::string Final;
};

class WorkFolder
{
public:
  /// Whether a file name is one of those that are made in this folder.
  using NameTest = std::function<bool(const std::string& name)>;

  /// The names of those files of a folder that are ours, in the order of removal.
  using Lister = std::function<std::vector<std::string>(const std::string& folder)>;

  /// `isOurs` recognises the files that are kept for a later run, and those being written. If OUT
  /// is a folder, `list` returns the files of such a folder.
  WorkFolder(const std::string& target, NameTest isOurs, Lister list = nullptr);

  /// Removes what was being written, and the folder if nothing is kept for a later run.
  ~WorkFolder();

  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  /// Makes the folder or takes over that of a killed run, and locks it. On failure returns false
  /// and gives the reason in one line.
  bool Reserve(std::string& error);

  bool IsReserved() const { return !this->Scratch.empty(); }

  /// Whether an earlier run has left the folder.
  bool IsKnown() const { return this->Known; }

  /// OUT, or what it links to.
  const std::string& GetTarget() const { return this->Target; }

  ///@{
  /// The folder, and the path of a kept file.
  const std::string& GetName() const { return this->Folder; }
  std::string GetName(const std::string& name) const { return this->Folder + "/" + name; }
  ///@}

  /// The path of a file being written.
  std::string GetScratchName(const std::string& name) const { return this->Scratch + "/" + name; }

  /// Writes a file and keeps it. It is not flushed to the disk, so readers must check that it is
  /// complete.
  bool Write(
    const std::string& name, const void* bytes, std::size_t count, std::string& error) const;

  /// The files that are kept.
  std::vector<std::string> FindKept() const;

  /// Removes a file that is kept.
  void Remove(const std::string& name) const;

  /// Moves the finished folder from the scratch name to OUT. Replaces an earlier folder, whose
  /// files are removed if `list` returns them.
  bool PublishFolder(const std::string& name, std::string& error) const;

  /// To be called at the end: removes everything that is ours. The warning says why the folder
  /// stays, if it does.
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
  NameTest IsOurs;
  Lister List;
  FileLock Holder;
  bool IsLocked = false;
  bool Known = false; ///< an earlier run has marked it
};

///@{
/// OUT.partial, and the name of a viewable file in it of what there is of the coded file OUT so
/// far.
VTKCSLF_EXPORT std::string GetWorkFolder(const std::string& target);
VTKCSLF_EXPORT std::string GetPreviewName(const std::string& target);
///@}

/// Whether a folder has been marked by a WorkFolder.
VTKCSLF_EXPORT bool IsWorkFolder(const std::string& folder);

/// The file or folder that a name means: the target of a link, without a separator at the end.
VTKCSLF_EXPORT std::string ResolveTarget(const std::string& name);
}

#endif
