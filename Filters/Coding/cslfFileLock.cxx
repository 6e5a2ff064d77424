// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfFileLock.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cslf
{
FileLock::~FileLock()
{
  if (this->Handle >= 0)
  {
    ::close(this->Handle);
  }
}

FileLock::Outcome FileLock::Acquire(const std::string& fileName, std::string& error)
{
  const int handle = ::open(fileName.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (handle < 0)
  {
    if (errno != ENOENT)
    {
      error = "cannot open " + fileName + ": " + std::strerror(errno);
    }
    return Outcome::Removed;
  }
  Outcome outcome = Outcome::Locked;
  if (::flock(handle, LOCK_EX | LOCK_NB) != 0)
  {
    outcome = Outcome::Busy;
    if (errno != EWOULDBLOCK)
    {
      error = "cannot lock " + fileName + ": " + std::strerror(errno);
    }
  }
  // The last holder may have removed the file between the two calls.
  struct stat opened = {};
  struct stat named = {};
  if (outcome == Outcome::Locked &&
    (::fstat(handle, &opened) != 0 || ::stat(fileName.c_str(), &named) != 0 ||
      opened.st_ino != named.st_ino || opened.st_dev != named.st_dev))
  {
    outcome = Outcome::Removed;
  }
  if (outcome != Outcome::Locked)
  {
    ::close(handle);
    return outcome;
  }
  this->Handle = handle;
  return outcome;
}
}
