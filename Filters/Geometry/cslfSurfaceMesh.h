// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Triangles, and their simplification.
 */
#ifndef cslfSurfaceMesh_h
#define cslfSurfaceMesh_h

#include "vtkCSLFModule.h" // for export macro

#include "Pipeline/cslfPhase.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace cslf
{
struct SurfaceMesh
{
  std::vector<glm::vec3> Points;
  std::vector<glm::uvec3> Triangles;
  /// Of each point, or none at all. Points of different regions are not joined, so that their
  /// borders stay where they are.
  std::vector<std::uint32_t> Regions;
};

/// Bodies that are one mesh at several places.
struct InstanceGroup
{
  struct Placement
  {
    glm::mat3 Linear{ 1.0f }; ///< with the offset: from the prototype to the mesh
    glm::vec3 Offset{ 0.0f };
    std::uint32_t Source = 0; ///< the number of the scene's mesh to which the body belongs
  };

  SurfaceMesh Prototype;
  std::vector<Placement> Placements;
  bool IsClosed = false; ///< whether nobody sees its back
  bool IsBall = false;   ///< whether the prototype stands for the unit sphere
};

/// Adds the bodies of a group, in their order. Each has the points and triangles of the prototype,
/// in their order; a mirrored one with the last two corners of each triangle exchanged. All have
/// regions, or none.
VTKCSLF_EXPORT void Append(const InstanceGroup& group, SurfaceMesh& mesh);

/// Removes the triangles that are marked by 0.
VTKCSLF_EXPORT void Keep(const std::vector<char>& isKept, SurfaceMesh& mesh);

/// Keeps the points that triangles use, in their order of use.
VTKCSLF_EXPORT void DropUnused(SurfaceMesh& mesh);

/// Joins points of a region at the same place, and drops triangles without area and points without
/// triangle.
VTKCSLF_EXPORT void Weld(SurfaceMesh& mesh);

/// The numbers of the places of points, from 0: those at the same place have the same.
VTKCSLF_EXPORT std::vector<std::uint32_t> NumberPlaces(
  const std::vector<glm::vec3>& points, std::size_t& count);

/// Removes as many triangles as it can without moving the surface by more than about `tolerance`.
/// The mesh must be welded.
VTKCSLF_EXPORT void Simplify(SurfaceMesh& mesh, float tolerance);

/// Removes triangles until there are at most `most`, or no more can be removed without changing the
/// topology, with an error as small as possible. Keeps all points. The mesh must be welded.
VTKCSLF_EXPORT void SimplifyTo(SurfaceMesh& mesh, std::size_t most);

/// Does not keep the topology, so it also works for many small bodies, but not as well.
VTKCSLF_EXPORT void SimplifySloppily(SurfaceMesh& mesh, std::size_t most);

/// Normals of points, of unit length, on the side where corners run counterclockwise.
VTKCSLF_EXPORT std::vector<glm::vec3> FindNormals(const SurfaceMesh& mesh);

/// Changes a mesh by a function that cannot be interrupted and uses nothing else of the caller's.
/// Throws Aborted, and then the mesh is lost.
VTKCSLF_EXPORT void ChangeApart(
  SurfaceMesh& mesh, const Progress& progress, const std::function<void(SurfaceMesh&)>& change);

/// Puts triangles and points into an order in which they are drawn fast.
VTKCSLF_EXPORT void SortForDrawing(SurfaceMesh& mesh);
}

#endif
