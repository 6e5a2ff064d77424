// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfFileSystem.h"

#include "Files/Windows/cslfWindows.h"

#include <random>

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

bool MakeFolder(const std::string& name, std::string& error)
{
  error.clear();
  if (::CreateDirectoryW(ToPath(name).c_str(), nullptr))
  {
    return true;
  }
  return ::GetLastError() == ERROR_ALREADY_EXISTS ? false : Fail("make the folder", name, error);
}

bool MakeUniqueFolder(const std::string& prefix, std::string& name, std::string& error)
{
  constexpr int attempts = 100;
  constexpr int characters = 6;
  const std::string letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device random;
  std::uniform_int_distribution<std::size_t> pick(0, letters.size() - 1);
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    name = prefix;
    for (int k = 0; k < characters; ++k)
    {
      name += letters[pick(random)];
    }
    if (MakeFolder(name, error))
    {
      return true;
    }
    if (!error.empty())
    {
      return false;
    }
  }
  ::SetLastError(ERROR_ALREADY_EXISTS);
  return Fail("make the folder", name, error);
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
