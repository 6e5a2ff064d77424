// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Divides the bytes of a file among its tracks.
 */
#ifndef cslfTrackFactors_h
#define cslfTrackFactors_h

#include <algorithm>

namespace cslf
{
/// The rate factor of colour up to which coverage and depth keep their own.
constexpr double FixedFactors = 22.0;

/// The rate factor of coverage or depth in a file whose size or quality is controlled: `own` up to
/// a factor of colour of 22, and higher by the excess above that. So small files do not spend most
/// of their bytes on depth, and good ones keep exact depth.
inline double FindTrackFactor(double own, double color)
{
  return std::min(51.0, own + std::max(0.0, color - FixedFactors));
}
}

#endif
