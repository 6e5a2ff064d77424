// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceLanes.h"

#include "PathTracing/Shapes/cslfTriangleGeometry.h"
#include "SIMD/cslfVectorize.h"

namespace cslf
{
namespace
{
/// The hit triangles.
struct TriangleLanes
{
  LaneMask Smooth;
  Lanes<float> Length; // of its rounding
  Vec3Lanes Corners[3];
  Vec3Lanes Normals[3];
  bool AnySmooth = false;
};

void FetchTriangle(const Mesh& mesh, const HitLanes& hits, int lane, TriangleLanes& triangles)
{
  const glm::uvec3& indices = mesh.Triangles[hits.Triangle[lane]];
  triangles.Length[lane] = mesh.LengthsOfRounding[hits.Triangle[lane]];
  for (int i = 0; i < 3; ++i)
  {
    triangles.Corners[i].Set(lane, mesh.Vertices[indices[i]]);
  }
  bool smooth = !mesh.Normals.empty();
  for (int i = 0; smooth && i < 3; ++i)
  {
    const glm::vec3& normal = mesh.Normals[indices[i]];
    triangles.Normals[i].Set(lane, normal);
    smooth = normal != glm::vec3(0.0f);
  }
  triangles.Smooth[lane] = smooth ? -1 : 0;
  triangles.AnySmooth = triangles.AnySmooth || smooth;
}

/// The properties of a mesh that decide how its surface is read. Neighbouring rays mostly hit the
/// same mesh.
struct MeshTraits
{
  std::uint32_t Index = Hit::None;
  const Mesh* Surface = nullptr;
  bool IsPlain = false;
  bool IsUniform = false;
  bool IsEmissive = false;
  bool IsLambertian = false;

  void Set(const Scene& scene, std::uint32_t index)
  {
    if (index != this->Index)
    {
      const Mesh& mesh = scene.GetMeshes()[index];
      this->Index = index;
      this->Surface = &mesh;
      // The corners of triangles and the normals there.
      this->IsPlain = mesh.CanHoldLattice() && !mesh.Textures.Normal;
      this->IsUniform = mesh.IsUniform();
      this->IsEmissive = mesh.Material.IsEmissive();
      this->IsLambertian = mesh.Material.IsLambertian();
    }
  }
};

void FetchMaterial(const MeshTraits& traits, const HitLanes& hits, int lane, SurfaceLanes& surfaces)
{
  const SurfaceMaterial& material = traits.Surface->Material;
  surfaces.Material[lane] = &material;
  if (traits.IsUniform)
  {
    surfaces.BaseColor.Set(lane, material.BaseColor);
    surfaces.Metallic[lane] = material.Metallic;
    surfaces.Alpha[lane] = material.Alpha;
  }
  else
  {
    const MaterialPoint point = traits.Surface->GetMaterialPoint(hits.Get(lane).GetPlace());
    surfaces.BaseColor.Set(lane, point.BaseColor);
    surfaces.Metallic[lane] = point.Metallic;
    surfaces.Alpha[lane] = point.Alpha;
  }
  if (traits.IsEmissive)
  {
    surfaces.Emission.Set(lane, traits.Surface->GetEmission(hits.Get(lane).GetPlace()));
  }
}

/// If all triangles are flat.
CSLF_VECTORIZE void LocateFlat(const RayLanes& rays, const HitLanes& hits,
  const TriangleLanes& triangles, SurfaceLanes& surfaces)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const glm::vec3 direction = rays.Direction.Get(i);
    const glm::vec3 corners[3] = { triangles.Corners[0].Get(i), triangles.Corners[1].Get(i),
      triangles.Corners[2].Get(i) };
    const glm::vec3 front = FindFront(corners);
    const glm::vec3 position = InterpolateCorners(corners, hits.U[i], hits.V[i]);
    const glm::vec3 normal = FaceRay(front, direction);
    const glm::vec3 offset =
      FindOffset(front, glm::abs(position) + glm::abs(corners[0]), triangles.Length[i]) * normal;
    surfaces.Inside[i] = IsBehind(front, direction) ? -1 : 0;
    surfaces.GeometricNormal.Set(i, normal);
    surfaces.ShadingNormal.Set(i, normal);
    surfaces.LeavePosition.Set(i, position + offset);
    surfaces.PassPosition.Set(i, position - offset);
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
    const glm::vec3 leave =
      LeaveSmooth(corners, normals, u, v, geometric, glm::abs(corners[0]), triangles.Length[i]);
    surfaces.ShadingNormal.Set(i, Choose(smooth, normal, surfaces.ShadingNormal.Get(i)));
    surfaces.LeavePosition.Set(i, Choose(smooth, leave, surfaces.LeavePosition.Get(i)));
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
  this->Material[lane] = surface.Material;
}

void ScatterLanes::SetMedium(int lane, const glm::vec3& position, const glm::vec3& path,
  const glm::vec3& albedo, float anisotropy)
{
  static const SurfaceMaterial material = []
  {
    SurfaceMaterial clear;
    clear.Transmission = 1.0f; // receives light from all sides
    return clear;
  }();
  this->Media |= 1u << lane;
  this->Paths.Set(lane, path);
  this->Anisotropy[lane] = anisotropy;
  this->Surfaces.BaseColor.Set(lane, albedo);
  this->Surfaces.Material[lane] = &material;
  this->Surfaces.ShadingNormal.Set(lane, glm::vec3(0.0f, 0.0f, 1.0f));
  this->Surfaces.LeavePosition.Set(lane, position);
  this->Surfaces.PassPosition.Set(lane, position);
}

void FindSurfaces(
  const Scene& scene, const RayLanes& rays, const HitLanes& hits, SurfaceLanes& surfaces)
{
  // Read the hit surfaces.
  TriangleLanes triangles;
  MeshTraits traits;
  std::uint32_t plain = 0;
  std::uint32_t others = 0;
  surfaces.Shining = 0;
  surfaces.Scattering = 0;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    triangles.Smooth[lane] = 0;
    if (!hits.IsValid(lane) || rays.Active[lane] == 0)
    {
      continue;
    }
    const std::uint32_t bit = 1u << lane;
    traits.Set(scene, hits.Mesh[lane]);
    surfaces.Shining |= traits.IsEmissive ? bit : 0u;
    surfaces.Scattering |= traits.IsLambertian ? 0u : bit;
    if (traits.IsPlain)
    {
      plain |= bit;
      FetchTriangle(*traits.Surface, hits, lane, triangles);
      FetchMaterial(traits, hits, lane, surfaces);
    }
    else
    {
      others |= bit;
    }
  }

  // Compute the positions of the points.
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
