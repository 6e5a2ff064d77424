// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Rows of red, green and blue to rows of Y'CbCr samples and back, many at once: the matrix of ITU-R
 * BT.709 in integers, so that every processor gives the same. Documentation/FileFormat.md has the
 * formulas. Samples have one byte, or two for more than 8 bits, in the machine's order.
 */
#ifndef cslfColorRows_h
#define cslfColorRows_h

#include "vtkCSLFModule.h"

#include <cstdint>

namespace cslf
{
/// What a sample of each plane adds to each colour.
struct ColorWeights
{
  int Luma;
  int RedOfRed; ///< Cr's
  int GreenOfRed;
  int GreenOfBlue; ///< Cb's
  int BlueOfBlue;
  int Middle; ///< the sample that stands for no chroma
};

/// The weights of samples of so many bits, in units of 2^-fractionBits of colours from 0 to `peak`;
/// chroma's of samples that are `chromaScale` times as large.
VTKCSLF_EXPORT ColorWeights MakeColorWeights(
  int bits, int peak, int fractionBits, int chromaScale = 1);

enum class SamplePlane
{
  Luma,
  Blue, ///< Cb
  Red   ///< Cr
};

/// How a sample is made: (Red r + Green g + Blue b + Offset) / 2^Shift, rounded down, from 0 to
/// Largest.
struct SampleWeights
{
  int Red;
  int Green;
  int Blue;
  std::int64_t Offset; ///< of which one half rounds to the nearest
  int Shift;
  int Largest;
};

/// The weights of colours from 0 to `peak`, of full range or of the narrow one of ITU-R BT.709.
VTKCSLF_EXPORT SampleWeights MakeSampleWeights(
  SamplePlane plane, int bits, int peak, int fractionBits, bool isFullRange = true);

/// A row of samples at full resolution.
struct YCbCrRow
{
  const std::uint8_t* Luma = nullptr;
  const std::uint8_t* Blue = nullptr; ///< Cb
  const std::uint8_t* Red = nullptr;  ///< Cr
};

/// Y'CbCr of full range to red, green and blue of 8 bits, 4 bytes a texel. The fourth byte becomes
/// 255.
VTKCSLF_EXPORT void YCbCrToColors(const YCbCrRow& row, int bits, int count, unsigned char* colors);

/// Where samples of chroma lie among those of luma in a row, as the shares, of 4, that the samples
/// of luma at even and at odd places take from their own sample of chroma, and not from the
/// neighbour on their side.
struct ChromaSiting
{
  int Even;
  int Odd;
};
constexpr ChromaSiting LeftSiting{ 4, 2 };   ///< above the even ones
constexpr ChromaSiting CenterSiting{ 3, 3 }; ///< between both

/// Chroma of half the resolution becomes that of full resolution, 16 times as large. Each sample is
/// 3 of the row `near` and 1 of the row `far`, which are the same where there are as many rows as
/// of luma. Samples of one tile, `tile` of luma wide, know none of another. `scratch` has room for
/// half a tile and two more.
VTKCSLF_EXPORT void SpreadChroma(const std::uint8_t* near, const std::uint8_t* far, int bits,
  ChromaSiting siting, int tile, int count, std::uint16_t* scratch, std::uint16_t* chroma);

/// Y'CbCr with chroma as SpreadChroma makes it, likewise.
VTKCSLF_EXPORT void SpreadToColors(const std::uint8_t* luma, const std::uint16_t* blue,
  const std::uint16_t* red, int bits, int count, unsigned char* colors);

/// Colours, 4 bytes each, to a row of samples.
VTKCSLF_EXPORT void ColorsToSamples(const unsigned char* colors, const SampleWeights& weights,
  int bits, int count, std::uint8_t* samples);

/// Colours of four rows to a row of half as many samples, above the even ones, at full resolution
/// between the second and the third row. The weights, of the rows -1, 5, 5, -1 of 8 and in a row of
/// the same tile -1, 2, 6, 2, -1 of 8, are such that linear interpolation gives nearly the best
/// that it can; where all rows are the same one, so is its result. `count` is that of colours,
/// `scratch` has room for a tile and three more. Weights may have 14 bits of fraction.
VTKCSLF_EXPORT void ColorsToChroma(const unsigned char* const rows[4], const SampleWeights& weights,
  int bits, int tile, int count, int* scratch, std::uint8_t* samples);
}

#endif
