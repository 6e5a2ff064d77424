// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * H.264's data (ITU-T H.264).
 */
#ifndef cslfH264_h
#define cslfH264_h

#include "Coding/cslfNALUnits.h"

namespace cslf
{
class H264Bitstream : public NALBitstream
{
public:
  H264Bitstream();

protected:
  int GetType(const NALUnit& unit) const override;
  bool IsSlice(int type) const override;
  bool IsRecord(const std::uint8_t* data, std::size_t size) const override;
  bool VisitRecord(const std::uint8_t* data, std::size_t size, int& lengthSize,
    const Visitor& visit) const override;
};
}

#endif
