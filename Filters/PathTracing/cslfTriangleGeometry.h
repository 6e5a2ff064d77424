// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Normals and positions on triangles. Without branches, for loops over lanes.
 */
#ifndef cslfTriangleGeometry_h
#define cslfTriangleGeometry_h

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
// How far rays start off a surface, in radii of the scene: a hundred times the rounding of a
// vertex.
constexpr float SurfaceOffset = 1e-5f;

// The least cosine between a shading normal and the direction it is seen from.
constexpr float SmallestCosine = 1e-3f;

// Normals that are shorter than this tell no direction.
constexpr float ShortestNormal = 1e-6f;

/// A normal, turned to the side of another.
inline glm::vec3 TurnTo(const glm::vec3& normal, const glm::vec3& side)
{
  return (glm::dot(normal, side) < 0.0f ? -1.0f : 1.0f) * normal;
}

/// One of two vectors.
inline glm::vec3 Choose(bool first, const glm::vec3& a, const glm::vec3& b)
{
  return { first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z };
}

/// What is given at a triangle's corners, at the barycentric coordinates of its second and third.
inline glm::vec3 InterpolateCorners(const glm::vec3 values[3], float u, float v)
{
  return (1.0f - u - v) * values[0] + u * values[1] + v * values[2];
}

/// The normal of the side from which the corners run counterclockwise: of unit length, also where
/// the triangle is so small that its area is 0 as a float.
inline glm::vec3 FindFront(const glm::vec3 corners[3])
{
  const glm::vec3 edges[2] = { corners[1] - corners[0], corners[2] - corners[0] };
  const glm::vec3 sizes = glm::max(glm::abs(edges[0]), glm::abs(edges[1]));
  const float size = std::max(std::max(sizes.x, sizes.y), sizes.z);
  const glm::vec3 normal = glm::cross(edges[0] / size, edges[1] / size);
  const float length = glm::length(normal);
  return length > 0.0f ? normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
}

/// The interpolated normal, on the front.
inline glm::vec3 InterpolateNormals(
  const glm::vec3 normals[3], float u, float v, const glm::vec3& front)
{
  const glm::vec3 normal = TurnTo(InterpolateCorners(normals, u, v), front);
  return Choose(glm::length(normal) > ShortestNormal, normal, front);
}

/// A normal of any length and side, turned to the side that is seen, and so that the outgoing
/// direction sees its front.
inline glm::vec3 FaceOutgoing(
  const glm::vec3& normal, const glm::vec3& geometric, const glm::vec3& outgoing)
{
  const float length = glm::length(normal);
  const glm::vec3 unit = TurnTo(normal, geometric) / length;
  const float lack = std::max(SmallestCosine - glm::dot(unit, outgoing), 0.0f);
  const glm::vec3 bent = unit + lack * outgoing;
  return Choose(length > ShortestNormal, bent / glm::length(bent), geometric);
}

/// A point of a triangle, raised to the smooth surface that its corners' normals suggest, so that
/// the triangle does not shadow directions above the shading normal's horizon: Hanika, "Hacking the
/// Shadow Terminator", Ray Tracing Gems II, 2021.
inline glm::vec3 RaiseToSmoothSurface(const glm::vec3 corners[3], const glm::vec3 normals[3],
  float u, float v, const glm::vec3& geometric, const glm::vec3& position)
{
  const float weights[3] = { 1.0f - u - v, u, v };
  glm::vec3 raised = position;
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 normal = TurnTo(normals[i], geometric);
    const float depth = glm::dot(position - corners[i], normal);
    raised -= weights[i] * std::min(depth, 0.0f) * normal;
  }
  return raised;
}
}

#endif
