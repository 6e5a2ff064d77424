// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCenterSurfaces.h"

#include "SIMD/cslfVectorize.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
/// Samples are on a surface if they lie this close to its plane, in widths of a texel there.
constexpr double ReachOfTexel = 0.75;

glm::vec3 FindNormal(const PacketHits& hits, int lane)
{
  const Hit hit = hits.Rays.GetHit(lane);
  const RTCHit16& found = hits.Rays.Query.hit;
  // Embree's normals of instances are in the space of the instance.
  return hit.Instance == Hit::None
    ? glm::vec3(found.Ng_x[lane], found.Ng_y[lane], found.Ng_z[lane])
    : hits.World.GetSurface(hits.Rays.GetRay(lane), hit).GeometricNormal;
}

/// Marks active hits whose distance from a plane is at most its reach, and lanes without a reach.
CSLF_VECTORIZE int MarkNear(const RTCRayHit16& query, const int* active, const float* x,
  const float* y, const float* z, const float* offset, const float* reach, int* own)
{
  int others = 0;
  for (int lane = 0; lane < CenterSurfaces::Size; ++lane)
  {
    const float t = query.ray.tfar[lane];
    const float height = x[lane] * (query.ray.org_x[lane] + t * query.ray.dir_x[lane]) +
      y[lane] * (query.ray.org_y[lane] + t * query.ray.dir_y[lane]) +
      z[lane] * (query.ray.org_z[lane] + t * query.ray.dir_z[lane]) - offset[lane];
    const float distance = height < 0.0f ? -height : height;
    const int isHit = static_cast<int>(query.hit.geomID[lane]) == -1 ? 0 : -1;
    const int isNear = distance <= reach[lane] ? -1 : 0;
    const int isAny = reach[lane] < 0.0f ? -1 : 0;
    own[lane] = isAny | (isHit & isNear);
    others |= active[lane] & ~own[lane];
  }
  return others;
}
}

CenterSurfaces::CenterSurfaces()
{
  std::fill_n(this->Reach, CenterSurfaces::Size, -1.0f);
}

void CenterSurfaces::Find(const PacketHits& centers, const RayGrid& grid)
{
  const double width = std::max(glm::length(grid.DirectionX), glm::length(grid.DirectionY));
  const double fixed = std::max(glm::length(grid.OriginX), glm::length(grid.OriginY));
  for (int lane = 0; lane < CenterSurfaces::Size; ++lane)
  {
    if (!centers.Rays.Active[lane] || !centers.Rays.IsHit(lane))
    {
      continue;
    }
    const glm::vec3 normal = FindNormal(centers, lane);
    const float length = glm::length(normal);
    if (!(length > 0.0f))
    {
      continue;
    }
    const Ray ray = centers.Rays.GetRay(lane);
    const glm::vec3 unit = normal / length;
    const glm::vec3 point = ray.Origin + centers.Rays.GetHit(lane).Distance * ray.Direction;
    this->X[lane] = unit.x;
    this->Y[lane] = unit.y;
    this->Z[lane] = unit.z;
    this->Offset[lane] = glm::dot(unit, point);
    this->Reach[lane] =
      static_cast<float>(ReachOfTexel * (fixed + width * std::abs(centers.GetDepth(lane))));
    this->SelectsAny = true;
  }
}

bool CenterSurfaces::FindSamples(const PacketHits& samples, int own[CenterSurfaces::Size]) const
{
  std::fill_n(own, CenterSurfaces::Size, -1);
  // Surfaces that rays pass at random would otherwise hide what is behind them.
  if (!this->SelectsAny || samples.Rays.MeetsVeils)
  {
    return false;
  }
  alignas(64) float planes[5][CenterSurfaces::Size];
  const float* const texels[5] = { this->X, this->Y, this->Z, this->Offset, this->Reach };
  for (int i = 0; i < 5; ++i)
  {
    for (int lane = 0; lane < CenterSurfaces::Size; ++lane)
    {
      planes[i][lane] = texels[i][samples.Group.GetTexel(lane)];
    }
  }
  return MarkNear(samples.Rays.Query, samples.Rays.Active, planes[0], planes[1], planes[2],
           planes[3], planes[4], own) != 0;
}
}
