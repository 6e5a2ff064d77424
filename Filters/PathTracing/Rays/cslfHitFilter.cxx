// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfHitFilter.h"

#include "PathTracing/Shapes/cslfMesh.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "cslfHitGeometry.h"

#include <glm/geometric.hpp>

#include <cstddef>
#include <cstring>

namespace cslf
{
namespace
{
/// The bits of two floats as one number.
std::uint64_t GetBits(float a, float b)
{
  std::uint32_t bits[2];
  std::memcpy(&bits[0], &a, sizeof(a));
  std::memcpy(&bits[1], &b, sizeof(b));
  return (std::uint64_t(bits[0]) << 32) | bits[1];
}

/// A number in [0,1) for the hit of a ray on a triangle. It does not depend on when, how often and
/// in which order Embree finds the triangles.
float GetChance(const RTCFilterFunctionNArguments* query, unsigned int lane)
{
  RTCRayN* ray = query->ray;
  const unsigned int size = query->N;
  std::uint64_t hash =
    MixBits(GetBits(RTCRayN_org_x(ray, size, lane), RTCRayN_org_y(ray, size, lane)),
      GetBits(RTCRayN_org_z(ray, size, lane), RTCRayN_dir_x(ray, size, lane)));
  hash = MixBits(hash, GetBits(RTCRayN_dir_y(ray, size, lane), RTCRayN_dir_z(ray, size, lane)));
  hash = MixBits(hash,
    (std::uint64_t(RTCHitN_geomID(query->hit, size, lane)) << 32) |
      RTCHitN_primID(query->hit, size, lane));
  hash = MixBits(hash, RTCHitN_instID(query->hit, size, lane, 0));
  return static_cast<float>(hash >> 40) * 0x1p-24f;
}

glm::vec3 GetDirection(const RTCFilterFunctionNArguments* query, unsigned int lane)
{
  return { RTCRayN_dir_x(query->ray, query->N, lane), RTCRayN_dir_y(query->ray, query->N, lane),
    RTCRayN_dir_z(query->ray, query->N, lane) };
}

/// A normal of any length. On triangles, it is on the front, also in mirrored instances, because it
/// is in the space of the mesh.
glm::vec3 GetNormal(const RTCFilterFunctionNArguments* query, unsigned int lane)
{
  return { RTCHitN_Ng_x(query->hit, query->N, lane), RTCHitN_Ng_y(query->hit, query->N, lane),
    RTCHitN_Ng_z(query->hit, query->N, lane) };
}

/// Whether a ray comes from a hidden side.
bool IsHidden(const RTCFilterFunctionNArguments* query, unsigned int lane, const Mesh& mesh)
{
  return mesh.Material.Sides != VisibleSides::Both &&
    mesh.Material.Hides(glm::dot(GetDirection(query, lane), GetNormal(query, lane)) > 0.0f);
}

/// Whether a ray leaves a sphere or a tube that it has entered. These count as one surface at the
/// first hit, so that no ray hits the other side as well.
bool IsFarSide(const RTCFilterFunctionNArguments* query, unsigned int lane, const Mesh& mesh)
{
  if (mesh.Shape == Mesh::Shapes::Triangles)
  {
    return false;
  }
  // Both are in the space of the mesh, also of instances.
  RTCRayN* ray = query->ray;
  const unsigned int size = query->N;
  const glm::vec3 origin(
    RTCRayN_org_x(ray, size, lane), RTCRayN_org_y(ray, size, lane), RTCRayN_org_z(ray, size, lane));
  if (!(glm::dot(GetDirection(query, lane), GetNormal(query, lane)) > 0.0f))
  {
    return false;
  }
  const unsigned int shape = RTCHitN_primID(query->hit, size, lane);
  return mesh.Shape == Mesh::Shapes::Tubes
    ? !GetTube(mesh, shape).Contains(origin)
    : glm::distance(origin, mesh.Vertices[shape]) > mesh.Radii[shape];
}

/// Whether a ray hits the round end of a tube inside the tube that continues it.
bool IsWithinJoint(const RTCFilterFunctionNArguments* query, unsigned int lane, const Mesh& mesh)
{
  if (mesh.Joints.empty())
  {
    return false;
  }
  // Embree reports these exact numbers for round ends.
  const float along = RTCHitN_u(query->hit, query->N, lane);
  const std::size_t first = 2 * std::size_t(RTCHitN_primID(query->hit, query->N, lane));
  return (along <= 0.0f && mesh.Joints[first] != 0) ||
    (along >= 1.0f && mesh.Joints[first + 1] != 0);
}

/// Rejects hits on hidden sides of opaque triangles.
void RefuseHidden(const RTCFilterFunctionNArguments* query)
{
  const auto& mesh = *static_cast<const Mesh*>(query->geometryUserPtr);
  for (unsigned int lane = 0; lane < query->N; ++lane)
  {
    if (query->valid[lane] != 0 && IsHidden(query, lane, mesh))
    {
      query->valid[lane] = 0;
    }
  }
}

/// Keeps a hit in a packet, at the place of the ray's id, unless the one there is farther away.
void KeepLast(const RTCFilterFunctionNArguments* query, unsigned int lane, RTCRayHit16& last)
{
  const unsigned int id = RTCRayN_id(query->ray, query->N, lane);
  const float distance = RTCRayN_tfar(query->ray, query->N, lane);
  if (last.hit.geomID[id] != RTC_INVALID_GEOMETRY_ID && distance <= last.ray.tfar[id])
  {
    return;
  }
  last.ray.tfar[id] = distance;
  last.hit.Ng_x[id] = RTCHitN_Ng_x(query->hit, query->N, lane);
  last.hit.Ng_y[id] = RTCHitN_Ng_y(query->hit, query->N, lane);
  last.hit.Ng_z[id] = RTCHitN_Ng_z(query->hit, query->N, lane);
  last.hit.u[id] = RTCHitN_u(query->hit, query->N, lane);
  last.hit.v[id] = RTCHitN_v(query->hit, query->N, lane);
  last.hit.geomID[id] = RTCHitN_geomID(query->hit, query->N, lane);
  last.hit.primID[id] = RTCHitN_primID(query->hit, query->N, lane);
  last.hit.instID[0][id] = RTCHitN_instID(query->hit, query->N, lane, 0);
}

/// Rejects hits of rays that pass.
void RefusePassed(const RTCFilterFunctionNArguments* query)
{
  const auto& mesh = *static_cast<const Mesh*>(query->geometryUserPtr);
  const auto& rule = *reinterpret_cast<const EmbreeQuery*>(query->context);
  for (unsigned int lane = 0; lane < query->N; ++lane)
  {
    if (query->valid[lane] == 0)
    {
      continue;
    }
    if (IsHidden(query, lane, mesh) || IsWithinJoint(query, lane, mesh) ||
      IsFarSide(query, lane, mesh))
    {
      query->valid[lane] = 0;
      continue;
    }
    const unsigned int instance = RTCHitN_instID(query->hit, query->N, lane, 0);
    const float opacity = mesh.GetOpacity({ RTCHitN_primID(query->hit, query->N, lane),
      RTCHitN_u(query->hit, query->N, lane), RTCHitN_v(query->hit, query->N, lane),
      instance == RTC_INVALID_GEOMETRY_ID ? TrianglePoint::None : instance - mesh.FirstInstance });
    if (rule.MeetsVeils && opacity > 0.0f && opacity < 1.0f)
    {
      *rule.MeetsVeils = true;
    }
    bool met = false;
    switch (rule.Rule)
    {
      case Passing::ByChance:
        met = GetChance(query, lane) < opacity;
        break;
      case Passing::ByOpacity:
        met = opacity >= rule.MinimumOpacity;
        if (rule.Veils && !met && opacity > 0.0f)
        {
          KeepLast(query, lane, *rule.Veils);
        }
        break;
      case Passing::Attenuated:
      {
        float& part = rule.Transmittance[RTCRayN_id(query->ray, query->N, lane)];
        part *= 1.0f - opacity;
        met = part <= 0.0f;
        break;
      }
    }
    query->valid[lane] = met ? -1 : 0;
  }
}
}

void FilterHits(RTCGeometry geometry, const Mesh& mesh)
{
  const bool isTranslucent = mesh.IsTranslucent();
  if (!isTranslucent && mesh.Material.Sides == VisibleSides::Both)
  {
    return;
  }
  const RTCFilterFunctionN filter = isTranslucent ? RefusePassed : RefuseHidden;
  rtcSetGeometryUserData(geometry, const_cast<Mesh*>(&mesh));
  rtcSetGeometryIntersectFilterFunction(geometry, filter);
  rtcSetGeometryOccludedFilterFunction(geometry, filter);
}
}
