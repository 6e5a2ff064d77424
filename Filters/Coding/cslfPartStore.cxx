// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfPartStore.h"

#include "Coding/cslfPart.h"
#include "cslfUnfinished.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <system_error>

namespace cslf
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* PartPrefix = "group-";
constexpr const char* PartSuffix = ".part";
constexpr const char* WholeName = "whole";
constexpr const char* ManifestName = "manifest.json";
constexpr const char* CacheName = "radiance.cache";
constexpr const char* TrialsName = "trials.json";
constexpr const char* LockName = "lock";

/// How often the folder may vanish under a new run, each time removed by one that ends.
constexpr int LockAttempts = 100;

bool BeginsWith(const std::string& text, const std::string& prefix)
{
  return text.rfind(prefix, 0) == 0;
}

bool EndsWith(const std::string& text, const std::string& suffix)
{
  return text.size() >= suffix.size() &&
    text.compare(text.size() - suffix.size(), suffix.size(), suffix) == 0;
}

std::vector<fs::path> FindFiles(
  const std::string& folder, const std::function<bool(const std::string&)>& isWanted)
{
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
  {
    if (isWanted(entry.path().filename().string()))
    {
      files.push_back(entry.path());
    }
  }
  return files;
}

void Remove(const std::vector<fs::path>& files)
{
  std::error_code ignored;
  for (const fs::path& file : files)
  {
    fs::remove(file, ignored);
  }
}

template <typename Bytes>
Bytes ReadBytes(const std::string& name)
{
  std::ifstream file(name, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

bool IsPart(const std::string& name)
{
  return BeginsWith(name, PartPrefix) && EndsWith(name, PartSuffix);
}

/// What a run that was killed left half-written.
bool IsUnfinished(const std::string& name)
{
  return (BeginsWith(name, PartPrefix) && EndsWith(name, UnfinishedSuffix)) ||
    name == std::string(ManifestName) + UnfinishedSuffix ||
    name == std::string(CacheName) + UnfinishedSuffix ||
    name == std::string(TrialsName) + UnfinishedSuffix ||
    BeginsWith(name, std::string(WholeName) + ".");
}
}

PartStore::PartStore(const std::string& fileName)
  : FileName(fileName)
  , Folder(fileName + ".partial")
{
}

PartStore::~PartStore()
{
  if (this->Opened || this->IsNew)
  {
    this->RemoveUnfinished();
    this->RemoveCache();
    this->RemoveParts();
  }
  if (this->Reserved)
  {
    // The lock goes last: as long as its file is there, nobody else touches the folder.
    Remove({ this->GetName(LockName) });
    std::error_code ignored;
    fs::remove(this->Folder, ignored);
  }
}

bool PartStore::Lock(std::string& error)
{
  for (int attempt = 0; attempt < LockAttempts; ++attempt)
  {
    std::error_code code;
    std::error_code ignored;
    this->IsNew = fs::create_directory(this->Folder, code);
    if (!this->IsNew && !fs::is_directory(this->Folder, ignored))
    {
      error = "cannot make the folder " + this->Folder + ": " + code.message();
      return false;
    }
    const FileLock::Outcome outcome = this->Holder.Acquire(this->GetName(LockName), error);
    if (outcome == FileLock::Outcome::Locked)
    {
      return true;
    }
    if (!error.empty())
    {
      return false;
    }
    if (outcome == FileLock::Outcome::Busy)
    {
      break;
    }
  }
  error = "another process is writing it (it holds " + this->GetName(LockName) + ")";
  return false;
}

bool PartStore::Reserve(bool keep, std::string& error)
{
  if (this->Reserved)
  {
    return true;
  }
  if (!this->Lock(error))
  {
    this->IsNew = false;
    return false;
  }
  this->Reserved = true;
  this->RemoveUnfinished();
  if (!keep)
  {
    this->RemoveCache();
  }
  return true;
}

bool PartStore::Open(const std::string& manifest, bool keep, bool& discarded, std::string& error)
{
  discarded = false;
  if (!this->Reserve(keep, error))
  {
    return false;
  }
  this->Opened = true;
  const std::string name = this->GetName(ManifestName);
  if (keep && ReadBytes<std::string>(name) == manifest)
  {
    return true;
  }
  discarded = keep && this->CountParts() > 0;
  this->RemoveParts();
  return this->WriteWhole(name, manifest.data(), manifest.size(), error);
}

bool PartStore::Has(TrackRole role, int group) const
{
  std::error_code ignored;
  return fs::exists(this->GetPartName(role, group), ignored);
}

bool PartStore::Write(TrackRole role, int group, const CodedGroup& part, std::string& error) const
{
  const std::vector<std::uint8_t> bytes = PackPart(part);
  return this->WriteWhole(this->GetPartName(role, group), bytes.data(), bytes.size(), error);
}

bool PartStore::WriteWhole(
  const std::string& name, const void* data, std::size_t size, std::string& error) const
{
  const std::string unfinished = name + UnfinishedSuffix;
  {
    std::ofstream file(unfinished, std::ios::binary | std::ios::trunc);
    file.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    file.close();
    if (!file)
    {
      error = "cannot write " + unfinished;
      return false;
    }
  }
  std::error_code code;
  fs::rename(unfinished, name, code);
  if (code)
  {
    error = "cannot rename " + unfinished + ": " + code.message();
    return false;
  }
  return true;
}

bool PartStore::Read(TrackRole role, int group, CodedGroup& part, std::string& error) const
{
  const std::string name = this->GetPartName(role, group);
  if (!UnpackPart(ReadBytes<std::vector<std::uint8_t>>(name), part))
  {
    error = "the part " + name + " is missing or damaged";
    return false;
  }
  return true;
}

bool PartStore::WriteTrials(const std::string& text, std::string& error) const
{
  return this->WriteWhole(this->GetName(TrialsName), text.data(), text.size(), error);
}

std::string PartStore::ReadTrials() const
{
  return ReadBytes<std::string>(this->GetName(TrialsName));
}

std::string PartStore::GetCacheName() const
{
  return this->GetName(CacheName);
}

std::string PartStore::GetWholeName() const
{
  return this->GetName(WholeName) + fs::path(this->FileName).extension().string();
}

bool PartStore::Publish(std::string& error) const
{
  std::error_code code;
  fs::rename(this->GetWholeName(), this->FileName, code);
  if (code)
  {
    error = "cannot rename the finished file to " + this->FileName + ": " + code.message();
    return false;
  }
  return true;
}

std::string PartStore::GetName(const std::string& name) const
{
  return (fs::path(this->Folder) / name).string();
}

std::string PartStore::GetPartName(TrackRole role, int group) const
{
  return this->GetName(PartPrefix + std::to_string(group) + "-" + NameOfRole(role) + PartSuffix);
}

int PartStore::CountParts() const
{
  return static_cast<int>(FindFiles(this->Folder, IsPart).size());
}

void PartStore::RemoveCache() const
{
  Remove({ this->GetCacheName() });
}

void PartStore::RemoveUnfinished() const
{
  Remove(FindFiles(this->Folder, IsUnfinished));
}

void PartStore::RemoveParts() const
{
  // The manifest goes last: it is what the parts that are left are trusted by.
  Remove(FindFiles(this->Folder, IsPart));
  Remove({ this->GetName(TrialsName) });
  Remove({ this->GetName(ManifestName) });
}
}
