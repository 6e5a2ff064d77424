// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The surfaces of a scene as triangles.
 */
#ifndef cslfTessellation_h
#define cslfTessellation_h

#include "vtkCSLFModule.h" // for export macro

#include "Geometry/cslfSurfaceMesh.h"
#include "PathTracing/Shapes/cslfMesh.h"
#include "Pipeline/cslfPhase.h"
#include "cslfSurfaceRegions.h"

#include <cstddef>
#include <vector>

namespace cslf
{
struct TessellationSettings
{
  /// How far triangles may lie from spheres, tubes and the surfaces of instances, in scene space.
  float Tolerance = 0.0f;

  /// From 0 to 3: how often the number of triangles of each sphere, tube and instance is about
  /// halved, whatever the tolerance.
  int Coarseness = 0;

  /// The most triangles of all instances of a mesh, as far as possible.
  std::size_t MaximumTriangles = 0;

  /// Those of the meshes, which points get; or null for none.
  const SurfaceRegions* Regions = nullptr;
};

/// About how many triangles a tessellation of that coarseness has at least.
VTKCSLF_EXPORT std::size_t CountTriangles(const std::vector<const Mesh*>& meshes, int coarseness);

/// Whether no ray passes a shape, or an instance, without meeting it, from either side. Surfaces
/// whose texture has holes anywhere count as open.
bool IsOpaque(const Mesh& mesh, std::uint32_t shape);
bool IsOpaque(const MeshInstance& instance);

/// By how much an instance of the mesh is larger than it, at most.
float FindLargestScale(const Mesh& mesh);

/// Triangles of the opaque shapes of a mesh that has instances, welded and simplified, and the
/// opaque instances. Throws Aborted.
InstanceGroup TessellateInstances(
  const Mesh& mesh, const TessellationSettings& settings, const Progress& progress);

/// Triangles of the opaque shapes of all opaque instances and other meshes, welded. A mesh that is
/// divided into regions has points of its own for each. Throws Aborted.
VTKCSLF_EXPORT SurfaceMesh Tessellate(const std::vector<const Mesh*>& meshes,
  const TessellationSettings& settings, const Progress& progress);
}

#endif
