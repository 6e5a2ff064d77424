// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfHitGeometry.h"

#include "PathTracing/Shapes/cslfTriangleGeometry.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cslf
{
namespace
{
/// A vector with unit length, or another one if a float cannot hold its length.
glm::vec3 NormalizeOr(const glm::vec3& vector, const glm::vec3& other)
{
  const float length = glm::length(vector);
  return length > 0.0f && std::isfinite(length) ? vector / length : other;
}

/// A triangle in the scene.
struct HitTriangle
{
  glm::vec3 Corners[3];
  glm::vec3 Normals[3]; // of any length; if it is smooth
  glm::vec3 Front;      // the normal of the side from which the corners run counterclockwise
  bool IsSmooth;        // whether all corners have a normal
  glm::vec3 Reach;      // for FindOffset, of the first corner
  float Length;         // of its rounding
};

HitTriangle GetTriangle(const Mesh& mesh, const TrianglePoint& place)
{
  const glm::uvec3& corners = mesh.Triangles[place.Triangle];
  HitTriangle triangle;
  triangle.IsSmooth = !mesh.Normals.empty();
  for (int i = 0; i < 3; ++i)
  {
    triangle.Corners[i] = mesh.Vertices[corners[i]];
    if (triangle.IsSmooth)
    {
      triangle.Normals[i] = mesh.Normals[corners[i]];
      triangle.IsSmooth = triangle.Normals[i] != glm::vec3(0.0f);
    }
  }
  triangle.Reach = glm::abs(triangle.Corners[0]);
  triangle.Length = mesh.LengthsOfRounding[place.Triangle];
  if (place.Instance != TrianglePoint::None)
  {
    const MeshInstance& instance = mesh.Instances[place.Instance];
    // Rays are transformed to the instance's mesh, which causes rounding, too.
    const glm::mat3 sizes(
      glm::abs(instance.Linear[0]), glm::abs(instance.Linear[1]), glm::abs(instance.Linear[2]));
    triangle.Length *= GetSize(instance);
    triangle.Reach = 2.0f * (sizes * triangle.Reach + glm::abs(instance.Offset));
    // Rounding of the offset would remove the edges of small instances.
    const glm::vec3 edges[3] = { glm::vec3(0.0f),
      instance.Linear * (triangle.Corners[1] - triangle.Corners[0]),
      instance.Linear * (triangle.Corners[2] - triangle.Corners[0]) };
    triangle.Front = FindFront(edges);
    for (int i = 0; i < 3; ++i)
    {
      triangle.Corners[i] = instance.Linear * triangle.Corners[i] + instance.Offset;
      if (triangle.IsSmooth)
      {
        triangle.Normals[i] = PlaceNormal(instance, triangle.Normals[i]);
      }
    }
    triangle.Front *= glm::determinant(instance.Linear / GetSize(instance)) < 0.0f ? -1.0f : 1.0f;
  }
  else
  {
    triangle.Front = FindFront(triangle.Corners);
  }
  return triangle;
}

/// The interpolated normal, bent by the normal texture, turned to the ray's side so that the ray
/// sees its front.
glm::vec3 FindShadingNormal(const Mesh& mesh, const HitTriangle& triangle,
  const TrianglePoint& place, const SurfaceHit& surface, const glm::vec3& outgoing)
{
  glm::vec3 normal = triangle.Front;
  if (triangle.IsSmooth)
  {
    normal = InterpolateNormals(triangle.Normals, place.U, place.V, triangle.Front);
  }
  if (mesh.Textures.Normal)
  {
    const glm::vec3 edges[2] = { triangle.Corners[1] - triangle.Corners[0],
      triangle.Corners[2] - triangle.Corners[0] };
    normal = mesh.BendNormal(normal, edges, place);
  }
  return FaceOutgoing(normal, surface.GeometricNormal, outgoing);
}

void LocateOnTriangle(
  const Mesh& mesh, const Ray& ray, const TrianglePoint& place, SurfaceHit& surface)
{
  const HitTriangle triangle = GetTriangle(mesh, place);
  const glm::vec3 position = InterpolateCorners(triangle.Corners, place.U, place.V);
  const glm::vec3 offset =
    FindOffset(triangle.Front, glm::abs(position) + triangle.Reach, triangle.Length) *
    FaceRay(triangle.Front, ray.Direction);
  surface.GeometricNormal = FaceRay(triangle.Front, ray.Direction);
  surface.Inside = IsBehind(triangle.Front, ray.Direction);
  surface.PassPosition = position - offset;
  surface.LeavePosition = triangle.IsSmooth
    ? LeaveSmooth(triangle.Corners, triangle.Normals, place.U, place.V, surface.GeometricNormal,
        triangle.Reach, triangle.Length)
    : position + offset;
  surface.ShadingNormal = triangle.IsSmooth || mesh.Textures.Normal
    ? FindShadingNormal(mesh, triangle, place, surface, -ray.Direction)
    : surface.GeometricNormal;
}

/// The centre and radius of the sphere that touches a tube's surface at a point, and how far along
/// the tube it is, in [0,1].
glm::vec4 FindTubeSphere(
  const Mesh& mesh, std::uint32_t index, const glm::vec3& point, float& along)
{
  const Tube tube = GetTube(mesh, index);
  along = std::clamp(tube.FindAlong(point), 0.0f, 1.0f);
  return { tube.GetCenter(along), tube.GetRadius(along) };
}

void LocateOnRound(
  const Mesh& mesh, const Ray& ray, const Hit& hit, TrianglePoint& place, SurfaceHit& surface)
{
  // Find the surface in the space of the mesh.
  glm::vec3 point = ray.Origin + hit.Distance * ray.Direction;
  const bool instanced = place.Instance != TrianglePoint::None;
  if (instanced)
  {
    const MeshInstance& instance = mesh.Instances[place.Instance];
    point = InvertLinear(instance) * (point - instance.Offset);
  }
  const glm::vec4 sphere = mesh.Shape == Mesh::Shapes::Tubes
    ? FindTubeSphere(mesh, place.Triangle, point, place.U)
    : glm::vec4(mesh.Vertices[place.Triangle], mesh.Radii[place.Triangle]);
  const glm::vec3 center(sphere);
  glm::vec3 normal = NormalizeOr(point - center, -ray.Direction);
  const glm::vec3 position = ToScene(mesh, place.Instance, center + sphere.w * normal);
  if (instanced)
  {
    normal = PlaceNormal(mesh.Instances[place.Instance], normal);
  }

  surface.GeometricNormal = TurnTo(normal, -ray.Direction);
  surface.Inside = surface.GeometricNormal != normal;
  surface.ShadingNormal = surface.GeometricNormal;
  surface.LeavePosition = position + RoundOffset * surface.GeometricNormal;
  surface.PassPosition = position - RoundOffset * surface.GeometricNormal;
}
}

Tube GetTube(const Mesh& mesh, std::uint32_t tube)
{
  const std::size_t first = 2 * std::size_t(tube);
  Tube result(
    mesh.Vertices[first], mesh.Vertices[first + 1], mesh.Radii[first], mesh.Radii[first + 1]);
  for (int end = 0; end < 2 && !mesh.Joints.empty(); ++end)
  {
    result.Joints[end] = mesh.Joints[first + end] != 0;
  }
  return result;
}

float GetSize(const MeshInstance& instance)
{
  float size = std::numeric_limits<float>::min();
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 column = glm::abs(instance.Linear[i]);
    size = std::max(size, std::max(column.x, std::max(column.y, column.z)));
  }
  return size;
}

glm::mat3 InvertLinear(const MeshInstance& instance)
{
  const float size = GetSize(instance);
  return glm::inverse(instance.Linear / size) / size;
}

glm::vec3 PlaceNormal(const MeshInstance& instance, const glm::vec3& normal)
{
  return NormalizeOr(glm::transpose(InvertLinear(instance)) * normal, normal);
}

glm::vec3 ToScene(const Mesh& mesh, std::uint32_t instance, const glm::vec3& point)
{
  if (instance == TrianglePoint::None)
  {
    return point;
  }
  const MeshInstance& placed = mesh.Instances[instance];
  return placed.Linear * point + placed.Offset;
}

void Locate(
  const Mesh& mesh, const Ray& ray, const Hit& hit, TrianglePoint& place, SurfaceHit& surface)
{
  if (mesh.Shape == Mesh::Shapes::Triangles)
  {
    LocateOnTriangle(mesh, ray, place, surface);
  }
  else
  {
    LocateOnRound(mesh, ray, hit, place, surface);
  }
}
}
