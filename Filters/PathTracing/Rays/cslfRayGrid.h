// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The primary rays of a tile of texels, and the space of the scene that they are traced in.
 */
#ifndef cslfRayGrid_h
#define cslfRayGrid_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Shapes/cslfTriangleGeometry.h"
#include "cslfCube.h"
#include "cslfLayout.h"
#include "cslfRayPacket.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cslf
{
/// The similarity between world and scene space.
struct SceneFrame
{
  glm::dvec3 Center{ 0.0 };
  double Radius = 1.0;

  glm::dvec3 PointToScene(const glm::dvec3& pointWC) const
  {
    return (pointWC - this->Center) / this->Radius;
  }
  glm::dvec3 VectorToScene(const glm::dvec3& vectorWC) const { return vectorWC / this->Radius; }
};

/**
 * The rays of a tile of texels, in scene space. Origin and direction vary linearly with the
 * position, which is in texels from the tile's first corner: this covers the faces of a cube seen
 * from a viewpoint, and the perspective and parallel cameras of VTK. A ray's parameter is 1 at the
 * end of its direction.
 */
struct RayGrid
{
  glm::dvec3 Origin{ 0.0 };
  glm::dvec3 OriginX{ 0.0 };
  glm::dvec3 OriginY{ 0.0 };
  glm::dvec3 Direction{ 0.0 };
  glm::dvec3 DirectionX{ 0.0 };
  glm::dvec3 DirectionY{ 0.0 };
};

/// The grid's parameter of a packet's rays at a distance: Start + distance / Length.
struct PacketScale
{
  alignas(64) float Start[RayPacket::Size];  ///< the parameter where the packet's ray starts
  alignas(64) float Length[RayPacket::Size]; ///< of the grid's direction
};

/// Makes each lane of the packet the ray through a position of the grid: inactive if it cannot hit
/// the scene.
VTKCSLF_EXPORT void SetRays(const RayGrid& grid, const float x[RayPacket::Size],
  const float y[RayPacket::Size], RayPacket& packet, PacketScale& scale);

/// Whether a ray through a rectangle of the grid, given by two corners, may hit the box. False only
/// if none does.
VTKCSLF_EXPORT bool MayMeet(
  const RayGrid& grid, const glm::dvec2& low, const glm::dvec2& high, const Box& box);

/// The rays from a slice's viewpoint to the texels of one of its tiles, in the space of a scene of
/// that frame. Their parameter is 1 on the exit face.
VTKCSLF_EXPORT RayGrid MakeFieldRays(
  const Layout& layout, const Cube& box, const SceneFrame& frame, int slice, int tile);

/// The rays of one texel of these, as `cells` x `cells` texels that share its area.
VTKCSLF_EXPORT RayGrid MakeTexelRays(const RayGrid& tile, int x, int y, int cells);
}

#endif
