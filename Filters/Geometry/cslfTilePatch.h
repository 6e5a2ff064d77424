// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Triangles for some texels of a tile.
 */
#ifndef cslfTilePatch_h
#define cslfTilePatch_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfDepthSurfaces.h"
#include "cslfDepthViews.h"
#include "cslfSurfaceMesh.h"

#include <vector>

namespace cslf
{
/// Makes a square of two triangles for each marked texel. Squares of one surface share their
/// corners. Corners run counterclockwise as seen from the viewpoint. The outlines of surfaces lie
/// half a texel beyond the centres of their texels, or nearer where other viewpoints see that they
/// end before. The mesh is in mesh space.
VTKCSLF_EXPORT SurfaceMesh MakePatch(
  const DepthViews& views, int view, const DepthSurfaces& surfaces, const std::vector<char>& marks);
}

#endif
