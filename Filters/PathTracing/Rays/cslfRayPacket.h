// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Single rays and packets of rays, and their hits.
 */
#ifndef cslfRayPacket_h
#define cslfRayPacket_h

#include "PathTracing/Shapes/cslfMesh.h"
#include "cslfEmbree.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace cslf
{
// The scene's bounding sphere is the unit sphere; the cube around it is split into 4 cells along
// each edge. Rays of a bin start in the same cell, with directions in the same octant.
constexpr int RayBinCount = 4 * 4 * 4 * 8;

/// The bits of a coordinate's cell, with two zero bits after each. NaN is in the first cell.
inline int GetCellBits(float coordinate)
{
  const float place = 2.0f * coordinate + 2.0f;
  const float inside = place > 0.0f ? (place < 3.0f ? place : 3.0f) : 0.0f;
  const int cell = static_cast<int>(inside);
  return (cell & 1) | (cell & 2) << 2;
}

/// In [0,RayBinCount). Bins of an octant are ordered along a Morton curve, so that successive bins
/// are mostly neighbours in space.
inline int GetRayBin(const glm::vec3& origin, const glm::vec3& direction)
{
  const int cell = GetCellBits(origin.x) | GetCellBits(origin.y) << 1 | GetCellBits(origin.z) << 2;
  const int octant =
    (direction.x < 0.0f ? 1 : 0) | (direction.y < 0.0f ? 2 : 0) | (direction.z < 0.0f ? 4 : 0);
  return octant << 6 | cell;
}

/// A half line in scene space.
struct Ray
{
  glm::vec3 Origin{ 0.0f };
  glm::vec3 Direction{ 0.0f, 0.0f, 1.0f }; ///< of unit length
};

/// The first hit of a ray on a triangle, a sphere or a tube.
struct Hit
{
  static constexpr std::uint32_t None = 0xffffffffu;

  float Distance = 0.0f;
  float U = 0.0f; ///< barycentric coordinate of the triangle's second vertex
  float V = 0.0f; ///< and of the third
  std::uint32_t Mesh = None;
  std::uint32_t Triangle = None;
  std::uint32_t Instance = None; ///< of the mesh, if it has any
  /// Whether the ray comes from the side where the vertices run clockwise. This is Embree's choice:
  /// rays from afar that graze a flat triangle may differ from SurfaceHit::Inside.
  bool Back = false;

  bool IsValid() const { return this->Mesh != None; }
  TrianglePoint GetPlace() const { return { this->Triangle, this->U, this->V, this->Instance }; }
};

/// Rays that are traced together, in Embree's layout.
struct RayPacket
{
  static constexpr int Size = 16;

  RTCRayHit16 Query; ///< of each ray its origin, its direction of unit length, and what it hit

  alignas(64) int Active[Size]; ///< -1 for rays, else 0

  /// If above 0, surfaces count exactly where their opacity is at least this. Used for depths, so
  /// that they do not depend on chance.
  float MinimumOpacity = 0.0f;

  /// Whether Scene::Intersect met a surface that rays pass at random, or a volume.
  bool MeetsVeils = false;

  /// Whether there may be a volume in front of a hit, or on a ray without one.
  bool MeetsVolumes = false;

  Ray GetRay(int lane) const
  {
    const RTCRay16& ray = this->Query.ray;
    return { { ray.org_x[lane], ray.org_y[lane], ray.org_z[lane] },
      { ray.dir_x[lane], ray.dir_y[lane], ray.dir_z[lane] } };
  }

  void SetRay(int lane, const Ray& ray)
  {
    this->Query.ray.org_x[lane] = ray.Origin.x;
    this->Query.ray.org_y[lane] = ray.Origin.y;
    this->Query.ray.org_z[lane] = ray.Origin.z;
    this->Query.ray.dir_x[lane] = ray.Direction.x;
    this->Query.ray.dir_y[lane] = ray.Direction.y;
    this->Query.ray.dir_z[lane] = ray.Direction.z;
  }

  /// Whether Scene::Intersect found something.
  bool IsHit(int lane) const { return this->Query.hit.geomID[lane] != Hit::None; }

  Hit GetHit(int lane) const
  {
    static_assert(Hit::None == RTC_INVALID_GEOMETRY_ID, "hits of nothing are told alike");
    const RTCHit16& hit = this->Query.hit;
    const RTCRay16& ray = this->Query.ray;
    const float away = hit.Ng_x[lane] * ray.dir_x[lane] + hit.Ng_y[lane] * ray.dir_y[lane] +
      hit.Ng_z[lane] * ray.dir_z[lane];
    return { ray.tfar[lane], hit.u[lane], hit.v[lane], hit.geomID[lane], hit.primID[lane],
      hit.instID[0][lane], away > 0.0f };
  }
};
}

#endif
