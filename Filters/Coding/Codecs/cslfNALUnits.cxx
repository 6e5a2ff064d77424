// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfNALUnits.h"

#include <zlib.h>

namespace cslf
{
namespace
{
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

std::uint32_t AddTo(std::uint32_t crc, const NALUnit& unit)
{
  return static_cast<std::uint32_t>(::crc32(crc, unit.Data, static_cast<uInt>(unit.Size)));
}
}

int NALBitstream::GetType(const NALUnit& unit) const
{
  return unit.Data[0] >> this->Syntax.TypeShift & this->Syntax.TypeMask;
}

bool NALBitstream::IsSlice(const NALUnit& unit) const
{
  const int type = this->GetType(unit);
  return type >= this->Syntax.FirstSlice && type <= this->Syntax.LastSlice;
}

bool NALBitstream::IsParameterSet(const NALUnit& unit) const
{
  const int type = this->GetType(unit);
  return type >= this->Syntax.FirstParameterSet && type <= this->Syntax.LastParameterSet;
}

bool NALBitstream::IsSkipped(const NALUnit& unit) const
{
  const int type = this->GetType(unit);
  return type == this->Syntax.Delimiter || type == this->Syntax.Filler;
}

bool NALBitstream::VisitUnit(const std::uint8_t* data, std::size_t size, int lengthSize,
  std::size_t& position, const Visitor& visit) const
{
  if (size - position < static_cast<std::size_t>(lengthSize))
  {
    return false;
  }
  const std::size_t length = ReadNumber(data + position, lengthSize);
  position += lengthSize;
  if (length < this->Syntax.HeaderSize || length > size - position)
  {
    return false;
  }
  visit({ data + position, length });
  position += length;
  return true;
}

bool NALBitstream::VisitPrefixed(
  const std::uint8_t* data, std::size_t size, int lengthSize, const Visitor& visit) const
{
  std::size_t position = 0;
  while (position < size)
  {
    if (!this->VisitUnit(data, size, lengthSize, position, visit))
    {
      return false;
    }
  }
  return true;
}

bool NALBitstream::VisitStartCoded(
  const std::uint8_t* data, std::size_t size, const Visitor& visit) const
{
  std::size_t start = FindStartCode(data, size, 0);
  while (start < size)
  {
    start += 3;
    const std::size_t next = FindStartCode(data, size, start);
    // Zeros before a start code belong to it: no NAL unit ends with a zero.
    std::size_t end = next;
    while (end > start && data[end - 1] == 0)
    {
      --end;
    }
    if (end - start < this->Syntax.HeaderSize)
    {
      return false;
    }
    visit({ data + start, end - start });
    start = next;
  }
  return true;
}

bool NALBitstream::VisitArray(const std::uint8_t* data, std::size_t size, std::size_t count,
  std::size_t& position, const Visitor& visit) const
{
  constexpr int lengthSize = 2;
  for (std::size_t k = 0; k < count; ++k)
  {
    if (!this->VisitUnit(data, size, lengthSize, position, visit))
    {
      return false;
    }
  }
  return true;
}

bool NALBitstream::ReadConfiguration(
  const std::uint8_t* data, std::size_t size, Framing& framing) const
{
  framing = {};
  int found = 0;
  const auto add = [&](const NALUnit& unit)
  {
    if (this->IsParameterSet(unit))
    {
      found |= 1 << (this->GetType(unit) - this->Syntax.FirstParameterSet);
      framing.ParameterSetsCRC = AddTo(framing.ParameterSetsCRC, unit);
      framing.ParameterSetCRCs.push_back(AddTo(0, unit));
    }
  };
  const bool isRecord = size >= this->Syntax.LeastRecordSize && data[0] == 1;
  if (!isRecord && !(size > 3 && data[0] == 0 && data[1] == 0))
  {
    return false;
  }
  framing.LengthSize = isRecord ? (data[this->Syntax.RecordLengthSizeOffset] & 3) + 1 : 0;
  const bool isWhole =
    isRecord ? this->VisitRecord(data, size, add) : this->VisitStartCoded(data, size, add);
  const int all = (1 << (this->Syntax.LastParameterSet - this->Syntax.FirstParameterSet + 1)) - 1;
  return isWhole && found == all;
}

bool NALBitstream::AddToCRC(
  const std::uint8_t* data, std::size_t size, const Framing& framing, std::uint32_t& crc) const
{
  bool isOfTrack = true;
  const auto add = [&](const NALUnit& unit)
  {
    if (this->IsSlice(unit))
    {
      crc = AddTo(crc, unit);
    }
    else
    {
      isOfTrack = isOfTrack &&
        (this->IsSkipped(unit) ||
          (this->IsParameterSet(unit) && framing.HasParameterSet(AddTo(0, unit))));
    }
  };
  const bool isWhole = framing.LengthSize == 0
    ? this->VisitStartCoded(data, size, add)
    : this->VisitPrefixed(data, size, framing.LengthSize, add);
  return isWhole && isOfTrack;
}

std::vector<std::uint8_t> NALBitstream::Trim(const std::uint8_t* data, std::size_t size) const
{
  std::vector<std::uint8_t> slices;
  slices.reserve(size);
  const auto add = [&](const NALUnit& unit)
  {
    if (this->IsSlice(unit))
    {
      slices.insert(slices.end(), { 0, 0, 0, 1 });
      slices.insert(slices.end(), unit.Data, unit.Data + unit.Size);
    }
  };
  return this->VisitStartCoded(data, size, add) ? slices : std::vector<std::uint8_t>();
}
}
