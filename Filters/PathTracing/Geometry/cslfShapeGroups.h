// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Small bodies of a scene that are one mesh at many places: balls, sticks and instances.
 */
#ifndef cslfShapeGroups_h
#define cslfShapeGroups_h

#include "vtkCSLFModule.h" // for export macro

#include "Geometry/cslfSurfaceMesh.h"
#include "PathTracing/Scene/cslfScene.h"
#include "Pipeline/cslfPhase.h"
#include "cslfSeenPlaces.h"

#include <cstddef>
#include <vector>

namespace cslf
{
struct ShapeGroupSettings
{
  float Texel = 0.0f;     ///< at the cube's centre, in scene space
  float Tolerance = 0.0f; ///< how far triangles of instances may lie from their surface
  std::size_t MaximumTriangles = 0;
};

struct ShapeGroups
{
  std::vector<InstanceGroup> Groups;
  std::vector<const Mesh*> Others; ///< the meshes that are in no group
};

/// Finds the meshes of which each shape, or each instance, is small and opaque, if there are many.
/// The bodies of which no part is seen are left out. Ends of sticks that lie within other bodies
/// are, too; others are balls. If there are too many balls that are far smaller than texels, larger
/// ones stand for them. There are no groups if they had too many triangles. Throws Aborted.
VTKCSLF_EXPORT ShapeGroups FindShapeGroups(const Scene& scene, const SeenPlaces& seen,
  const ShapeGroupSettings& settings, const Progress& progress);
}

#endif
