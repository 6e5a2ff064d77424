// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfFileSystem.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cslf
{
namespace
{
bool Fail(const std::string& what, const std::string& name, std::string& error)
{
  error = "cannot " + what + " " + name + ": " + std::generic_category().message(errno);
  return false;
}

/// A file descriptor that is closed on destruction.
class Handle
{
public:
  Handle(const std::string& name, int flags)
    : Number(::open(name.c_str(), flags | O_CLOEXEC, 0666))
  {
  }
  ~Handle() { this->Close(); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  int Get() const { return this->Number; }

  bool Close()
  {
    const int number = this->Number;
    this->Number = -1;
    return number < 0 || ::close(number) == 0;
  }

private:
  int Number;
};

/// Some file systems cannot flush folders, and return this error.
bool SyncHandle(int handle, bool isFolder)
{
#ifdef F_FULLFSYNC
  // On macOS, fsync leaves the bytes in the disk's cache.
  if (handle >= 0 && ::fcntl(handle, F_FULLFSYNC) == 0)
  {
    return true;
  }
#endif
  return handle >= 0 &&
    (::fsync(handle) == 0 || (isFolder && (errno == EINVAL || errno == ENOTSUP)));
}
}

bool MakeFolder(const std::string& name, std::string& error)
{
  error.clear();
  if (::mkdir(name.c_str(), 0777) == 0)
  {
    return true;
  }
  return errno == EEXIST ? false : Fail("make the folder", name, error);
}

bool MakeUniqueFolder(const std::string& prefix, std::string& name, std::string& error)
{
  // mkdtemp replaces the last six characters.
  name = prefix + std::string(6, 'X');
  return ::mkdtemp(name.data()) ? true : Fail("make the folder", name, error);
}

bool MakeFile(const std::string& name, const void* bytes, std::size_t count, std::string& error)
{
  Handle handle(name, O_WRONLY | O_CREAT | O_EXCL);
  if (handle.Get() < 0)
  {
    return Fail("make", name, error);
  }
  const char* next = static_cast<const char*>(bytes);
  while (count > 0)
  {
    const ssize_t written = ::write(handle.Get(), next, count);
    if (written < 0 && errno != EINTR)
    {
      Fail("write", name, error);
      RemoveFile(name);
      return false;
    }
    next += std::max<ssize_t>(written, 0);
    count -= static_cast<std::size_t>(std::max<ssize_t>(written, 0));
  }
  if (!handle.Close())
  {
    Fail("write", name, error);
    RemoveFile(name);
    return false;
  }
  return true;
}

bool RemoveFile(const std::string& name)
{
  return ::unlink(name.c_str()) == 0;
}

bool RemoveEmptyFolder(const std::string& name)
{
  return ::rmdir(name.c_str()) == 0;
}

bool Rename(const std::string& from, const std::string& to, std::string& error)
{
  return std::rename(from.c_str(), to.c_str()) == 0 || Fail("rename " + from + " to", to, error);
}

bool ExchangeFolders(const std::string& one, const std::string& other, std::string& error)
{
  error.clear();
#if defined(RENAME_EXCHANGE)
  const int status = ::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE);
#elif defined(RENAME_SWAP)
  const int status = ::renamex_np(one.c_str(), other.c_str(), RENAME_SWAP);
#else
  const int status = -1;
  errno = ENOSYS;
#endif
  if (status == 0)
  {
    return true;
  }
  const bool isUnknown = errno == EINVAL || errno == ENOSYS || errno == ENOTSUP;
  return isUnknown ? false : Fail("rename " + one + " to", other, error);
}

bool SyncFile(const std::string& name, std::string& error)
{
  Handle handle(name, O_RDONLY);
  return (SyncHandle(handle.Get(), false) && handle.Close()) || Fail("write", name, error);
}

bool SyncFolder(const std::string& name, std::string& error)
{
  const Handle handle(name, O_RDONLY | O_DIRECTORY);
  return SyncHandle(handle.Get(), true) || Fail("write to the folder", name, error);
}

bool SyncTree(const std::string& name, std::string& error)
{
#ifdef __linux__
  // All at once: a field has thousands of images, and flushing each file separately is slow.
  const Handle handle(name, O_RDONLY | O_DIRECTORY);
  return (handle.Get() >= 0 && ::syncfs(handle.Get()) == 0) ||
    Fail("write to the folder", name, error);
#else
  for (const std::string& file : ListFolder(name))
  {
    if (!SyncFile(name + "/" + file, error))
    {
      return false;
    }
  }
  return SyncFolder(name, error);
#endif
}

bool IsWritableFolder(const std::string& name, std::string& error)
{
  if (::faccessat(AT_FDCWD, name.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
  {
    return Fail("write to the folder", name, error);
  }
  return true;
}

std::string DescribeProcess()
{
  char host[256] = {};
  ::gethostname(host, sizeof(host) - 1);
  return "process " + std::to_string(::getpid()) + " on " + host;
}
}
