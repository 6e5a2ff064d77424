// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reduces surfaces to a number of triangles, whatever that costs.
 */
#ifndef cslfReduction_h
#define cslfReduction_h

#include "cslfSurfaceError.h"
#include "cslfSurfaceMesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace cslf
{
/// Removes triangles until there are at most that many: where it moves the surface least, or the
/// same share of each connected part, which only keeps more if there are many small ones. Small
/// parts stay as large, and as thick, as they were. The mesh must be welded.
VTKCSLF_EXPORT void Reduce(SurfaceMesh& mesh, std::size_t most, bool byParts);

/// The better of the two ways, judged by how far points of the original surface lie from the result
/// if at most `lost`, or else are lost. Returns that. Throws Aborted.
VTKCSLF_EXPORT SurfaceError ReduceWell(SurfaceMesh& mesh, std::size_t most,
  const std::vector<glm::vec3>& points, double lost, const Progress& progress);
}

#endif
