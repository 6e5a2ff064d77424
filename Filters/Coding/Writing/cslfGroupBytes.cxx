// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGroupBytes.h"

#include "Coding/Containers/cslfChecksum.h"

#include <zlib.h>

#include <cstring>

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
}
