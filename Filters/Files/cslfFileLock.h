// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A lock file for one process at a time, which also marks its folder as ours.
 *
 * The operating system releases the lock when the process ends, also if it is killed. If the file
 * system has no locks, a second file names the holder; a killed process leaves it behind.
 */
#ifndef cslfFileLock_h
#define cslfFileLock_h

#include "Files/cslfLockedFile.h"

#include <string>

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
}

#endif
