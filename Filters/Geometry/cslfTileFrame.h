// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The rays of one tile of a viewpoint's strip.
 */
#ifndef cslfTileFrame_h
#define cslfTileFrame_h

#include "cslfLayout.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cslf
{
/// The space of a tile: x and y along the axes of the exit face, z along its normal, from the
/// viewpoint. The exit face is the plane z = `Distance`. The point that a ray meets is the ray
/// divided by the inverse depth, which is linear over a tile if the surface is a plane.
struct TileFrame
{
  TileFrame(const Layout& grid, int slice, int tile)
    : TileFrame(grid, grid.ViewpointOf(slice), tile)
  {
  }

  TileFrame(const Layout& grid, const Viewpoint& viewpoint, int tile)
    : Face(ExitFaceOf(viewpoint.Face, tile))
    , From(grid.ViewpointPosition(viewpoint))
    , AxisZ(FaceToCube(Face, { 0.0, 0.0 }))
    , AxisX(FaceToCube(Face, { 1.0, 0.0 }) - AxisZ)
    , AxisY(FaceToCube(Face, { 0.0, 1.0 }) - AxisZ)
    , Start(-1.0 - glm::dot(AxisX, From), -1.0 - glm::dot(AxisY, From))
    , Distance(1.0 - glm::dot(AxisZ, From))
    , Step(2.0 / grid.GetResolution())
  {
  }

  /// On an edge of the cube, the rays to the other face lie in that face, and meet nothing.
  bool HasRays() const { return this->Distance > 0.0; }

  /// The ray to a place of the tile, in texels. The centres of texels have whole numbers.
  glm::dvec3 GetRay(double x, double y) const
  {
    return { this->Start.x + (x + 0.5) * this->Step, this->Start.y + (y + 0.5) * this->Step,
      this->Distance };
  }

  glm::dvec3 VectorToCube(const glm::dvec3& vector) const
  {
    return vector.x * this->AxisX + vector.y * this->AxisY + vector.z * this->AxisZ;
  }

  int Face;        ///< the exit face
  glm::dvec3 From; ///< the viewpoint, in CC
  glm::dvec3 AxisZ;
  glm::dvec3 AxisX;
  glm::dvec3 AxisY;
  glm::dvec2 Start; ///< of the tile's corner
  double Distance;  ///< of the exit face
  double Step;      ///< from texel to texel
};
}

#endif
