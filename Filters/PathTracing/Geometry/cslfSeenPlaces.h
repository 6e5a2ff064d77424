// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where in a scene rays from a field's viewpoints end.
 */
#ifndef cslfSeenPlaces_h
#define cslfSeenPlaces_h

#include "vtkCSLFModule.h" // for export macro

#include "Geometry/cslfSurfaceMesh.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Scene/cslfScene.h"
#include "Pipeline/cslfPhase.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace cslf
{
/// A grid of cells over the scene's bounds, some of which are seen.
class VTKCSLF_EXPORT SeenPlaces
{
public:
  /// The cells are cubes with this edge, or larger if there would be very many.
  SeenPlaces(const Scene& scene, float edge);

  /// Marks the places that the rays of tiles hit, and those between the hits of neighbouring rays
  /// unless they are far apart. A tile is that of a picture with `side` x `side` texels, and each
  /// TileCount of them are those of a viewpoint. Large ones have rays for a quarter of their
  /// texels. Throws Aborted.
  void Look(
    int tiles, int side, const std::function<RayGrid(int tile)>& rays, const Progress& progress);

  /// The same with cells of a multiple of the edge, which are seen if a part of them is.
  SeenPlaces Widen(int factor) const;

  /// Removes the triangles that have no part in or next to a seen cell. Throws Aborted.
  void KeepSeen(SurfaceMesh& mesh, const Progress& progress) const;

  /// Removes the points that are not in or next to a seen cell.
  void KeepSeen(std::vector<glm::vec3>& points) const;

private:
  glm::ivec3 FindCell(const glm::vec3& point) const;
  bool IsMarked(const glm::ivec3& cell) const;
  bool IsNear(const glm::vec3& point) const;
  bool IsNear(const glm::vec3 corners[3]) const;
  std::size_t FindPlace(const glm::ivec3& cell) const;
  void LookAlong(const RayGrid& rays, int texels, int stride, const glm::ivec2& first);
  void MarkBetween(const glm::ivec3& first, const glm::ivec3& last);
  void Mark(const glm::ivec3& cell);

  const Scene& World;
  glm::vec3 Low;
  float Edge;
  glm::ivec3 Cells;
  std::unique_ptr<std::atomic<std::uint8_t>[]> Marks; ///< one for each cell, x first
};
}

#endif
