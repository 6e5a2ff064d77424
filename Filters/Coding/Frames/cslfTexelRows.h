// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts rows of decoded samples of depth and coverage to texels, many at once.
 */
#ifndef cslfTexelRows_h
#define cslfTexelRows_h

#include "vtkCSLFModule.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/// Converts samples of 10 or 12 bits to depth of 16 bits: in proportion and rounded or, if `curve`
/// is not empty, by this table. Larger samples count as the largest.
VTKCSLF_EXPORT void SamplesToDepths(const std::uint16_t* samples, int bits,
  const std::vector<unsigned short>& curve, int count, unsigned short* depths);

/// Copies bytes to the fourth byte of each colour.
VTKCSLF_EXPORT void SamplesToCoverage(
  const std::uint8_t* samples, int count, unsigned char* colors);

/// Sets coverage within `tolerance` of 255 or 0 to 255 or 0, and clamps colour to coverage.
VTKCSLF_EXPORT void JoinTexels(int tolerance, int count, unsigned char* colors);

/// Sets numbers to a value where the fourth component of colours is 0.
template <typename Component>
void FillUncovered(unsigned short fill, int count, const Component* colors, unsigned short* numbers)
{
  for (int k = 0; k < count; ++k)
  {
    numbers[k] = colors[4 * k + 3] == Component(0) ? fill : numbers[k];
  }
}
}

#endif
