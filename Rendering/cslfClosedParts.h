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
/// Moves the triangles of closed parts to the beginning, counterclockwise from outside, and returns
/// the number of their corners. Points in the same place count as one.
std::size_t SortClosedParts(
  const std::vector<glm::vec3>& points, std::vector<std::uint32_t>& corners);
}

#endif
