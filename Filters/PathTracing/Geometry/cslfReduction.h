// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reduces surfaces to a number of triangles, whatever that costs.
 */
#ifndef cslfReduction_h
#define cslfReduction_h

#include "cslfSurfaceMesh.h"

#include <cstddef>

namespace cslf
{
/// Removes triangles until there are at most that many: where it moves the surface least, or the
/// same share of each connected part, which only keeps more if there are many small ones. Small
/// parts stay as large, and as thick, as they were. The mesh must be welded.
VTKCSLF_EXPORT void Reduce(SurfaceMesh& mesh, std::size_t most, bool byParts);
}

#endif
