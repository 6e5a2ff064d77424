// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Whether texels of a viewpoint see the same surface.
 */
#ifndef cslfSameSurface_h
#define cslfSameSurface_h

#include <algorithm>
#include <cmath>

namespace cslf
{
/// Inverse depths of one surface differ by at most this share, plus the other one for each texel
/// between.
constexpr double SameSurface = 0.02;
constexpr double SameSurfacePerTexel = 0.01;

/// Whether two depths in [0,1] belong to one surface. `distance` is in texels.
inline bool AreOnOneSurface(double depth, double other, double distance)
{
  constexpr double least = 1.0 / 65535.0;
  return std::abs(other / std::max(depth, least) - 1.0) <=
    SameSurface + SameSurfacePerTexel * distance;
}
}

#endif
