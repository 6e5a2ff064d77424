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

/// Sets coverage within `tolerance` of 255 or 0 to 255 or 0, clamps colour to coverage, and sets
/// depth, which may be null, to 65535 where nothing is covered.
VTKCSLF_EXPORT void JoinTexels(
  int tolerance, int count, unsigned char* colors, unsigned short* depths);
}

#endif
