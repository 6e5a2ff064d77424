// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which rays are best traced together: those that start near each other and run alike.
 */
#ifndef cslfRayBin_h
#define cslfRayBin_h

#include <glm/vec3.hpp>

namespace cslf
{
// The scene's bounding sphere is the unit sphere; the cube around it is split into 4 cells along
// each edge. Rays of a bin start in the same cell and run to the same octant.
constexpr int RayBinCount = 4 * 4 * 4 * 8;

/// The bits of a coordinate's cell, two places left free after each. What is not a number is in the
/// first cell.
inline int GetCellBits(float coordinate)
{
  const float place = 2.0f * coordinate + 2.0f;
  const float inside = place > 0.0f ? (place < 3.0f ? place : 3.0f) : 0.0f;
  const int cell = static_cast<int>(inside);
  return (cell & 1) | (cell & 2) << 2;
}

/// In [0,RayBinCount). Bins of an octant follow each other along Morton's curve, so that neighbours
/// in number mostly are so in space.
inline int GetRayBin(const glm::vec3& origin, const glm::vec3& direction)
{
  const int cell = GetCellBits(origin.x) | GetCellBits(origin.y) << 1 | GetCellBits(origin.z) << 2;
  const int octant =
    (direction.x < 0.0f ? 1 : 0) | (direction.y < 0.0f ? 2 : 0) | (direction.z < 0.0f ? 4 : 0);
  return octant << 6 | cell;
}
}

#endif
