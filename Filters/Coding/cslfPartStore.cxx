// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfPartStore.h"

#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace cslf
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* PartPrefix = "group-";
constexpr const char* PartSuffix = ".part";
constexpr const char* UnfinishedSuffix = ".unfinished";
constexpr const char* WholeName = "whole";

/// The first bytes of a part, with the version of its layout.
constexpr std::uint32_t Magic = 0x31504643;

/// Numbers and bytes one after the other.
class Buffer
{
public:
  std::vector<std::uint8_t> Bytes;

  void Put(std::uint32_t number)
  {
    const auto* data = reinterpret_cast<const std::uint8_t*>(&number);
    this->Bytes.insert(this->Bytes.end(), data, data + sizeof(number));
  }
  void Put(const std::vector<std::uint8_t>& data)
  {
    this->Put(static_cast<std::uint32_t>(data.size()));
    this->Bytes.insert(this->Bytes.end(), data.begin(), data.end());
  }
  bool Take(std::uint32_t& number)
  {
    if (this->Bytes.size() - this->Position < sizeof(number))
    {
      return false;
    }
    std::memcpy(&number, this->Bytes.data() + this->Position, sizeof(number));
    this->Position += sizeof(number);
    return true;
  }
  bool Take(std::vector<std::uint8_t>& data)
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
  std::uint32_t GetChecksum(std::size_t size) const
  {
    return static_cast<std::uint32_t>(::crc32(0, this->Bytes.data(), static_cast<uInt>(size)));
  }

private:
  std::size_t Position = 0;
};

Buffer Pack(const CodedGroup& part)
{
  Buffer buffer;
  buffer.Put(Magic);
  buffer.Put(part.CRC);
  buffer.Put(part.CoveredFully ? 1u : 0u);
  buffer.Put(part.ParameterSets);
  buffer.Put(static_cast<std::uint32_t>(part.Frames.size()));
  for (const CodedFrame& frame : part.Frames)
  {
    buffer.Put(static_cast<std::uint32_t>(frame.Index));
    buffer.Put(frame.Data);
  }
  buffer.Put(buffer.GetChecksum(buffer.Bytes.size()));
  return buffer;
}

bool Unpack(Buffer& buffer, CodedGroup& part)
{
  std::uint32_t magic = 0;
  std::uint32_t covered = 0;
  std::uint32_t frames = 0;
  if (!buffer.Take(magic) || magic != Magic || !buffer.Take(part.CRC) || !buffer.Take(covered) ||
    !buffer.Take(part.ParameterSets) || !buffer.Take(frames) || frames > MaximumGroupLength)
  {
    return false;
  }
  part.CoveredFully = covered != 0;
  part.Frames.resize(frames);
  for (CodedFrame& frame : part.Frames)
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
    checksum == buffer.GetChecksum(buffer.Bytes.size() - sizeof(checksum));
}
}

PartStore::PartStore(const std::string& fileName)
  : FileName(fileName)
  , Folder(fileName + ".partial")
{
}

PartStore::~PartStore()
{
  if (this->Created)
  {
    this->Clear();
    std::error_code ignored;
    fs::remove(this->Folder, ignored);
  }
}

bool PartStore::Create(std::string& error)
{
  std::error_code code;
  std::error_code ignored;
  if (!fs::create_directory(this->Folder, code) && !fs::is_directory(this->Folder, ignored))
  {
    error = "cannot make the folder " + this->Folder + ": " + code.message();
    return false;
  }
  this->Created = true;
  this->Clear();
  return true;
}

bool PartStore::Write(TrackRole role, int group, const CodedGroup& part, std::string& error) const
{
  const std::string name = this->GetPartName(role, group);
  const std::string unfinished = name + UnfinishedSuffix;
  const Buffer buffer = Pack(part);
  {
    std::ofstream file(unfinished, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(buffer.Bytes.data()),
      static_cast<std::streamsize>(buffer.Bytes.size()));
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
  std::ifstream file(name, std::ios::binary);
  Buffer buffer;
  buffer.Bytes.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  part = CodedGroup();
  if (!Unpack(buffer, part))
  {
    error = "the part " + name + " is missing or damaged";
    return false;
  }
  return true;
}

std::string PartStore::GetWholeName() const
{
  return (fs::path(this->Folder) / WholeName).string() +
    fs::path(this->FileName).extension().string();
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

std::string PartStore::GetPartName(TrackRole role, int group) const
{
  const std::string name = PartPrefix + std::to_string(group) + "-" + NameOfRole(role) + PartSuffix;
  return (fs::path(this->Folder) / name).string();
}

void PartStore::Clear() const
{
  std::error_code ignored;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(this->Folder, ignored))
  {
    const std::string name = entry.path().filename().string();
    const std::string whole = WholeName;
    if (name.rfind(PartPrefix, 0) == 0 || name.rfind(whole + ".", 0) == 0)
    {
      files.push_back(entry.path());
    }
  }
  for (const fs::path& file : files)
  {
    fs::remove(file, ignored);
  }
}
}
