// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where a hit lies, and which way the surface faces there.
 */
#ifndef cslfHitGeometry_h
#define cslfHitGeometry_h

#include "PathTracing/Shapes/cslfTube.h"
#include "cslfRayPacket.h"

namespace cslf
{
/// A surface point as seen by a ray.
struct SurfaceHit
{
  glm::vec3 GeometricNormal; ///< on the side the ray comes from
  glm::vec3 ShadingNormal;   ///< on that side too, and facing the ray
  glm::vec3 LeavePosition; ///< the origin of rays that leave on that side: a little off the surface
  glm::vec3 PassPosition;  ///< the origin of rays that leave on the other side
  bool Inside;             ///< whether the ray comes from behind: its triangle is clockwise
  glm::vec3 BaseColor;
  float Metallic;
  float Alpha;
  glm::vec3 Emission;
  const SurfaceMaterial* Material;

  /// The origin of rays that leave at a cosine to the shading normal.
  const glm::vec3& GetStart(float cosine) const
  {
    return cosine < 0.0f ? this->PassPosition : this->LeavePosition;
  }

  /// The normal of a receiver of light samples: 0 if both sides receive, because light passes.
  glm::vec3 GetReceiverNormal() const
  {
    return this->Material->Transmission > 0.0f ? glm::vec3(0.0f) : this->ShadingNormal;
  }

  MaterialPoint GetMaterialPoint() const
  {
    return { this->BaseColor, this->Metallic, this->Alpha };
  }
};

/// The largest element of an instance's matrix, which is about its size.
float GetSize(const MeshInstance& instance);

/// The inverse of its matrix, also of instances so small that the determinant is 0 as a float.
glm::mat3 InvertLinear(const MeshInstance& instance);

/// A mesh's normal in the scene, of unit length, in one of its instances.
glm::vec3 PlaceNormal(const MeshInstance& instance, const glm::vec3& normal);

/// A point of a mesh in the scene, in one of its instances or where it lies.
glm::vec3 ToScene(const Mesh& mesh, std::uint32_t instance, const glm::vec3& point);

/// One of a mesh's tubes, where the mesh lies.
Tube GetTube(const Mesh& mesh, std::uint32_t tube);

/// Finds a hit's normals and positions. On tubes, `place` is moved to the point along the tube that
/// the surface belongs to.
void Locate(
  const Mesh& mesh, const Ray& ray, const Hit& hit, TrianglePoint& place, SurfaceHit& surface);
}

#endif
