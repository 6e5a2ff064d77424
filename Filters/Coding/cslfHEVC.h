// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * HEVC's data (ITU-T H.265).
 */
#ifndef cslfHEVC_h
#define cslfHEVC_h

#include "Coding/cslfNALUnits.h"

namespace cslf
{
class HEVCBitstream : public NALBitstream
{
public:
  HEVCBitstream();

protected:
  int GetType(const NALUnit& unit) const override;
  bool IsSlice(int type) const override;
  bool IsRecord(const std::uint8_t* data, std::size_t size) const override;
  bool VisitRecord(const std::uint8_t* data, std::size_t size, int& lengthSize,
    const Visitor& visit) const override;
};
}

#endif
