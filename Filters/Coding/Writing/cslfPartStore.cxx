// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPartStore.h"

#include "Files/cslfFileSystem.h"
#include "cslfPart.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <system_error>
#include <vector>

namespace cslf
{
namespace
{
constexpr const char* ManifestName = "manifest.json";
constexpr const char* CacheName = "radiance.cache";
constexpr const char* TrialsName = "trials.json";

bool IsPart(const std::string& name)
{
  static const std::regex pattern("group-[0-9]+-([a-z-]+)\\.part");
  std::smatch match;
  return std::regex_match(name, match, pattern) && RoleOfName(match[1]);
}

bool IsOurs(const std::string& name)
{
  return IsPart(name) || name == ManifestName || name == CacheName || name == TrialsName;
}

template <typename Bytes>
Bytes ReadBytes(const std::string& name)
{
  std::ifstream file(ToPath(name), std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

std::vector<std::uint8_t> ReadHead(const std::string& name)
{
  std::vector<std::uint8_t> head(PartHeadSize);
  std::ifstream file(ToPath(name), std::ios::binary);
  file.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}
}

PartStore::PartStore(const std::string& fileName)
  : Work(fileName,
      [preview = GetPreviewName(ResolveTarget(fileName))](const std::string& name)
      { return IsOurs(name) || name == preview; })
  , Preview(GetPreviewName(this->Work.GetTarget()))
{
}

PartStore::~PartStore()
{
  if (!this->Work.IsReserved() || (!this->Opened && this->Work.IsKnown()))
  {
    return;
  }
  if (!this->Opened)
  {
    this->Work.Remove(CacheName);
  }
  // A manifest alone is useless.
  const std::vector<std::string> kept = this->Work.FindKept();
  if (kept.size() == 1 && kept.front() == ManifestName)
  {
    this->Work.Remove(ManifestName);
  }
}

bool PartStore::Reserve(bool keep, std::string& error)
{
  if (!this->Work.Reserve(error))
  {
    return false;
  }
  if (!keep && !this->Opened)
  {
    this->Work.Remove(CacheName);
  }
  return true;
}

bool PartStore::Open(const std::string& manifest, bool keep, bool& discarded, std::string& error)
{
  discarded = false;
  if (!this->Work.IsReserved() && !this->Reserve(keep, error))
  {
    return false;
  }
  this->Opened = true;
  this->Manifest = NumberManifest(manifest);
  const bool isSame = keep && ReadBytes<std::string>(this->Work.GetName(ManifestName)) == manifest;
  if (!keep)
  {
    // Otherwise they would count as this run's parts if it is interrupted.
    for (const std::string& name : this->Work.FindKept())
    {
      if (IsPart(name))
      {
        this->Work.Remove(name);
      }
    }
  }
  discarded = this->DropOthers();
  if (isSame)
  {
    return true;
  }
  this->Work.Remove(TrialsName);
  this->DropPreview();
  return this->Work.Write(ManifestName, manifest.data(), manifest.size(), error);
}

/// Removes parts that were made under another manifest. Returns whether there were any.
bool PartStore::DropOthers() const
{
  bool dropped = false;
  for (const std::string& name : this->Work.FindKept())
  {
    std::uint32_t manifest = 0;
    if (IsPart(name) && ReadManifest(ReadHead(this->Work.GetName(name)), manifest) &&
      manifest != this->Manifest)
    {
      this->Work.Remove(name);
      dropped = true;
    }
  }
  return dropped;
}

bool PartStore::Has(TrackRole role, int group) const
{
  std::error_code ignored;
  return std::filesystem::exists(ToPath(this->Work.GetName(GetPartName(role, group))), ignored);
}

bool PartStore::Write(TrackRole role, int group, const CodedGroup& part, std::string& error) const
{
  const std::vector<std::uint8_t> bytes = PackPart(part, this->Manifest);
  return this->Work.Write(GetPartName(role, group), bytes.data(), bytes.size(), error);
}

bool PartStore::Read(TrackRole role, int group, CodedGroup& part, std::string& error) const
{
  const std::string name = this->Work.GetName(GetPartName(role, group));
  if (!UnpackPart(ReadBytes<std::vector<std::uint8_t>>(name), this->Manifest, part))
  {
    error = "the part " + name + " is missing or damaged";
    return false;
  }
  return true;
}

bool PartStore::WriteTrials(const std::string& text, std::string& error) const
{
  return this->Work.Write(TrialsName, text.data(), text.size(), error);
}

std::string PartStore::ReadTrials() const
{
  return ReadBytes<std::string>(this->Work.GetName(TrialsName));
}

void PartStore::DropTrials() const
{
  this->Work.Remove(TrialsName);
}

std::string PartStore::GetUnfinishedPreview() const
{
  return this->Work.GetScratchName(this->Preview);
}

bool PartStore::PublishPreview(std::string& error) const
{
  return Rename(this->GetUnfinishedPreview(), this->Work.GetName(this->Preview), error);
}

void PartStore::DropPreview() const
{
  this->Work.Remove(this->Preview);
  RemoveFile(this->GetUnfinishedPreview());
}

PersistentFile PartStore::GetCacheFile() const
{
  return { this->Work.GetScratchName(CacheName), this->Work.GetName(CacheName) };
}

std::string PartStore::GetWholeName() const
{
  return this->Work.GetScratchName(ToName(ToPath(this->Work.GetTarget()).filename()));
}

bool PartStore::Publish(bool replaces, std::string& warning, std::string& error)
{
  if (!PublishFile(this->GetWholeName(), this->Work.GetTarget(), error, replaces))
  {
    return false;
  }
  this->Work.Close(warning);
  return true;
}

std::string PartStore::GetPartName(TrackRole role, int group)
{
  return "group-" + std::to_string(group) + "-" + NameOfRole(role) + ".part";
}
}
