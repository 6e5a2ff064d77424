// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A file that one process at a time may hold. The operating system lets go of it when the process
 * ends, however it ends.
 */
#ifndef cslfFileLock_h
#define cslfFileLock_h

#include <string>

namespace cslf
{
class FileLock
{
public:
  enum class Outcome
  {
    Locked,
    Busy,   ///< another holder has it
    Removed ///< the file or its folder went away meanwhile: worth another try
  };

  FileLock() = default;
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// Makes the file where it is missing, and locks it. On other trouble than Busy and Removed says
  /// why, in one line.
  Outcome Acquire(const std::string& fileName, std::string& error);

private:
  int Handle = -1;
};
}

#endif
