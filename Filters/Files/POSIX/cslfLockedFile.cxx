// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfLockedFile.h"

#include "Files/cslfFileSystem.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cslf
{
namespace
{
/// flock's error if the file system has no locks.
bool HasNoLocks(int code)
{
  return code == ENOLCK || code == ENOTSUP || code == EOPNOTSUPP || code == ENOSYS ||
    code == EINVAL;
}

std::string Explain(const std::string& what, const std::string& name)
{
  return "cannot " + what + " " + name + ": " + std::generic_category().message(errno);
}
}

LockedFile::~LockedFile()
{
  this->Close();
}

void LockedFile::Close()
{
  if (this->IsOpen())
  {
    ::close(static_cast<int>(this->Handle));
    this->Handle = Closed;
  }
}

LockedFile::Outcome LockedFile::Open(const std::string& fileName, std::string& error)
{
  constexpr int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW;
  this->FileName = fileName;
  this->Handle = ::open(fileName.c_str(), flags | O_CREAT | O_EXCL, 0666);
  this->Created = this->IsOpen();
  if (!this->Created && errno == EEXIST)
  {
    this->Handle = ::open(fileName.c_str(), flags);
  }
  if (!this->IsOpen())
  {
    if (errno == ENOENT)
    {
      return Outcome::Removed;
    }
    error = Explain("open", fileName);
    return Outcome::Failed;
  }
  if (::flock(static_cast<int>(this->Handle), LOCK_EX | LOCK_NB) == 0)
  {
    return Outcome::Locked;
  }
  if (HasNoLocks(errno))
  {
    return Outcome::Unsupported;
  }
  const bool isBusy = errno == EWOULDBLOCK;
  if (!isBusy)
  {
    error = Explain("lock", fileName);
  }
  this->Close();
  return isBusy ? Outcome::Busy : Outcome::Failed;
}

bool LockedFile::IsNamed() const
{
  struct stat opened = {};
  struct stat named = {};
  return ::fstat(static_cast<int>(this->Handle), &opened) == 0 &&
    ::stat(this->FileName.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
    opened.st_dev == named.st_dev;
}

bool LockedFile::Read(char* bytes, std::size_t capacity, std::size_t& count) const
{
  const ssize_t result = ::pread(static_cast<int>(this->Handle), bytes, capacity, 0);
  count = result < 0 ? 0 : static_cast<std::size_t>(result);
  return result >= 0;
}

bool LockedFile::Write(const char* bytes, std::size_t count, std::string& error)
{
  if (::pwrite(static_cast<int>(this->Handle), bytes, count, 0) != static_cast<ssize_t>(count))
  {
    error = Explain("write", this->FileName);
    return false;
  }
  return true;
}

void LockedFile::Remove()
{
  RemoveFile(this->FileName);
}
}
