// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRayGrid.h"

#include "SIMD/cslfVectorize.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslf
{
RayGrid MakeFieldRays(
  const Layout& layout, const Cube& box, const SceneFrame& frame, int slice, int tile)
{
  const Viewpoint viewpoint = layout.ViewpointOf(slice);
  const int face = ExitFaceOf(viewpoint.Face, tile);
  const double step = 2.0 / layout.GetResolution();
  const glm::dvec3 from = layout.ViewpointPosition(viewpoint);
  const glm::dvec3 corner = FaceToCube(face, { -1.0, -1.0 });
  const auto toScene = [&](const glm::dvec3& vectorCC)
  { return frame.VectorToScene(box.VectorToWorld(vectorCC)); };
  RayGrid rays;
  rays.Origin = frame.PointToScene(box.PointToWorld(from));
  rays.Direction = toScene(corner - from);
  rays.DirectionX = toScene(FaceToCube(face, { -1.0 + step, -1.0 }) - corner);
  rays.DirectionY = toScene(FaceToCube(face, { -1.0, -1.0 + step }) - corner);
  return rays;
}

RayGrid MakeTexelRays(const RayGrid& tile, int x, int y, int cells)
{
  RayGrid rays = tile;
  rays.Origin += static_cast<double>(x) * tile.OriginX + static_cast<double>(y) * tile.OriginY;
  rays.Direction +=
    static_cast<double>(x) * tile.DirectionX + static_cast<double>(y) * tile.DirectionY;
  const double part = 1.0 / cells;
  rays.OriginX *= part;
  rays.OriginY *= part;
  rays.DirectionX *= part;
  rays.DirectionY *= part;
  return rays;
}

namespace
{
// Rays that start further from the scene, whose radius is 1, are moved closer, to keep the
// precision of floats.
constexpr double FarAway = 8.0;
constexpr double Near = 2.0;

// Rays of neighbouring texels count as starting at one point if they start closer together than
// this: over a hundred thousand texels, the difference is below the precision of floats.
constexpr double SameOrigin = 1e-12;

// The allowed difference of rays from exact arithmetic, in radii of the scene.
constexpr double Rounding = 1e-5;

/// Whether all rays count as starting at the same point.
bool StartAtOnePoint(const RayGrid& grid)
{
  return glm::length(grid.OriginX) < SameOrigin && glm::length(grid.OriginY) < SameOrigin &&
    glm::length(grid.Origin) <= FarAway;
}

/// A bundle of rays from one point, in floats.
struct Bundle
{
  float Origin[3];
  float Direction[3];
  float DirectionX[3];
  float DirectionY[3];

  explicit Bundle(const RayGrid& grid)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Origin[axis] = static_cast<float>(grid.Origin[axis]);
      this->Direction[axis] = static_cast<float>(grid.Direction[axis]);
      this->DirectionX[axis] = static_cast<float>(grid.DirectionX[axis]);
      this->DirectionY[axis] = static_cast<float>(grid.DirectionY[axis]);
    }
  }
};

CSLF_VECTORIZE void SetBundle(
  const Bundle& bundle, const float* x, const float* y, RayPacket& packet, PacketScale& scale)
{
  RTCRay16& ray = packet.Query.ray;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const float dx =
      bundle.Direction[0] + x[lane] * bundle.DirectionX[0] + y[lane] * bundle.DirectionY[0];
    const float dy =
      bundle.Direction[1] + x[lane] * bundle.DirectionX[1] + y[lane] * bundle.DirectionY[1];
    const float dz =
      bundle.Direction[2] + x[lane] * bundle.DirectionX[2] + y[lane] * bundle.DirectionY[2];
    const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
    const float inverse = 1.0f / length;
    ray.org_x[lane] = bundle.Origin[0];
    ray.org_y[lane] = bundle.Origin[1];
    ray.org_z[lane] = bundle.Origin[2];
    ray.dir_x[lane] = dx * inverse;
    ray.dir_y[lane] = dy * inverse;
    ray.dir_z[lane] = dz * inverse;
    packet.Active[lane] = length > 0.0f && length <= std::numeric_limits<float>::max() ? -1 : 0;
    scale.Start[lane] = 0.0f;
    scale.Length[lane] = length;
  }
}

/// Any ray. If it starts far from the scene, its origin is moved to a sphere around the scene.
void SetRay(
  const RayGrid& grid, double x, double y, int lane, RayPacket& packet, PacketScale& scale)
{
  const glm::dvec3 origin = grid.Origin + x * grid.OriginX + y * grid.OriginY;
  const glm::dvec3 path = grid.Direction + x * grid.DirectionX + y * grid.DirectionY;
  const double length = glm::length(path);
  scale.Length[lane] = static_cast<float>(length);
  scale.Start[lane] = 0.0f;
  packet.SetRay(lane, Ray());
  bool active = length > 0.0 && std::isfinite(length);
  if (active)
  {
    const glm::dvec3 direction = path / length;
    double start = 0.0;
    const double distance2 = glm::dot(origin, origin);
    if (distance2 > FarAway * FarAway)
    {
      const double along = -glm::dot(origin, direction);
      const double inside2 = Near * Near - (distance2 - along * along);
      active = along > 0.0 && inside2 > 0.0;
      start = along - std::sqrt(std::max(inside2, 0.0));
    }
    scale.Start[lane] = static_cast<float>(start / length);
    packet.SetRay(lane, { origin + start * direction, direction });
  }
  packet.Active[lane] = active ? -1 : 0;
}
}

void SetRays(const RayGrid& grid, const float x[RayPacket::Size], const float y[RayPacket::Size],
  RayPacket& packet, PacketScale& scale)
{
  if (StartAtOnePoint(grid))
  {
    SetBundle(Bundle(grid), x, y, packet, scale);
    return;
  }
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    SetRay(grid, x[lane], y[lane], lane, packet, scale);
  }
}

bool MayMeet(const RayGrid& grid, const glm::dvec2& low, const glm::dvec2& high, const Box& box)
{
  if (!StartAtOnePoint(grid))
  {
    return true;
  }
  const auto getDirection = [&grid](double x, double y)
  { return grid.Direction + x * grid.DirectionX + y * grid.DirectionY; };
  const glm::dvec3 corners[4] = { getDirection(low.x, low.y), getDirection(high.x, low.y),
    getDirection(high.x, high.y), getDirection(low.x, high.y) };
  const glm::dvec3 middle = corners[0] + corners[2];
  // The rays fill a pyramid. Test whether the box is on the outer side of one of its four sides.
  for (int side = 0; side < 4; ++side)
  {
    glm::dvec3 inwards = glm::cross(corners[side], corners[(side + 1) % 4]);
    inwards *= glm::dot(inwards, middle) < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 innermost = glm::mix(box.Low, box.High, glm::greaterThan(inwards, {}));
    if (glm::dot(inwards, innermost - grid.Origin) < -Rounding * glm::length(inwards))
    {
      return false;
    }
  }
  return true;
}
}
