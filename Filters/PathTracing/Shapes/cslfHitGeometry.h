// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where a hit lies, and which way the surface faces there.
 */
#ifndef cslfHitGeometry_h
#define cslfHitGeometry_h

#include "PathTracing/Scene/cslfScene.h"
#include "cslfTube.h"

namespace cslf
{
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
