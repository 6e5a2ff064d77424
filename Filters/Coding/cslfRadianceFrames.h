// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Float colour to video frames and back: linear radiance, associated with alpha, through the
 * perceptual quantiser, as Y'CbCr of ITU-R BT.709's matrix, full range and full resolution.
 */
#ifndef cslfRadianceFrames_h
#define cslfRadianceFrames_h

#include "Coding/cslfAV.h"

#include <cstddef>

namespace cslf
{
/// Whether red, green, blue of a texel are such that a frame can hold them: not negative, not above
/// MaximumRadiance, and numbers.
bool IsCodable(const float* texel);

/// Fills a writable 4:4:4 frame of more than 8 bits with the red, green and blue of 4 floats a
/// texel.
void PutRadiance(const float* colors, AVPixelFormat format, AVFrame* frame);

/// Sets red, green and blue of 4 floats a texel, where radiance 1 is a luminance of `white`.
void TakeRadiance(const AVFrame* frame, AVPixelFormat format, double white, float* colors);

/// Coverage, a byte, becomes alpha.
void TakeCoverage(const AVFrame* frame, float* colors);

/// Joins the channels of a slice: alpha within `tolerance` of 255 (or, without coverage, anything)
/// or else of 0 becomes just that, and colour is 0 and depth, which may be null, 1 where nothing is
/// covered.
void JoinRadiance(
  std::size_t texels, bool hasCoverage, int tolerance, float* colors, unsigned short* depths);
}

#endif
