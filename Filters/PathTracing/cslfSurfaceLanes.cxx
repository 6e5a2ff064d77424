// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceLanes.h"

#include "cslfTriangleGeometry.h"
#include "cslfVectorize.h"

namespace cslf
{
namespace
{
/// The triangles that are hit.
struct TriangleLanes
{
  Vec3Lanes Corners[3];
  Vec3Lanes Normals[3]; // of the smooth ones
  LaneMask Smooth;
  bool AnySmooth = false;
};

/// Whether triangles are told by their corners and the normals there.
bool IsPlain(const Mesh& mesh)
{
  return mesh.CanHoldLattice() && !mesh.Textures.Normal;
}

void FetchTriangle(const Mesh& mesh, std::uint32_t index, int lane, TriangleLanes& triangles)
{
  const glm::uvec3& corners = mesh.Triangles[index];
  const std::uint32_t vertices[3] = { corners.x, corners.y, corners.z };
  for (int i = 0; i < 3; ++i)
  {
    triangles.Corners[i].Set(lane, mesh.Vertices[vertices[i]]);
  }
  bool smooth = !mesh.Normals.empty();
  for (int i = 0; smooth && i < 3; ++i)
  {
    const glm::vec3& normal = mesh.Normals[vertices[i]];
    triangles.Normals[i].Set(lane, normal);
    smooth = normal != glm::vec3(0.0f);
  }
  triangles.Smooth[lane] = smooth ? -1 : 0;
  triangles.AnySmooth = triangles.AnySmooth || smooth;
}

void FetchMaterial(const Mesh& mesh, const Hit& hit, int lane, SurfaceLanes& surfaces)
{
  const SurfaceMaterial& material = mesh.Material;
  surfaces.Material[lane] = &material;
  if (mesh.IsUniform())
  {
    surfaces.BaseColor.Set(lane, material.BaseColor);
    surfaces.Metallic[lane] = material.Metallic;
    surfaces.Alpha[lane] = material.Alpha;
  }
  else
  {
    const MaterialPoint point = mesh.GetMaterialPoint(hit.GetPlace());
    surfaces.BaseColor.Set(lane, point.BaseColor);
    surfaces.Metallic[lane] = point.Metallic;
    surfaces.Alpha[lane] = point.Alpha;
  }
  if (material.IsEmissive())
  {
    surfaces.Emission.Set(lane, mesh.GetEmission(hit.GetPlace()));
    surfaces.EmissionImportance[lane] = mesh.GetEmissionImportance(hit.Triangle);
  }
}

/// As if all triangles were flat.
CSLF_VECTORIZE void LocateFlat(const RayLanes& rays, const HitLanes& hits,
  const TriangleLanes& triangles, SurfaceLanes& surfaces)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const glm::vec3 corners[3] = { triangles.Corners[0].Get(i), triangles.Corners[1].Get(i),
      triangles.Corners[2].Get(i) };
    const glm::vec3 front = FindFront(corners);
    const float away = glm::dot(front, rays.Direction.Get(i));
    const glm::vec3 normal = (away > 0.0f ? -1.0f : 1.0f) * front;
    const glm::vec3 position = InterpolateCorners(corners, hits.U[i], hits.V[i]);
    surfaces.Inside[i] = away > 0.0f ? -1 : 0;
    surfaces.GeometricNormal.Set(i, normal);
    surfaces.ShadingNormal.Set(i, normal);
    surfaces.LeavePosition.Set(i, position + SurfaceOffset * normal);
    surfaces.PassPosition.Set(i, position - SurfaceOffset * normal);
  }
}

/// Bends the normals of smooth triangles and raises positions.
CSLF_VECTORIZE void Smooth(const RayLanes& rays, const HitLanes& hits,
  const TriangleLanes& triangles, SurfaceLanes& surfaces)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const glm::vec3 corners[3] = { triangles.Corners[0].Get(i), triangles.Corners[1].Get(i),
      triangles.Corners[2].Get(i) };
    const glm::vec3 normals[3] = { triangles.Normals[0].Get(i), triangles.Normals[1].Get(i),
      triangles.Normals[2].Get(i) };
    const float u = hits.U[i];
    const float v = hits.V[i];
    const bool smooth = triangles.Smooth[i] != 0;
    const glm::vec3 geometric = surfaces.GeometricNormal.Get(i);
    const glm::vec3 front = (surfaces.Inside[i] != 0 ? -1.0f : 1.0f) * geometric;
    const glm::vec3 normal =
      FaceOutgoing(InterpolateNormals(normals, u, v, front), geometric, -rays.Direction.Get(i));
    const glm::vec3 position =
      RaiseToSmoothSurface(corners, normals, u, v, geometric, InterpolateCorners(corners, u, v));
    surfaces.ShadingNormal.Set(i, Choose(smooth, normal, surfaces.ShadingNormal.Get(i)));
    surfaces.LeavePosition.Set(
      i, Choose(smooth, position + SurfaceOffset * geometric, surfaces.LeavePosition.Get(i)));
  }
}
}

SurfaceHit SurfaceLanes::Get(int lane) const
{
  SurfaceHit surface;
  surface.GeometricNormal = this->GeometricNormal.Get(lane);
  surface.ShadingNormal = this->ShadingNormal.Get(lane);
  surface.LeavePosition = this->LeavePosition.Get(lane);
  surface.PassPosition = this->PassPosition.Get(lane);
  surface.Inside = this->Inside[lane] != 0;
  surface.BaseColor = this->BaseColor.Get(lane);
  surface.Metallic = this->Metallic[lane];
  surface.Alpha = this->Alpha[lane];
  const bool shines = (this->Shining >> lane & 1) != 0;
  surface.Emission = shines ? this->Emission.Get(lane) : glm::vec3(0.0f);
  surface.EmissionImportance = shines ? this->EmissionImportance[lane] : 0.0f;
  surface.Material = this->Material[lane];
  return surface;
}

void SurfaceLanes::Set(int lane, const SurfaceHit& surface)
{
  this->GeometricNormal.Set(lane, surface.GeometricNormal);
  this->ShadingNormal.Set(lane, surface.ShadingNormal);
  this->LeavePosition.Set(lane, surface.LeavePosition);
  this->PassPosition.Set(lane, surface.PassPosition);
  this->Inside[lane] = surface.Inside ? -1 : 0;
  this->BaseColor.Set(lane, surface.BaseColor);
  this->Metallic[lane] = surface.Metallic;
  this->Alpha[lane] = surface.Alpha;
  this->Emission.Set(lane, surface.Emission);
  this->EmissionImportance[lane] = surface.EmissionImportance;
  this->Material[lane] = surface.Material;
}

void FindSurfaces(
  const Scene& scene, const RayLanes& rays, const HitLanes& hits, SurfaceLanes& surfaces)
{
  // Fetch what is hit.
  TriangleLanes triangles;
  std::uint32_t plain = 0;
  std::uint32_t others = 0;
  surfaces.Shining = 0;
  surfaces.Scattering = 0;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    triangles.Smooth[lane] = 0;
    if (!hits.IsValid(lane))
    {
      continue;
    }
    const std::uint32_t bit = 1u << lane;
    const Mesh& mesh = scene.GetMeshes()[hits.Mesh[lane]];
    surfaces.Shining |= mesh.Material.IsEmissive() ? bit : 0u;
    surfaces.Scattering |= mesh.Material.IsMatte() ? 0u : bit;
    if (IsPlain(mesh))
    {
      plain |= bit;
      FetchTriangle(mesh, hits.Triangle[lane], lane, triangles);
      FetchMaterial(mesh, hits.Get(lane), lane, surfaces);
    }
    else
    {
      others |= bit;
    }
  }

  // Find where the points are.
  if (plain != 0)
  {
    LocateFlat(rays, hits, triangles, surfaces);
    if (triangles.AnySmooth)
    {
      Smooth(rays, hits, triangles, surfaces);
    }
  }
  ForEachLane(others,
    [&](int lane) { surfaces.Set(lane, scene.GetSurface(rays.Get(lane), hits.Get(lane))); });
}
}
