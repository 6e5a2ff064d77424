// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfFileLock.h"

#include "Files/cslfFileSystem.h"

#include <cstring>
#include <fstream>
#include <iterator>

namespace cslf
{
namespace
{
/// The contents that mark the file.
constexpr const char MarkText[] = "CSLF: a light field is being written here.\n";

constexpr const char* HolderSuffix = ".held";
}

FileLock::~FileLock()
{
  this->Release();
}

void FileLock::Release()
{
  this->RemoveHolder();
  this->File.Close();
}

void FileLock::RemoveHolder()
{
  if (!this->Holder.empty())
  {
    RemoveFile(this->Holder);
    this->Holder.clear();
  }
}

FileLock::Outcome FileLock::Acquire(const std::string& fileName, std::string& error)
{
  this->FileName = fileName;
  const LockedFile::Outcome opened = this->File.Open(fileName, error);
  Outcome outcome = Outcome::Busy;
  if (opened == LockedFile::Outcome::Removed)
  {
    outcome = Outcome::Removed;
  }
  else if (opened == LockedFile::Outcome::Locked ||
    (opened == LockedFile::Outcome::Unsupported && this->HoldByFile(error)))
  {
    outcome = this->ReadMark();
  }
  if (outcome != Outcome::Locked)
  {
    this->Release();
  }
  return outcome;
}

FileLock::Outcome FileLock::ReadMark()
{
  if (!this->File.IsNamed())
  {
    return Outcome::Removed;
  }
  char text[sizeof(MarkText)] = {};
  std::size_t count = 0;
  const bool isRead = this->File.Read(text, sizeof(text), count);
  this->Marked = count == std::strlen(MarkText) && std::strcmp(text, MarkText) == 0;
  // A process that was killed, or that found the disk full, may have written only the start of the
  // mark.
  const bool isBegun = isRead && std::strncmp(text, MarkText, count) == 0;
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
  std::ifstream file(ToPath(holder));
  if (file)
  {
    const std::string other{ std::istreambuf_iterator<char>(file), {} };
    error = "another process is writing it: " + other + " holds " + holder +
      ". This file system does not show whether that process is still running. If it is not, "
      "remove " +
      holder + " and run again";
  }
  return false;
}

bool FileLock::Mark(std::string& error)
{
  this->Marked = this->Marked || this->File.Write(MarkText, std::strlen(MarkText), error);
  return this->Marked;
}

void FileLock::Remove()
{
  if (this->File.IsOpen() && (this->File.IsCreated() || this->Marked))
  {
    this->File.Remove();
  }
  this->RemoveHolder();
}
}
