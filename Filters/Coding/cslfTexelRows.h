// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Rows of decoded video samples to texels, many at once.
 */
#ifndef cslfTexelRows_h
#define cslfTexelRows_h

#include "vtkCSLFModule.h"

#include <cstdint>

namespace cslf
{
/// A row of Y'CbCr samples at full resolution, one byte each, or two for more than 8 bits.
struct YCbCrRow
{
  const std::uint8_t* Luma = nullptr;
  const std::uint8_t* Blue = nullptr; ///< Cb
  const std::uint8_t* Red = nullptr;  ///< Cr
};

/// Y'CbCr of ITU-R BT.709's matrix, full range, 8 to 12 bits a sample, to the nearest red, green
/// and blue of 8 bits, 4 bytes a texel. The fourth byte stays as it is.
VTKCSLF_EXPORT void YCbCrToColors(const YCbCrRow& row, int bits, int count, unsigned char* colors);

/// The depth of 16 bits of each sample of 10 or 12 bits: the nearest of as large a share of the
/// largest, or by the curve of cslfDepthCurve.h; larger samples count as the largest.
VTKCSLF_EXPORT void SamplesToDepths(
  const std::uint16_t* samples, int bits, bool isCurved, int count, unsigned short* depths);

/// Bytes to the fourth byte of each color.
VTKCSLF_EXPORT void SamplesToCoverage(
  const std::uint8_t* samples, int count, unsigned char* colors);

/// Coverage within `tolerance` of 255 or else of 0 becomes just that, colour is at most coverage,
/// and depth, which may be null, is 65535 where nothing is covered.
VTKCSLF_EXPORT void JoinTexels(
  int tolerance, int count, unsigned char* colors, unsigned short* depths);
}

#endif
