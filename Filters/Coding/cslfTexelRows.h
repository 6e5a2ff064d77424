// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Rows of decoded samples of depth and coverage to texels, many at once.
 */
#ifndef cslfTexelRows_h
#define cslfTexelRows_h

#include "vtkCSLFModule.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/// The depth of 16 bits of each sample of 10 or 12 bits: the nearest of as large a share of the
/// largest, or what `curve` has for each sample if it has anything; larger samples count as the
/// largest.
VTKCSLF_EXPORT void SamplesToDepths(const std::uint16_t* samples, int bits,
  const std::vector<unsigned short>& curve, int count, unsigned short* depths);

/// Bytes to the fourth byte of each color.
VTKCSLF_EXPORT void SamplesToCoverage(
  const std::uint8_t* samples, int count, unsigned char* colors);

/// Coverage within `tolerance` of 255 or else of 0 becomes just that, colour is at most coverage,
/// and depth, which may be null, is 65535 where nothing is covered.
VTKCSLF_EXPORT void JoinTexels(
  int tolerance, int count, unsigned char* colors, unsigned short* depths);
}

#endif
