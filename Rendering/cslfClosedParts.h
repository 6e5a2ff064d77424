// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The closed parts of a mesh, of which nobody outside sees the back.
 */
#ifndef cslfClosedParts_h
#define cslfClosedParts_h

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
struct ClosedParts
{
  std::size_t Corners = 0;    ///< their number
  std::vector<bool> IsTurned; ///< of each point, whether the corners of its part were clockwise
};

/// Moves the triangles of closed parts to the beginning, counterclockwise from outside. Points in
/// the same place count as one.
ClosedParts SortClosedParts(
  const std::vector<glm::vec3>& points, std::vector<std::uint32_t>& corners);
}

#endif
