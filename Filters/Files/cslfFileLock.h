// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A file that one process at a time may hold, and by which its folder is known for ours.
 *
 * The operating system lets go of it when the process ends, however it ends. Where the file system
 * has no such locks, a second file tells who holds the first one; a killed process leaves it.
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
    Busy,    ///< another holder has it
    Foreign, ///< a file of that name is none of ours
    Removed  ///< the file or its folder went away meanwhile: worth another try
  };

  FileLock() = default;

  /// Lets go.
  ~FileLock();

  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Makes the file where it is missing, and locks it. On other trouble says why, in one line.
  Outcome Acquire(const std::string& fileName, std::string& error);

  /// After Acquire: whether the file has the mark of ours, from an earlier run.
  bool IsMarked() const { return this->Marked; }

  /// Marks it.
  bool Mark(std::string& error);

  /// Removes a file that is marked, or that Acquire has made, while it is held.
  void Remove();

private:
  Outcome ReadMark();
  bool HoldByFile(std::string& error);
  void Release();
  void RemoveHolder();

  LockedFile File;
  std::string FileName;
  std::string Holder; ///< the second file, where this process has made it
  bool Marked = false;
};
}

#endif
