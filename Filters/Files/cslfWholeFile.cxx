// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfWholeFile.h"

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

WholeFile::WholeFile(const std::string& name)
  : Work(name, IsNothing)
{
}

WholeFile::~WholeFile() = default;

bool WholeFile::Open(std::string& error)
{
  if (!this->Work.Reserve(error))
  {
    return false;
  }
  const fs::path target = ToPath(this->Work.GetTarget());
  this->Temporary = this->Work.GetScratchName(ToName(target.filename()));
  return true;
}

bool WholeFile::Publish(std::string& warning, std::string& error)
{
  if (!PublishFile(this->Temporary, this->Work.GetTarget(), error))
  {
    return false;
  }
  this->Work.Close(warning);
  return true;
}

WholeFolder::WholeFolder(const std::string& name, WorkFolder::Lister list)
  : List(list)
  , Work(name, IsNothing, std::move(list))
{
}

WholeFolder::~WholeFolder() = default;

bool WholeFolder::Open(const std::string& kind, std::string& error)
{
  this->Kind = kind;
  if (!this->IsReplaceable(error) || !this->Work.Reserve(error))
  {
    return false;
  }
  this->Temporary = this->Work.GetScratchName(NewName);
  return MakeFolder(this->Temporary, error);
}

bool WholeFolder::IsReplaceable(std::string& error) const
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

bool WholeFolder::Publish(std::string& warning, std::string& error)
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
