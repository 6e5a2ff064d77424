// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Vertices of smooth meshes that are too close together for points of their own.
 */
#ifndef cslfVertexClusters_h
#define cslfVertexClusters_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Shapes/cslfMesh.h"
#include "cslfLayoutProgress.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/// A number for a cell of space, given by integers, that depends on a seed, too.
std::uint64_t HashCell(const glm::vec3& cell, std::uint64_t seed);

/// Of each mesh, for each vertex.
using VertexClusters = std::vector<std::vector<std::uint32_t>>;

/// For each vertex of a mesh, the first vertex in the same cube of an edge length, whose normal has
/// a similar direction. Vertices that have no normal stand alone. Empty if the mesh has no normals.
VTKCSLF_EXPORT std::vector<std::uint32_t> FindVertexClusters(
  const Mesh& mesh, float edge, const LayoutProgress& progress = LayoutProgress());
}

#endif
