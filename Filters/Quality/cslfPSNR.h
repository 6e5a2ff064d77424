// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The peak signal-to-noise ratio.
 */
#ifndef cslfPSNR_h
#define cslfPSNR_h

#include <algorithm>
#include <cmath>

namespace cslf
{
/// 10 log10(peak^2 / meanSquare) in dB, at most `cap`: 20 log10(peak / d) for a constant
/// difference d.
/// The largest value of a byte, and the PSNR in dB that is reported for equal colours.
constexpr double MaximumLevel = 255.0;
constexpr double MaximumPSNR = 100.0;

inline double PSNR(double meanSquare, double peak, double cap)
{
  return meanSquare > 0.0 ? std::min(cap, 10.0 * std::log10(peak * peak / meanSquare)) : cap;
}
}

#endif
