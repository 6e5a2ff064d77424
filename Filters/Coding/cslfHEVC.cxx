// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfHEVC.h"

#include <zlib.h>

namespace cslf
{
namespace
{
/// The sizes of an HEVCDecoderConfigurationRecord's fixed part and where its fields lie.
constexpr std::size_t RecordHeaderSize = 23;
constexpr std::size_t RecordLengthSizeOffset = 21;
constexpr std::size_t RecordArrayCountOffset = 22;

constexpr int FirstParameterSet = 32; // VPS_NUT
constexpr int LastParameterSet = 34;  // PPS_NUT

/// A NAL unit in memory.
struct NALUnit
{
  const std::uint8_t* Data = nullptr;
  std::size_t Size = 0;

  int GetType() const { return (this->Data[0] >> 1) & 0x3f; }
  void AddTo(std::uint32_t& crc) const
  {
    crc = static_cast<std::uint32_t>(::crc32(crc, this->Data, static_cast<uInt>(this->Size)));
  }
};

/// Every NAL unit has a header of two bytes.
constexpr std::size_t NALHeaderSize = 2;

/// A big-endian number.
std::size_t ReadNumber(const std::uint8_t* data, int bytes)
{
  std::size_t number = 0;
  for (int k = 0; k < bytes; ++k)
  {
    number = number << 8 | data[k];
  }
  return number;
}

template <typename Visit>
bool VisitPrefixed(const std::uint8_t* data, std::size_t size, int lengthSize, Visit visit)
{
  std::size_t position = 0;
  while (position < size)
  {
    if (size - position < static_cast<std::size_t>(lengthSize))
    {
      return false;
    }
    const std::size_t length = ReadNumber(data + position, lengthSize);
    position += lengthSize;
    if (length < NALHeaderSize || length > size - position)
    {
      return false;
    }
    visit(NALUnit{ data + position, length });
    position += length;
  }
  return true;
}

/// The offset of the next start code, 00 00 01, or `size`.
std::size_t FindStartCode(const std::uint8_t* data, std::size_t size, std::size_t from)
{
  for (std::size_t k = from; k + 3 <= size; ++k)
  {
    if (data[k] == 0 && data[k + 1] == 0 && data[k + 2] == 1)
    {
      return k;
    }
  }
  return size;
}

template <typename Visit>
bool VisitStartCoded(const std::uint8_t* data, std::size_t size, Visit visit)
{
  std::size_t start = FindStartCode(data, size, 0);
  while (start < size)
  {
    start += 3;
    const std::size_t next = FindStartCode(data, size, start);
    // Zeros before a start code belong to the code: no NAL unit ends with one.
    std::size_t end = next;
    while (end > start && data[end - 1] == 0)
    {
      --end;
    }
    if (end - start < NALHeaderSize)
    {
      return false;
    }
    visit(NALUnit{ data + start, end - start });
    start = next;
  }
  return true;
}

template <typename Visit>
bool VisitRecord(const std::uint8_t* data, std::size_t size, Visit visit)
{
  std::size_t position = RecordHeaderSize;
  for (int array = 0; array < data[RecordArrayCountOffset]; ++array)
  {
    if (size - position < 3)
    {
      return false;
    }
    const std::size_t count = ReadNumber(data + position + 1, 2);
    position += 3;
    for (std::size_t k = 0; k < count; ++k)
    {
      if (size - position < 2)
      {
        return false;
      }
      const std::size_t length = ReadNumber(data + position, 2);
      position += 2;
      if (length < NALHeaderSize || length > size - position)
      {
        return false;
      }
      visit(NALUnit{ data + position, length });
      position += length;
    }
  }
  return true;
}

/// A decoder configuration record begins with its version, annex B with zeros.
bool IsRecord(const std::uint8_t* extradata, std::size_t size)
{
  return size >= RecordHeaderSize && extradata[0] == 1;
}
}

bool FindFraming(const std::uint8_t* extradata, std::size_t size, NALFraming& framing)
{
  if (IsRecord(extradata, size))
  {
    framing.LengthSize = (extradata[RecordLengthSizeOffset] & 3) + 1;
    return true;
  }
  framing.LengthSize = 0;
  return size > 3 && extradata[0] == 0 && extradata[1] == 0;
}

bool AddSlicesToCRC(
  const std::uint8_t* data, std::size_t size, const NALFraming& framing, std::uint32_t& crc)
{
  const auto add = [&crc](const NALUnit& unit)
  {
    if (unit.GetType() < FirstParameterSet)
    {
      unit.AddTo(crc);
    }
  };
  return framing.LengthSize == 0 ? VisitStartCoded(data, size, add)
                                 : VisitPrefixed(data, size, framing.LengthSize, add);
}

bool ComputeParameterSetsCRC(const std::uint8_t* extradata, std::size_t size, std::uint32_t& crc)
{
  crc = 0;
  int found = 0;
  const auto add = [&](const NALUnit& unit)
  {
    const int type = unit.GetType();
    if (type >= FirstParameterSet && type <= LastParameterSet)
    {
      found |= 1 << (type - FirstParameterSet);
      unit.AddTo(crc);
    }
  };
  const bool whole = IsRecord(extradata, size) ? VisitRecord(extradata, size, add)
                                               : VisitStartCoded(extradata, size, add);
  return whole && found == 7;
}
}
