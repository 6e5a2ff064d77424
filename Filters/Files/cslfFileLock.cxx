// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfFileLock.h"

#include "Files/cslfFileSystem.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cslf
{
namespace
{
/// What the file holds, so that it is known again.
constexpr const char MarkText[] = "CSLF: a light field is being written here.\n";

constexpr const char* HolderSuffix = ".held";

/// What flock says where the file system has no locks.
bool HasNoLocks(int code)
{
  return code == ENOLCK || code == ENOTSUP || code == EOPNOTSUPP || code == ENOSYS ||
    code == EINVAL;
}
}

FileLock::~FileLock()
{
  this->Release();
}

void FileLock::Release()
{
  if (!this->Holder.empty())
  {
    RemoveFile(this->Holder);
    this->Holder.clear();
  }
  if (this->Handle >= 0)
  {
    ::close(this->Handle);
    this->Handle = -1;
  }
}

FileLock::Outcome FileLock::Acquire(const std::string& fileName, std::string& error)
{
  constexpr int flags = O_RDWR | O_CLOEXEC | O_NOFOLLOW;
  this->FileName = fileName;
  this->Handle = ::open(fileName.c_str(), flags | O_CREAT | O_EXCL, 0666);
  this->Made = this->Handle >= 0;
  if (!this->Made && errno == EEXIST)
  {
    this->Handle = ::open(fileName.c_str(), flags);
  }
  if (this->Handle < 0)
  {
    if (errno != ENOENT)
    {
      error = "cannot open " + fileName + ": " + std::generic_category().message(errno);
    }
    return Outcome::Removed;
  }
  const Outcome outcome = this->Lock(fileName, error);
  if (outcome != Outcome::Locked)
  {
    this->Release();
  }
  return outcome;
}

FileLock::Outcome FileLock::Lock(const std::string& fileName, std::string& error)
{
  if (::flock(this->Handle, LOCK_EX | LOCK_NB) != 0)
  {
    if (errno == EWOULDBLOCK)
    {
      return Outcome::Busy;
    }
    if (!HasNoLocks(errno))
    {
      error = "cannot lock " + fileName + ": " + std::generic_category().message(errno);
      return Outcome::Busy;
    }
    if (!this->HoldByFile(error))
    {
      return Outcome::Busy;
    }
  }
  // The last holder may have removed the file between the two calls.
  struct stat opened = {};
  struct stat named = {};
  if (::fstat(this->Handle, &opened) != 0 || ::stat(fileName.c_str(), &named) != 0 ||
    opened.st_ino != named.st_ino || opened.st_dev != named.st_dev)
  {
    return Outcome::Removed;
  }
  char text[sizeof(MarkText)] = {};
  const ssize_t count = ::pread(this->Handle, text, sizeof(text), 0);
  this->Marked =
    count == static_cast<ssize_t>(std::strlen(MarkText)) && std::strcmp(text, MarkText) == 0;
  // A process that was killed, or found the disk full, may have left the beginning of the mark.
  const bool isBegun =
    count >= 0 && std::strncmp(text, MarkText, static_cast<std::size_t>(count)) == 0;
  return this->Marked || isBegun ? Outcome::Locked : Outcome::Foreign;
}

bool FileLock::HoldByFile(std::string& error)
{
  const std::string holder = this->FileName + HolderSuffix;
  const std::string text = DescribeProcess();
  if (MakeFile(holder, text.data(), text.size(), error))
  {
    this->Holder = holder;
    return true;
  }
  std::ifstream file(holder);
  if (file)
  {
    const std::string other{ std::istreambuf_iterator<char>(file), {} };
    error = "another process is writing it: " + other + " holds " + holder +
      ". This file system cannot tell whether that process still runs; if it does not, remove " +
      holder + " and run again";
  }
  return false;
}

bool FileLock::Mark(std::string& error)
{
  const std::size_t count = std::strlen(MarkText);
  if (!this->Marked && ::pwrite(this->Handle, MarkText, count, 0) != static_cast<ssize_t>(count))
  {
    error = "cannot write " + this->FileName + ": " + std::generic_category().message(errno);
    return false;
  }
  this->Marked = true;
  return true;
}

void FileLock::Remove()
{
  if (this->Handle >= 0 && (this->Made || this->Marked))
  {
    RemoveFile(this->FileName);
  }
  if (!this->Holder.empty())
  {
    RemoveFile(this->Holder);
    this->Holder.clear();
  }
}
}
