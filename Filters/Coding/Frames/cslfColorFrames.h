// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts colour to video frames and back. Byte colour, 4 bytes per texel, is stored as planar RGB
 * or as Y'CbCr with the matrix of ITU-R BT.709; see cslfColorRows.h. Float colour, linear radiance
 * with associated alpha, goes through the perceptual quantiser and is stored as Y'CbCr with the
 * same matrix, in full range and full resolution.
 */
#ifndef cslfColorFrames_h
#define cslfColorFrames_h

#include "Coding/Codecs/cslfAV.h"
#include "vtkCSLFModule.h"

#include <cstddef>
#include <vector>

namespace cslf
{
/// Fills a writable frame with red, green and blue. Subsampled chroma lies above the even samples
/// of luma (AVCHROMA_LOC_LEFT) and does not mix texels of different tiles, which are `tile` texels
/// wide. The frame's range is narrow if its properties say so.
VTKCSLF_EXPORT void PutColors(const unsigned char* colors, int tile, AVFrame* frame);

/// Sets red, green and blue from a frame of full range and that format. Subsampled chroma lies at
/// AVCHROMA_LOC_LEFT or else at AVCHROMA_LOC_CENTER. Every fourth byte is written, too.
VTKCSLF_EXPORT void TakeColors(const AVFrame* frame, AVPixelFormat format,
  AVChromaLocation location, int tile, unsigned char* colors);

/// The luminance of radiance 1, in cd/m^2.
constexpr double WhiteLuminance = 203.0;

/// The largest luminance that has a signal, in cd/m^2.
constexpr double PeakLuminance = 10000.0;

/// The largest radiance, about 49.26.
constexpr double MaximumRadiance = PeakLuminance / WhiteLuminance;

/// Radiance, clamped to [0,MaximumRadiance], to the signal, from 0 to 1.
VTKCSLF_EXPORT double RadianceToPQ(double radiance);

/// The signal, from 0 to 1, to radiance.
VTKCSLF_EXPORT double PQToRadiance(double signal);

/// Signals as codes of 16 bits.
constexpr int MaximumPQCode = 65535;

/// The code nearest to the signal of a radiance, which may be any number or NaN.
VTKCSLF_EXPORT int RadianceToPQCode(float radiance);

/// The radiance of each code.
VTKCSLF_EXPORT const std::vector<float>& GetCodedRadiances();

/// Whether a frame can store a texel's red, green and blue: neither negative, nor above
/// MaximumRadiance, nor NaN.
bool IsCodable(const float* texel);

/// Fills a writable 4:4:4 frame of more than 8 bits with red, green and blue, from 4 floats per
/// texel.
void PutRadiance(const float* colors, AVPixelFormat format, AVFrame* frame);

/// Sets red, green and blue, of 4 floats per texel, where radiance 1 is a luminance of `white`.
void TakeRadiance(const AVFrame* frame, AVPixelFormat format, double white, float* colors);

/// Converts coverage, in bytes, to alpha.
void TakeCoverage(const AVFrame* frame, float* colors);

/// Combines the channels of a slice. Alpha within `tolerance` of 255 or 0 becomes full or none;
/// without coverage, all alpha is full. Where nothing is covered, colour is 0.
void JoinRadiance(std::size_t texels, bool hasCoverage, int tolerance, float* colors);
}

#endif
