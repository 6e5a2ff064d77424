// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Divides large triangles.
 */
#ifndef cslfSubdivision_h
#define cslfSubdivision_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfSurfaceMesh.h"

#include <cstddef>

namespace cslf
{
/// Divides triangles until no edge is longer than `longest`, or than a larger length with which
/// there are at most `most` triangles. The surface stays the same, but what its points have can
/// vary within it.
VTKCSLF_EXPORT void Subdivide(SurfaceMesh& mesh, double longest, std::size_t most);
}

#endif
