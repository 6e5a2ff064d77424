// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Boxes, and normals and positions on triangles: without branches, for loops over lanes.
 */
#ifndef cslfTriangleGeometry_h
#define cslfTriangleGeometry_h

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>

namespace cslf
{
/// An axis-aligned box in scene space; empty where `Low` is above `High`.
struct Box
{
  glm::dvec3 Low{ 0.0 };
  glm::dvec3 High{ 0.0 };
};

// How far rays start off a sphere or a tube, in radii of the scene: Embree's hits on long tubes are
// less exact than on triangles.
constexpr float RoundOffset = 1e-5f;

// How far rays start off a triangle, relative to the coordinates that rounding affects: 16
// roundings of a float.
constexpr float OffsetRoundings = 16.0f * 0x1p-24f;

// The smallest and the largest offset, in radii of the scene. The planes of the thinnest triangles
// are too inexact for any offset.
constexpr float MinimumOffset = 1e-9f;
constexpr float MaximumOffset = 1e-5f;

// The smallest cosine between a shading normal and the direction to the viewer.
constexpr float MinimumViewCosine = 1e-3f;

// Shorter normals have no direction.
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

/// The interpolated value of a triangle's corners, with the barycentric coordinates of the second
/// and third.
inline glm::vec3 InterpolateCorners(const glm::vec3 values[3], float u, float v)
{
  return (1.0f - u - v) * values[0] + u * values[1] + v * values[2];
}

/// How far off a triangle a ray can start so that it does not meet the triangle again: a bound of
/// the rounding, along the normal, of the point, of the triangle's plane and of the ray's query.
/// `reach` is the sum of the absolute coordinates from which they are computed, and `length` the
/// triangle's Mesh::LengthsOfRounding. After Waechter and Binder, "A Fast and Robust Method for
/// Avoiding Self-Intersection", Ray Tracing Gems, 2019, and Pharr, Jakob and Humphreys, "Physically
/// Based Rendering", 4th edition, 6.8.
inline float FindOffset(const glm::vec3& normal, const glm::vec3& reach, float length)
{
  const float offset =
    OffsetRoundings * (glm::dot(glm::abs(normal), reach) + 0.125f * length) + MinimumOffset;
  return std::min(offset, MaximumOffset);
}

/// The normal of the side where the corners run counterclockwise. It has unit length even if the
/// triangle's area is 0 as a float. Rays do not start from Embree's normal, because it is computed
/// from edges relative to the ray's origin: from afar, its rounding can exceed FindOffset.
inline glm::vec3 FindFront(const glm::vec3 corners[3])
{
  const glm::vec3 edges[2] = { corners[1] - corners[0], corners[2] - corners[0] };
  const glm::vec3 sizes = glm::max(glm::abs(edges[0]), glm::abs(edges[1]));
  const float size = std::max(std::max(sizes.x, sizes.y), sizes.z);
  const glm::vec3 normal = glm::cross(edges[0] / size, edges[1] / size);
  const float length = glm::length(normal);
  return Choose(length > 0.0f, normal / length, glm::vec3(0.0f, 0.0f, 1.0f));
}

/// The interpolated normal, on the front.
inline glm::vec3 InterpolateNormals(
  const glm::vec3 normals[3], float u, float v, const glm::vec3& front)
{
  const glm::vec3 normal = TurnTo(InterpolateCorners(normals, u, v), front);
  return Choose(glm::length(normal) > ShortestNormal, normal, front);
}

/// A normal of any length and side, turned to the visible side, and so that the outgoing direction
/// sees its front.
inline glm::vec3 FaceOutgoing(
  const glm::vec3& normal, const glm::vec3& geometric, const glm::vec3& outgoing)
{
  const float length = glm::length(normal);
  const glm::vec3 unit = TurnTo(normal, geometric) / length;
  const float lack = std::max(MinimumViewCosine - glm::dot(unit, outgoing), 0.0f);
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

/// Whether a ray of this direction comes from behind a triangle.
inline bool IsBehind(const glm::vec3& front, const glm::vec3& direction)
{
  return glm::dot(front, direction) > 0.0f;
}

/// The normal of a triangle's front, turned to the side that a ray comes from.
inline glm::vec3 FaceRay(const glm::vec3& front, const glm::vec3& direction)
{
  return (IsBehind(front, direction) ? -1.0f : 1.0f) * front;
}

/// The origin of rays that leave a smooth triangle, on the side of the geometric normal.
inline glm::vec3 LeaveSmooth(const glm::vec3 corners[3], const glm::vec3 normals[3], float u,
  float v, const glm::vec3& geometric, const glm::vec3& reach, float length)
{
  const glm::vec3 position =
    RaiseToSmoothSurface(corners, normals, u, v, geometric, InterpolateCorners(corners, u, v));
  return position + FindOffset(geometric, glm::abs(position) + reach, length) * geometric;
}
}

#endif
