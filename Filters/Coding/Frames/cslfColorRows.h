// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts rows of texels to rows of samples and back, many at once: red, green and blue to Y'CbCr,
 * depth, and coverage.
 *
 * The matrix of ITU-R BT.709 is in integers, so that all processors give the same result.
 * Documentation/FileFormat.md has the formulas. Samples have one byte, or two for more than 8 bits,
 * in the machine's order.
 */
#ifndef cslfColorRows_h
#define cslfColorRows_h

#include "vtkCSLFModule.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/// The contribution of a sample of each plane to each colour.
struct ColorWeights
{
  int Luma;
  int RedOfRed; ///< Cr's
  int GreenOfRed;
  int GreenOfBlue; ///< Cb's
  int BlueOfBlue;
  int Middle; ///< the sample that means no chroma
};

/// The weights of samples with `bits` bits, in units of 2^-fractionBits of colours from 0 to
/// `peak`. Those of chroma are for samples that are `chromaScale` times as large.
VTKCSLF_EXPORT ColorWeights MakeColorWeights(
  int bits, int peak, int fractionBits, int chromaScale = 1);

enum class SamplePlane
{
  Luma,
  Blue, ///< Cb
  Red   ///< Cr
};

/// The formula of a sample: (Red r + Green g + Blue b + Offset) / 2^Shift, rounded down, from 0 to
/// Largest.
struct SampleWeights
{
  int Red;
  int Green;
  int Blue;
  std::int64_t Offset; ///< includes one half, for rounding to nearest
  int Shift;
  int Largest;
};

/// The weights of colours from 0 to `peak`, for full range or the narrow range of ITU-R BT.709.
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

/// The position of chroma samples among the luma samples of a row: the share, in quarters, that
/// luma samples at even and at odd places take from their own chroma sample. The rest is from the
/// neighbour on their side.
struct ChromaSiting
{
  int Even;
  int Odd;
};
constexpr ChromaSiting LeftSiting{ 4, 2 };   ///< above the even ones
constexpr ChromaSiting CenterSiting{ 3, 3 }; ///< between both

/// Upsamples chroma from half to full resolution, with samples 16 times as large. Each sample is 3
/// times the row `near` plus the row `far`; both are the same row if there are as many rows as of
/// luma. Tiles, which are `tile` luma samples wide, do not mix. `scratch` has room for half a tile
/// and two more.
VTKCSLF_EXPORT void SpreadChroma(const std::uint8_t* near, const std::uint8_t* far, int bits,
  ChromaSiting siting, int tile, int count, std::uint16_t* scratch, std::uint16_t* chroma);

/// Y'CbCr with chroma from SpreadChroma, likewise.
VTKCSLF_EXPORT void SpreadToColors(const std::uint8_t* luma, const std::uint16_t* blue,
  const std::uint16_t* red, int bits, int count, unsigned char* colors);

/// Colours, 4 bytes each, to a row of samples.
VTKCSLF_EXPORT void ColorsToSamples(const unsigned char* colors, const SampleWeights& weights,
  int bits, int count, std::uint8_t* samples);

/// Converts colours of four rows to a row of half as many samples. They lie above the even ones,
/// between the second and the third row. The weights are -1, 5, 5, -1 of 8 for the rows and -1, 2,
/// 6, 2, -1 of 8 within a row of the same tile, which is nearly optimal for linear interpolation,
/// also if all four rows are the same one. `count` is the number of colours, `scratch` has room for
/// a tile and three more. Weights may have 14 bits of fraction.
VTKCSLF_EXPORT void ColorsToChroma(const unsigned char* const rows[4], const SampleWeights& weights,
  int bits, int tile, int count, int* scratch, std::uint8_t* samples);

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
