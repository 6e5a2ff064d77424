// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfHEVC.h"

namespace cslf
{
namespace
{
/// The size of an HEVCDecoderConfigurationRecord's fixed part and where its fields lie.
constexpr std::size_t RecordHeaderSize = 23;
constexpr std::size_t RecordLengthSizeOffset = 21;
constexpr std::size_t RecordArrayCountOffset = 22;

constexpr std::size_t NALHeaderSize = 2;
constexpr int VideoParameterSet = 32;
constexpr int PictureParameterSet = 34;
}

HEVCBitstream::HEVCBitstream()
  : NALBitstream(NALHeaderSize, VideoParameterSet, PictureParameterSet)
{
}

int HEVCBitstream::GetType(const NALUnit& unit) const
{
  return (unit.Data[0] >> 1) & 0x3f;
}

bool HEVCBitstream::IsSlice(int type) const
{
  return type < VideoParameterSet;
}

bool HEVCBitstream::IsRecord(const std::uint8_t* data, std::size_t size) const
{
  return size >= RecordHeaderSize && data[0] == 1;
}

bool HEVCBitstream::VisitRecord(
  const std::uint8_t* data, std::size_t size, int& lengthSize, const Visitor& visit) const
{
  lengthSize = (data[RecordLengthSizeOffset] & 3) + 1;
  std::size_t position = RecordHeaderSize;
  for (int array = 0; array < data[RecordArrayCountOffset]; ++array)
  {
    if (size - position < 3)
    {
      return false;
    }
    const std::size_t count = data[position + 1] << 8 | data[position + 2];
    position += 3;
    if (!this->VisitArray(data, size, count, position, visit))
    {
      return false;
    }
  }
  return true;
}
}
