// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfLockedFile.h"

#include "Files/Windows/cslfWindows.h"
#include "Files/cslfFileSystem.h"

namespace cslf
{
namespace
{
HANDLE GetHandle(std::intptr_t handle)
{
  return reinterpret_cast<HANDLE>(handle);
}

/// Nobody else can open the file while it is open. This is the lock.
std::intptr_t OpenAlone(const std::string& fileName, DWORD disposition)
{
  constexpr DWORD access = GENERIC_READ | GENERIC_WRITE | DELETE;
  constexpr DWORD flags = FILE_ATTRIBUTE_NORMAL | FILE_FLAG_OPEN_REPARSE_POINT;
  return reinterpret_cast<std::intptr_t>(
    ::CreateFileW(ToPath(fileName).c_str(), access, 0, nullptr, disposition, flags, nullptr));
}

bool IsAt(HANDLE file, LONGLONG place)
{
  LARGE_INTEGER offset = {};
  offset.QuadPart = place;
  return ::SetFilePointerEx(file, offset, nullptr, FILE_BEGIN) != FALSE;
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
    ::CloseHandle(GetHandle(this->Handle));
    this->Handle = Closed;
  }
}

LockedFile::Outcome LockedFile::Open(const std::string& fileName, std::string& error)
{
  this->FileName = fileName;
  this->Handle = OpenAlone(fileName, CREATE_NEW);
  this->Created = this->IsOpen();
  if (!this->Created && ::GetLastError() == ERROR_FILE_EXISTS)
  {
    this->Handle = OpenAlone(fileName, OPEN_EXISTING);
  }
  if (this->IsOpen())
  {
    return Outcome::Locked;
  }
  switch (::GetLastError())
  {
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION:
      return Outcome::Busy;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_DELETE_PENDING:
      return Outcome::Removed;
    default:
      error = ExplainLastError("open", fileName);
      return Outcome::Failed;
  }
}

bool LockedFile::IsNamed() const
{
  return true; // While it is open, nobody else can remove it.
}

bool LockedFile::Read(char* bytes, std::size_t capacity, std::size_t& count) const
{
  const HANDLE file = GetHandle(this->Handle);
  DWORD result = 0;
  const bool isRead =
    IsAt(file, 0) && ::ReadFile(file, bytes, static_cast<DWORD>(capacity), &result, nullptr);
  count = result;
  return isRead;
}

bool LockedFile::Write(const char* bytes, std::size_t count, std::string& error)
{
  const HANDLE file = GetHandle(this->Handle);
  DWORD result = 0;
  if (!IsAt(file, 0) || !::WriteFile(file, bytes, static_cast<DWORD>(count), &result, nullptr) ||
    result != count)
  {
    error = ExplainLastError("write", this->FileName);
    return false;
  }
  return true;
}

void LockedFile::Remove()
{
  // The name disappears when the file is closed, so nobody can take it in between.
  FILE_DISPOSITION_INFO disposition = {};
  disposition.DeleteFile = TRUE;
  ::SetFileInformationByHandle(
    GetHandle(this->Handle), FileDispositionInfo, &disposition, sizeof(disposition));
  this->Close();
}
}
