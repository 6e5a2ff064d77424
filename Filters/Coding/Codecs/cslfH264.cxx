// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBitstreams.h"
#include "cslfNALUnits.h"

namespace cslf
{
namespace
{
NALSyntax MakeH264Syntax()
{
  NALSyntax syntax;
  syntax.HeaderSize = 1;
  syntax.TypeShift = 0;
  syntax.TypeMask = 0x1f;
  syntax.FirstSlice = 1;
  syntax.LastSlice = 5;
  syntax.FirstParameterSet = 7; // of a sequence
  syntax.LastParameterSet = 8;  // of a picture
  syntax.Delimiter = 9;
  syntax.Filler = 12;
  syntax.LeastRecordSize = 7;
  syntax.RecordLengthSizeOffset = 4;
  return syntax;
}

class H264Bitstream : public NALBitstream
{
public:
  H264Bitstream()
    : NALBitstream(MakeH264Syntax())
  {
  }

protected:
  bool VisitRecord(const std::uint8_t* data, std::size_t size, const Visitor& visit) const override
  {
    // An AVCDecoderConfigurationRecord contains the sequence parameter sets after a byte with their
    // count in its low bits, then the picture parameter sets after a byte with theirs.
    constexpr std::size_t countOffset = 5;
    std::size_t position = countOffset + 1;
    if (!this->VisitArray(data, size, data[countOffset] & 0x1f, position, visit) ||
      position >= size)
    {
      return false;
    }
    const std::size_t count = data[position];
    ++position;
    return this->VisitArray(data, size, count, position, visit);
  }
};
}

const Bitstream& GetH264Bitstream()
{
  static const H264Bitstream bitstream;
  return bitstream;
}
}
