// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGroupStore.h"

#include "Coding/Containers/cslfFileParts.h"
#include "Files/cslfFileSystem.h"

#include <zlib.h>

#include <cstring>
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
/// The first bytes of a packed group, with the version of its layout.
constexpr std::uint32_t Magic = 0x33504643;

bool Unpack(ByteBuffer& buffer, std::uint32_t expected, CodedGroup& coded)
{
  std::uint32_t magic = 0;
  std::uint32_t manifest = 0;
  std::uint32_t covered = 0;
  std::uint32_t frames = 0;
  if (!buffer.Take(magic) || magic != Magic || !buffer.Take(manifest) || manifest != expected ||
    !buffer.Take(coded.CRC) || !buffer.Take(covered) || !buffer.Take(coded.SquaredError) ||
    !buffer.Take(coded.ParameterSets) || !buffer.Take(frames) || frames > MaximumGroupLength)
  {
    return false;
  }
  coded.CoveredFully = covered != 0;
  coded.Frames.resize(frames);
  for (CodedFrame& frame : coded.Frames)
  {
    std::uint32_t index = 0;
    if (!buffer.Take(index) || !buffer.Take(frame.Data))
    {
      return false;
    }
    frame.Index = static_cast<int>(index);
  }
  std::uint32_t checksum = 0;
  return buffer.Take(checksum) &&
    IsExpected(checksum, buffer.GetChecksum(buffer.GetBytes().size() - sizeof(checksum)));
}
}

template <typename Number>
void ByteBuffer::PutNumber(Number number)
{
  const auto* data = reinterpret_cast<const std::uint8_t*>(&number);
  this->Bytes.insert(this->Bytes.end(), data, data + sizeof(number));
}

template <typename Number>
bool ByteBuffer::TakeNumber(Number& number)
{
  if (this->Bytes.size() - this->Position < sizeof(number))
  {
    return false;
  }
  std::memcpy(&number, this->Bytes.data() + this->Position, sizeof(number));
  this->Position += sizeof(number);
  return true;
}

void ByteBuffer::Put(std::uint32_t number)
{
  this->PutNumber(number);
}

void ByteBuffer::Put(double number)
{
  this->PutNumber(number);
}

void ByteBuffer::Put(const std::vector<std::uint8_t>& data)
{
  this->Put(static_cast<std::uint32_t>(data.size()));
  this->Bytes.insert(this->Bytes.end(), data.begin(), data.end());
}

bool ByteBuffer::Take(std::uint32_t& number)
{
  return this->TakeNumber(number);
}

bool ByteBuffer::Take(double& number)
{
  return this->TakeNumber(number);
}

bool ByteBuffer::Take(std::vector<std::uint8_t>& data)
{
  std::uint32_t size = 0;
  if (!this->Take(size) || size > this->Bytes.size() - this->Position)
  {
    return false;
  }
  const auto begin = this->Bytes.begin() + static_cast<std::ptrdiff_t>(this->Position);
  data.assign(begin, begin + size);
  this->Position += size;
  return true;
}

std::uint32_t ByteBuffer::GetChecksum(std::size_t size) const
{
  return static_cast<std::uint32_t>(::crc32(0, this->Bytes.data(), static_cast<uInt>(size)));
}

std::uint32_t NumberManifest(const std::string& text)
{
  const auto* bytes = reinterpret_cast<const Bytef*>(text.data());
  return static_cast<std::uint32_t>(::crc32(0, bytes, static_cast<uInt>(text.size())));
}

std::vector<std::uint8_t> PackGroup(const CodedGroup& coded, std::uint32_t manifest)
{
  ByteBuffer buffer;
  buffer.Put(Magic);
  buffer.Put(manifest);
  buffer.Put(coded.CRC);
  buffer.Put(coded.CoveredFully ? 1u : 0u);
  buffer.Put(coded.SquaredError);
  buffer.Put(coded.ParameterSets);
  buffer.Put(static_cast<std::uint32_t>(coded.Frames.size()));
  for (const CodedFrame& frame : coded.Frames)
  {
    buffer.Put(static_cast<std::uint32_t>(frame.Index));
    buffer.Put(frame.Data);
  }
  buffer.Put(buffer.GetChecksum(buffer.GetBytes().size()));
  return buffer.GetBytes();
}

bool UnpackGroup(std::vector<std::uint8_t> bytes, std::uint32_t manifest, CodedGroup& coded)
{
  ByteBuffer buffer(std::move(bytes));
  coded = CodedGroup();
  return Unpack(buffer, manifest, coded);
}

bool ReadManifest(const std::vector<std::uint8_t>& bytes, std::uint32_t& manifest)
{
  ByteBuffer buffer(bytes);
  std::uint32_t magic = 0;
  return buffer.Take(magic) && magic == Magic && buffer.Take(manifest);
}

namespace
{
constexpr const char* ManifestName = "manifest.json";
constexpr const char* CacheName = "radiance.cache";
constexpr const char* TrialsName = "trials.json";

bool IsGroup(const std::string& name)
{
  static const std::regex pattern("group-[0-9]+-([a-z0-9-]+)\\.part");
  std::smatch match;
  return std::regex_match(name, match, pattern) && RoleOfName(match[1]);
}

bool IsOurs(const std::string& name)
{
  return IsGroup(name) || name == ManifestName || name == CacheName || name == TrialsName;
}

template <typename Bytes>
Bytes ReadBytes(const std::string& name)
{
  std::ifstream file(ToPath(name), std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

std::vector<std::uint8_t> ReadHead(const std::string& name)
{
  std::vector<std::uint8_t> head(GroupHeadSize);
  std::ifstream file(ToPath(name), std::ios::binary);
  file.read(reinterpret_cast<char*>(head.data()), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head;
}
}

GroupStore::GroupStore(const std::string& fileName)
  : Work(fileName,
      [preview = GetPreviewName(ResolveTarget(fileName))](const std::string& name)
      { return IsOurs(name) || name == preview; })
  , Preview(GetPreviewName(this->Work.GetTarget()))
{
}

GroupStore::~GroupStore()
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

bool GroupStore::Reserve(bool keep, std::string& error)
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

bool GroupStore::Open(const std::string& manifest, bool keep, bool& discarded, std::string& error)
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
    // Otherwise they would count as this run's groups if it is interrupted.
    for (const std::string& name : this->Work.FindKept())
    {
      if (IsGroup(name))
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

/// Removes groups that were made under another manifest. Returns whether there were any.
bool GroupStore::DropOthers() const
{
  bool dropped = false;
  for (const std::string& name : this->Work.FindKept())
  {
    std::uint32_t manifest = 0;
    if (IsGroup(name) && ReadManifest(ReadHead(this->Work.GetName(name)), manifest) &&
      manifest != this->Manifest)
    {
      this->Work.Remove(name);
      dropped = true;
    }
  }
  return dropped;
}

bool GroupStore::Has(TrackRole role, int group) const
{
  std::error_code ignored;
  return std::filesystem::exists(ToPath(this->Work.GetName(GetGroupName(role, group))), ignored);
}

bool GroupStore::Write(TrackRole role, int group, const CodedGroup& coded, std::string& error) const
{
  const std::vector<std::uint8_t> bytes = PackGroup(coded, this->Manifest);
  return this->Work.Write(GetGroupName(role, group), bytes.data(), bytes.size(), error);
}

bool GroupStore::Read(TrackRole role, int group, CodedGroup& coded, std::string& error) const
{
  const std::string name = this->Work.GetName(GetGroupName(role, group));
  if (!UnpackGroup(ReadBytes<std::vector<std::uint8_t>>(name), this->Manifest, coded))
  {
    error = "the part " + name + " is missing or damaged";
    return false;
  }
  return true;
}

bool GroupStore::WriteTrials(const std::string& text, std::string& error) const
{
  return this->Work.Write(TrialsName, text.data(), text.size(), error);
}

std::string GroupStore::ReadTrials() const
{
  return ReadBytes<std::string>(this->Work.GetName(TrialsName));
}

void GroupStore::DropTrials() const
{
  this->Work.Remove(TrialsName);
}

std::string GroupStore::GetUnfinishedPreview() const
{
  return this->Work.GetScratchName(this->Preview);
}

bool GroupStore::PublishPreview(std::string& error) const
{
  return Rename(this->GetUnfinishedPreview(), this->Work.GetName(this->Preview), error);
}

void GroupStore::DropPreview() const
{
  this->Work.Remove(this->Preview);
  RemoveFile(this->GetUnfinishedPreview());
}

PersistentFile GroupStore::GetCacheFile() const
{
  return { this->Work.GetScratchName(CacheName), this->Work.GetName(CacheName) };
}

std::string GroupStore::GetWholeName() const
{
  return this->Work.GetScratchName(ToName(ToPath(this->Work.GetTarget()).filename()));
}

bool GroupStore::Publish(bool replaces, std::string& warning, std::string& error)
{
  if (!PublishFile(this->GetWholeName(), this->Work.GetTarget(), error, replaces))
  {
    return false;
  }
  this->Work.Close(warning);
  return true;
}

std::string GroupStore::GetGroupName(TrackRole role, int group)
{
  return "group-" + std::to_string(group) + "-" + NameOfRole(role) + ".part";
}
}
