// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Files/cslfFileSystem.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <random>
#include <system_error>

namespace cslf
{
namespace
{
namespace fs = std::filesystem;
}

std::filesystem::path ToPath(const std::string& name)
{
  return fs::u8path(name);
}

std::string ToName(const std::filesystem::path& path)
{
  return path.u8string();
}

std::vector<std::string> ListFolder(const std::string& name)
{
  std::vector<std::string> names;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(ToPath(name), ignored))
  {
    names.push_back(ToName(entry.path().filename()));
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool IsRealFolder(const std::string& name)
{
  std::error_code ignored;
  return fs::is_directory(fs::symlink_status(ToPath(name), ignored));
}

bool IsReplaceableByFile(const std::string& name, std::string& error)
{
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(ToPath(name), ignored);
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    error = name + " already exists and is not a file";
    return false;
  }
  return true;
}

bool MakeUniqueFolder(
  const std::string& prefix, unsigned int access, std::string& name, std::string& error)
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
    if (MakeFolder(name, error, access))
    {
      return true;
    }
    if (!error.empty())
    {
      return false;
    }
  }
  error = "cannot make the folder " + name + ": all names are taken";
  return false;
}

bool InputFile::HasChanged() const
{
  const State now = this->FindState();
  return now.Size != this->Opened.Size || now.Time != this->Opened.Time;
}

bool PublishFile(const std::string& from, const std::string& to, std::string& error, bool replaces)
{
  if (!SyncFile(from, error))
  {
    return false;
  }
  if (replaces)
  {
    CopyAccess(to, from);
  }
  return (replaces ? Rename(from, to, error) : RenameToFree(from, to, error)) &&
    SyncFolder(GetParent(to), error);
}

double GetFreeBytes(const std::string& name)
{
  std::error_code failure;
  fs::path place = ToPath(name);
  while (!fs::exists(place, failure) && place.has_parent_path() && place != place.parent_path())
  {
    place = place.parent_path();
  }
  const fs::space_info space = fs::space(place.empty() ? fs::path(".") : place, failure);
  return failure || space.available == static_cast<std::uintmax_t>(-1)
    ? std::numeric_limits<double>::infinity()
    : static_cast<double>(space.available);
}

std::string DescribeBytes(double bytes)
{
  const char* const units[] = { "bytes", "kB", "MB", "GB", "TB" };
  int unit = 0;
  for (; bytes >= 1000.0 && unit < 4; ++unit)
  {
    bytes /= 1000.0;
  }
  char text[64];
  std::snprintf(
    text, sizeof(text), "%.*f %s", unit > 0 && bytes < 100.0 ? 1 : 0, bytes, units[unit]);
  return text;
}

std::string GetParent(const std::string& name)
{
  const std::string parent = ToName(ToPath(name).parent_path());
  return parent.empty() ? "." : parent;
}
}
