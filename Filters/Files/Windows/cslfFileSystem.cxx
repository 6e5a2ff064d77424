// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfFileSystem.h"

#include "Files/Windows/cslfWindows.h"

#include <algorithm>
#include <string>
#include <system_error>

namespace cslf
{
namespace
{
bool Fail(const std::string& what, const std::string& name, std::string& error)
{
  error = ExplainLastError(what, name);
  return false;
}

/// A handle of a file or folder, closed on destruction.
class Handle
{
public:
  Handle(const std::string& name, DWORD access, DWORD disposition, DWORD flags)
    : Value(::CreateFileW(ToPath(name).c_str(), access,
        FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, disposition, flags,
        nullptr))
  {
  }
  ~Handle()
  {
    if (this->IsOpen())
    {
      ::CloseHandle(this->Value);
    }
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  bool IsOpen() const { return this->Value != INVALID_HANDLE_VALUE; }
  HANDLE Get() const { return this->Value; }

private:
  HANDLE Value;
};

bool Write(HANDLE file, const char* bytes, std::size_t count)
{
  while (count > 0)
  {
    constexpr std::size_t most = std::size_t{ 1 } << 30;
    DWORD written = 0;
    const auto size = static_cast<DWORD>(count < most ? count : most);
    if (!::WriteFile(file, bytes, size, &written, nullptr))
    {
      return false;
    }
    bytes += written;
    count -= written;
  }
  return true;
}
}

bool MakeFolder(const std::string& name, std::string& error, unsigned int)
{
  error.clear();
  if (::CreateDirectoryW(ToPath(name).c_str(), nullptr))
  {
    return true;
  }
  return ::GetLastError() == ERROR_ALREADY_EXISTS ? false : Fail("make the folder", name, error);
}

unsigned int GetFolderAccess(const std::string&)
{
  return ForEveryone;
}

void CopyAccess(const std::string& earlier, const std::string& made)
{
  // The lists of access that files do not inherit from their folders. A copy of them is no more
  // than an attempt: Windows keeps the owner to the one who writes.
  constexpr SECURITY_INFORMATION lists = DACL_SECURITY_INFORMATION;
  DWORD size = 0;
  ::GetFileSecurityW(ToPath(earlier).c_str(), lists, nullptr, 0, &size);
  std::string descriptor(size, '\0');
  if (size > 0 &&
    ::GetFileSecurityW(ToPath(earlier).c_str(), lists, descriptor.data(), size, &size))
  {
    ::SetFileSecurityW(ToPath(made).c_str(), lists, descriptor.data());
  }
}

InputFile::~InputFile()
{
  if (this->Handle != -1)
  {
    ::CloseHandle(reinterpret_cast<HANDLE>(this->Handle));
  }
}

bool InputFile::Open(const std::string& name, std::string& reason)
{
  this->Handle = reinterpret_cast<std::intptr_t>(::CreateFileW(ToPath(name).c_str(), GENERIC_READ,
    FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, OPEN_EXISTING,
    FILE_ATTRIBUTE_NORMAL, nullptr));
  if (this->Handle == -1)
  {
    reason = std::system_category().message(static_cast<int>(::GetLastError()));
    return false;
  }
  this->Opened = this->FindState();
  return true;
}

InputFile::State InputFile::FindState() const
{
  BY_HANDLE_FILE_INFORMATION status = {};
  if (!::GetFileInformationByHandle(reinterpret_cast<HANDLE>(this->Handle), &status))
  {
    return {};
  }
  const FILETIME& time = status.ftLastWriteTime;
  return { std::uint64_t(status.nFileSizeHigh) << 32 | status.nFileSizeLow,
    static_cast<std::int64_t>(std::uint64_t(time.dwHighDateTime) << 32 | time.dwLowDateTime) };
}

std::size_t InputFile::Read(std::uint64_t place, void* bytes, std::size_t count) const
{
  std::size_t done = 0;
  while (done < count)
  {
    OVERLAPPED position = {};
    position.Offset = static_cast<DWORD>((place + done) & 0xffffffffu);
    position.OffsetHigh = static_cast<DWORD>((place + done) >> 32);
    constexpr std::size_t most = std::size_t{ 1 } << 30;
    DWORD found = 0;
    if (!::ReadFile(reinterpret_cast<HANDLE>(this->Handle), static_cast<char*>(bytes) + done,
          static_cast<DWORD>(std::min(count - done, most)), &found, &position) ||
      found == 0)
    {
      break;
    }
    done += found;
  }
  return done;
}

bool MakeFile(const std::string& name, const void* bytes, std::size_t count, std::string& error)
{
  bool isWritten = false;
  {
    const Handle handle(name, GENERIC_WRITE, CREATE_NEW, FILE_ATTRIBUTE_NORMAL);
    if (!handle.IsOpen())
    {
      return Fail("make", name, error);
    }
    isWritten = Write(handle.Get(), static_cast<const char*>(bytes), count);
    if (!isWritten)
    {
      Fail("write", name, error);
    }
  }
  if (!isWritten)
  {
    RemoveFile(name);
  }
  return isWritten;
}

bool RemoveFile(const std::string& name)
{
  return ::DeleteFileW(ToPath(name).c_str()) != FALSE;
}

bool RemoveEmptyFolder(const std::string& name)
{
  return ::RemoveDirectoryW(ToPath(name).c_str()) != FALSE;
}

bool Rename(const std::string& from, const std::string& to, std::string& error)
{
  return ::MoveFileExW(ToPath(from).c_str(), ToPath(to).c_str(),
           MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH) ||
    Fail("rename " + from + " to", to, error);
}

bool RenameToFree(const std::string& from, const std::string& to, std::string& error)
{
  if (::MoveFileExW(ToPath(from).c_str(), ToPath(to).c_str(), MOVEFILE_WRITE_THROUGH))
  {
    return true;
  }
  const DWORD code = ::GetLastError();
  if (code == ERROR_ALREADY_EXISTS || code == ERROR_FILE_EXISTS)
  {
    error = NameIsTaken;
    return false;
  }
  return Fail("rename " + from + " to", to, error);
}

bool ExchangeFolders(const std::string&, const std::string&, std::string& error)
{
  error.clear();
  return false; // Windows cannot do that in one step.
}

bool SyncFile(const std::string& name, std::string& error)
{
  const Handle handle(name, GENERIC_WRITE, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL);
  return (handle.IsOpen() && ::FlushFileBuffers(handle.Get())) || Fail("write", name, error);
}

bool SyncFolder(const std::string&, std::string&)
{
  return true; // Rename writes through, and Windows cannot flush other names.
}

bool SyncTree(const std::string& name, std::string& error)
{
  for (const std::string& file : ListFolder(name))
  {
    if (!SyncFile(name + "/" + file, error))
    {
      return false;
    }
  }
  return true;
}

bool IsWritableFolder(const std::string& name, std::string& error)
{
  const Handle handle(name, FILE_ADD_FILE, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
  return handle.IsOpen() || Fail("write to the folder", name, error);
}

std::string DescribeProcess()
{
  wchar_t host[MAX_COMPUTERNAME_LENGTH + 1] = {};
  DWORD size = MAX_COMPUTERNAME_LENGTH + 1;
  ::GetComputerNameW(host, &size);
  return "process " + std::to_string(::GetCurrentProcessId()) + " on " +
    ToName(std::filesystem::path(host));
}
}
