// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBitstreams.h"
#include "cslfNALUnits.h"

namespace cslf
{
namespace
{
NALSyntax MakeHEVCSyntax()
{
  NALSyntax syntax;
  syntax.HeaderSize = 2;
  syntax.TypeShift = 1;
  syntax.TypeMask = 0x3f;
  syntax.FirstSlice = 0;
  syntax.LastSlice = 31;
  syntax.FirstParameterSet = 32; // of a video
  syntax.LastParameterSet = 34;  // of a picture
  syntax.Delimiter = 35;
  syntax.Filler = 38;
  syntax.LeastRecordSize = 23;
  syntax.RecordLengthSizeOffset = 21;
  return syntax;
}

class HEVCBitstream : public NALBitstream
{
public:
  HEVCBitstream()
    : NALBitstream(MakeHEVCSyntax())
  {
  }

protected:
  bool VisitRecord(const std::uint8_t* data, std::size_t size, const Visitor& visit) const override
  {
    // The fixed part of an HEVCDecoderConfigurationRecord ends with the number of arrays that
    // follow. Each array is a type, a count in two bytes, and the units.
    std::size_t position = MakeHEVCSyntax().LeastRecordSize;
    for (int array = data[position - 1]; array > 0; --array)
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
};
}

const Bitstream& GetHEVCBitstream()
{
  static const HEVCBitstream bitstream;
  return bitstream;
}
}
