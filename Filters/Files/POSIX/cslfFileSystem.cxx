// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfFileSystem.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#if defined(__linux__)
#include <sys/xattr.h>
#elif defined(__APPLE__)
#include <copyfile.h>
#endif

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

/// Copies access control lists and the user's attributes. Labels for the system's security are its
/// own affair.
void CopyAttributes(const std::string& from, const std::string& to)
{
#ifdef __linux__
  const ssize_t size = ::listxattr(from.c_str(), nullptr, 0);
  std::string names(static_cast<std::size_t>(std::max<ssize_t>(size, 0)), '\0');
  if (names.empty() || ::listxattr(from.c_str(), names.data(), names.size()) != size)
  {
    return;
  }
  for (std::size_t begin = 0; begin < names.size(); begin = names.find('\0', begin) + 1)
  {
    const char* name = names.c_str() + begin;
    const bool isCopied =
      std::strncmp(name, "user.", 5) == 0 || std::strncmp(name, "system.posix_acl_", 17) == 0;
    const ssize_t length = isCopied ? ::getxattr(from.c_str(), name, nullptr, 0) : -1;
    std::string value(static_cast<std::size_t>(std::max<ssize_t>(length, 0)), '\0');
    if (length >= 0 && ::getxattr(from.c_str(), name, value.data(), value.size()) == length)
    {
      ::setxattr(to.c_str(), name, value.data(), value.size(), 0);
    }
  }
#elif defined(__APPLE__)
  ::copyfile(from.c_str(), to.c_str(), nullptr, COPYFILE_ACL | COPYFILE_XATTR);
#else
  (void)from;
  (void)to;
#endif
}

/// The error of a rename with flags that the system or the file system does not know.
bool IsUnknown(int code)
{
  return code == EINVAL || code == ENOSYS || code == ENOTSUP || code == EOPNOTSUPP;
}

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

bool MakeFolder(const std::string& name, std::string& error, unsigned int access)
{
  error.clear();
  if (::mkdir(name.c_str(), access) == 0)
  {
    return true;
  }
  return errno == EEXIST ? false : Fail("make the folder", name, error);
}

unsigned int GetFolderAccess(const std::string& name)
{
  struct stat status = {};
  if (::stat(name.c_str(), &status) != 0)
  {
    return ForEveryone;
  }
  // Whoever may read the file may enter the folder.
  const unsigned int readers = status.st_mode & 0044;
  return ForOwner | readers | readers >> 1 | readers >> 2;
}

void CopyAccess(const std::string& earlier, const std::string& made)
{
  struct stat status = {};
  if (::stat(earlier.c_str(), &status) != 0)
  {
    return;
  }
  // Only the superuser may give files away, but others may give them to their groups. This clears
  // some permissions, so it comes first.
  mode_t mode = status.st_mode & (S_ISDIR(status.st_mode) ? 07777 : 0777);
  if (::chown(made.c_str(), status.st_uid, status.st_gid) != 0 &&
    ::chown(made.c_str(), static_cast<uid_t>(-1), status.st_gid) != 0)
  {
    errno = 0;
    // Another group gets no more than everybody.
    mode = (mode & ~static_cast<mode_t>(02070)) | (mode & (mode & 07) << 3);
  }
#ifdef __linux__
  // The list that the folder's default has given it. The one of the earlier file follows.
  ::removexattr(made.c_str(), "system.posix_acl_access");
#endif
  if (::chmod(made.c_str(), mode) == 0)
  {
    CopyAttributes(earlier, made);
  }
}

InputFile::~InputFile()
{
  if (this->Handle >= 0)
  {
    ::close(static_cast<int>(this->Handle));
  }
}

bool InputFile::Open(const std::string& name, std::string& reason)
{
  this->Handle = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  if (this->Handle < 0)
  {
    reason = std::generic_category().message(errno);
    return false;
  }
  this->Opened = this->FindState();
  return true;
}

InputFile::State InputFile::FindState() const
{
  struct stat status = {};
  if (::fstat(static_cast<int>(this->Handle), &status) != 0)
  {
    return {};
  }
#ifdef __APPLE__
  const timespec& time = status.st_mtimespec;
#else
  const timespec& time = status.st_mtim;
#endif
  constexpr std::int64_t nanoseconds = 1000000000;
  return { static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0)),
    nanoseconds * time.tv_sec + time.tv_nsec };
}

std::size_t InputFile::Read(std::uint64_t place, void* bytes, std::size_t count) const
{
  std::size_t done = 0;
  while (done < count)
  {
    const ssize_t found = ::pread(static_cast<int>(this->Handle), static_cast<char*>(bytes) + done,
      count - done, static_cast<off_t>(place + done));
    if (found == 0 || (found < 0 && errno != EINTR))
    {
      break;
    }
    done += static_cast<std::size_t>(std::max<ssize_t>(found, 0));
  }
  return done;
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

bool RenameToFree(const std::string& from, const std::string& to, std::string& error)
{
#if defined(RENAME_NOREPLACE)
  int status = ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE);
#elif defined(RENAME_EXCL)
  int status = ::renamex_np(from.c_str(), to.c_str(), RENAME_EXCL);
#else
  int status = -1;
  errno = ENOSYS;
#endif
  if (status != 0 && IsUnknown(errno))
  {
    // A link does not replace anything, either.
    status = ::link(from.c_str(), to.c_str());
    if (status == 0)
    {
      ::unlink(from.c_str());
    }
  }
  if (status != 0 && (IsUnknown(errno) || errno == EPERM))
  {
    struct stat taken = {};
    const bool isFree = ::lstat(to.c_str(), &taken) != 0 && errno == ENOENT;
    errno = isFree ? 0 : EEXIST;
    status = isFree ? std::rename(from.c_str(), to.c_str()) : -1;
  }
  if (status != 0 && errno == EEXIST)
  {
    error = NameIsTaken;
    return false;
  }
  return status == 0 || Fail("rename " + from + " to", to, error);
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
  return IsUnknown(errno) ? false : Fail("rename " + one + " to", other, error);
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
