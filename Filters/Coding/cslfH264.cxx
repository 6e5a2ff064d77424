// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfH264.h"

namespace cslf
{
namespace
{
/// The size of an AVCDecoderConfigurationRecord's fixed part and where its fields lie. Behind it
/// come the sequence parameter sets, a count in a byte, and the picture parameter sets.
constexpr std::size_t RecordHeaderSize = 6;
constexpr std::size_t RecordLengthSizeOffset = 4;
constexpr std::size_t RecordCountOffset = 5;

constexpr std::size_t NALHeaderSize = 1;
constexpr int FirstSlice = 1;
constexpr int LastSlice = 5;
constexpr int SequenceParameterSet = 7;
constexpr int PictureParameterSet = 8;
}

H264Bitstream::H264Bitstream()
  : NALBitstream(NALHeaderSize, SequenceParameterSet, PictureParameterSet)
{
}

int H264Bitstream::GetType(const NALUnit& unit) const
{
  return unit.Data[0] & 0x1f;
}

bool H264Bitstream::IsSlice(int type) const
{
  return type >= FirstSlice && type <= LastSlice;
}

bool H264Bitstream::IsRecord(const std::uint8_t* data, std::size_t size) const
{
  return size > RecordHeaderSize && data[0] == 1;
}

bool H264Bitstream::VisitRecord(
  const std::uint8_t* data, std::size_t size, int& lengthSize, const Visitor& visit) const
{
  lengthSize = (data[RecordLengthSizeOffset] & 3) + 1;
  std::size_t position = RecordHeaderSize;
  if (!this->VisitArray(data, size, data[RecordCountOffset] & 0x1f, position, visit) ||
    position >= size)
  {
    return false;
  }
  const std::size_t count = data[position];
  ++position;
  return this->VisitArray(data, size, count, position, visit);
}
}
