// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Groups rays to be traced together: those with similar origins and directions.
 */
#ifndef cslfRayBin_h
#define cslfRayBin_h

#include <glm/vec3.hpp>

namespace cslf
{
// The scene's bounding sphere is the unit sphere; the cube around it is split into 4 cells along
// each edge. Rays of a bin start in the same cell, with directions in the same octant.
constexpr int RayBinCount = 4 * 4 * 4 * 8;

/// The bits of a coordinate's cell, with two zero bits after each. NaN is in the first cell.
inline int GetCellBits(float coordinate)
{
  const float place = 2.0f * coordinate + 2.0f;
  const float inside = place > 0.0f ? (place < 3.0f ? place : 3.0f) : 0.0f;
  const int cell = static_cast<int>(inside);
  return (cell & 1) | (cell & 2) << 2;
}

/// In [0,RayBinCount). Bins of an octant are ordered along a Morton curve, so that successive bins
/// are mostly neighbours in space.
inline int GetRayBin(const glm::vec3& origin, const glm::vec3& direction)
{
  const int cell = GetCellBits(origin.x) | GetCellBits(origin.y) << 1 | GetCellBits(origin.z) << 2;
  const int octant =
    (direction.x < 0.0f ? 1 : 0) | (direction.y < 0.0f ? 2 : 0) | (direction.z < 0.0f ? 4 : 0);
  return octant << 6 | cell;
}
}

#endif
