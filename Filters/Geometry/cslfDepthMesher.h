// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Makes a mesh of the surfaces that viewpoints see from their depths.
 */
#ifndef cslfDepthMesher_h
#define cslfDepthMesher_h

#include "vtkCSLFModule.h" // for export macro

#include "Pipeline/cslfPhase.h"
#include "cslfDepthViews.h"
#include "cslfSurfaceMesh.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace cslf
{
/// Goes through the viewpoints, from those in the middle of faces to those between others. Each
/// adds triangles for texels whose surfaces the mesh so far does not have there, unless a later one
/// sees them much better, and around these texels, so that no gaps remain. The result is in
/// mesh space. Viewpoints that come after four million triangles are left out. Throws Aborted.
VTKCSLF_EXPORT SurfaceMesh MeshDepths(const DepthViews& views, const Progress& progress);

/// At most that many points on surfaces, in mesh space, evenly spread over what the viewpoints see.
VTKCSLF_EXPORT std::vector<glm::vec3> SpreadPoints(const DepthViews& views, std::size_t count);
}

#endif
