// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRayGrid.h"

#include "cslfVectorize.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// Rays that start further from the scene, whose radius is 1, are moved closer, for a float's sake.
constexpr double FarAway = 8.0;
constexpr double Near = 2.0;

// Rays of neighbouring texels that start closer to each other than this start from one point: over
// a hundred thousand texels that is less than a float can tell.
constexpr double SameOrigin = 1e-12;

/// A bundle of rays from one point, in floats.
struct Bundle
{
  float Direction[3];
  float DirectionX[3];
  float DirectionY[3];
};

CSLF_VECTORIZE void SetDirections(
  const Bundle& bundle, const float* x, const float* y, RayPacket& packet, float* lengths)
{
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const float dx =
      bundle.Direction[0] + x[lane] * bundle.DirectionX[0] + y[lane] * bundle.DirectionY[0];
    const float dy =
      bundle.Direction[1] + x[lane] * bundle.DirectionX[1] + y[lane] * bundle.DirectionY[1];
    const float dz =
      bundle.Direction[2] + x[lane] * bundle.DirectionX[2] + y[lane] * bundle.DirectionY[2];
    const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
    lengths[lane] = length;
    packet.DirectionX[lane] = dx / length;
    packet.DirectionY[lane] = dy / length;
    packet.DirectionZ[lane] = dz / length;
  }
}

/// Rays from one point near the scene.
PacketScale SetBundle(const RayGrid& grid, const float* x, const float* y, RayPacket& packet)
{
  Bundle bundle;
  for (int axis = 0; axis < 3; ++axis)
  {
    bundle.Direction[axis] = static_cast<float>(grid.Direction[axis]);
    bundle.DirectionX[axis] = static_cast<float>(grid.DirectionX[axis]);
    bundle.DirectionY[axis] = static_cast<float>(grid.DirectionY[axis]);
  }
  PacketScale scale;
  SetDirections(bundle, x, y, packet, scale.Length);
  std::fill_n(packet.OriginX, RayPacket::Size, static_cast<float>(grid.Origin.x));
  std::fill_n(packet.OriginY, RayPacket::Size, static_cast<float>(grid.Origin.y));
  std::fill_n(packet.OriginZ, RayPacket::Size, static_cast<float>(grid.Origin.z));
  std::fill_n(scale.Start, RayPacket::Size, 0.0);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    packet.Active[lane] = scale.Length[lane] > 0.0f && std::isfinite(scale.Length[lane]) ? -1 : 0;
  }
  return scale;
}

/// Any ray: where it starts far from the scene, it is moved to a sphere around it.
void SetRay(
  const RayGrid& grid, double x, double y, int lane, RayPacket& packet, PacketScale& scale)
{
  const glm::dvec3 origin = grid.Origin + x * grid.OriginX + y * grid.OriginY;
  const glm::dvec3 path = grid.Direction + x * grid.DirectionX + y * grid.DirectionY;
  const double length = glm::length(path);
  scale.Length[lane] = static_cast<float>(length);
  scale.Start[lane] = 0.0;
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
    scale.Start[lane] = start / length;
    packet.SetRay(lane, { origin + start * direction, direction });
  }
  packet.Active[lane] = active ? -1 : 0;
}
}

PacketScale SetRays(const RayGrid& grid, const float x[RayPacket::Size],
  const float y[RayPacket::Size], RayPacket& packet)
{
  if (glm::length(grid.OriginX) < SameOrigin && glm::length(grid.OriginY) < SameOrigin &&
    glm::length(grid.Origin) <= FarAway)
  {
    return SetBundle(grid, x, y, packet);
  }
  PacketScale scale;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    SetRay(grid, x[lane], y[lane], lane, packet, scale);
  }
  return scale;
}
}
