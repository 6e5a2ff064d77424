// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfAtomicFile.h"

#include "Files/cslfFileSystem.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
namespace fs = std::filesystem;

/// A folder that is being written, in the scratch folder.
constexpr const char* NewName = "new";

/// A disk with less free space counts as full.
constexpr double FewBytes = 1e6;

bool IsNothing(const std::string&)
{
  return false;
}
}

AtomicFile::AtomicFile(const std::string& name)
  : Work(name, IsNothing)
{
}

AtomicFile::~AtomicFile() = default;

bool AtomicFile::Open(std::string& error)
{
  if (!this->Work.Reserve(error))
  {
    return false;
  }
  const fs::path target = ToPath(this->Work.GetTarget());
  this->Temporary = this->Work.GetScratchName(ToName(target.filename()));
  return true;
}

bool AtomicFile::Publish(std::string& warning, std::string& error, bool replaces)
{
  if (!PublishFile(this->Temporary, this->Work.GetTarget(), error, replaces))
  {
    return false;
  }
  this->Work.Close(warning);
  return true;
}

AtomicFolder::AtomicFolder(const std::string& name, WorkFolder::Lister list)
  : List(list)
  , Work(name, IsNothing, std::move(list))
{
}

AtomicFolder::~AtomicFolder() = default;

bool AtomicFolder::Open(const std::string& kind, std::string& error)
{
  this->Kind = kind;
  if (!this->IsReplaceable(error) || !this->Work.Reserve(error))
  {
    return false;
  }
  this->Temporary = this->Work.GetScratchName(NewName);
  return MakeFolder(this->Temporary, error);
}

bool AtomicFolder::IsReplaceable(std::string& error) const
{
  const std::string& folder = this->Work.GetTarget();
  std::error_code ignored;
  if (!fs::exists(fs::symlink_status(ToPath(folder), ignored)))
  {
    return true;
  }
  if (!IsRealFolder(folder))
  {
    error = folder + " already exists and is not a folder";
    return false;
  }
  const std::vector<std::string> ours = this->List(folder);
  for (const std::string& name : ListFolder(folder))
  {
    const fs::file_status status = fs::symlink_status(ToPath(folder + "/" + name), ignored);
    if (std::find(ours.begin(), ours.end(), name) == ours.end() || !fs::is_regular_file(status))
    {
      error = "the folder " + folder + " contains other files than " + this->Kind + ": " + name;
      return false;
    }
  }
  return true;
}

bool AtomicFolder::Publish(std::string& warning, std::string& error)
{
  if (!this->IsReplaceable(error) || !this->Work.PublishFolder(NewName, error))
  {
    return false;
  }
  this->Work.Close(warning);
  return true;
}

bool HasRoom(const std::string& fileName, double bytes, double least, std::string& error)
{
  const double free = GetFreeBytes(fileName);
  if (free >= std::min(least, bytes))
  {
    return true;
  }
  error = "it takes about " + DescribeBytes(bytes) + " more, and the disk has only " +
    DescribeBytes(free) + " left: free " + DescribeBytes(bytes - free) + " more";
  return false;
}

std::string DescribeShortage(const std::string& fileName)
{
  const double bytes = GetFreeBytes(fileName);
  return bytes < FewBytes ? " (the disk has " + DescribeBytes(bytes) + " left)" : "";
}
}
