// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShapePoints.h"

#include "PathTracing/Materials/cslfLobe.h"
#include "PathTracing/Rays/cslfHitGeometry.h"
#include "PathTracing/Shapes/cslfTriangleGeometry.h"
#include "RandomNumbers/cslfSampling.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cslf
{
namespace
{
/// A direction of the unit sphere, uniform.
glm::vec3 SampleSphere(const glm::vec2& u)
{
  const float z = 1.0f - 2.0f * u.x;
  const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
  float sine = 0.0f;
  float cosine = 0.0f;
  SinCosOfTurn(u.y, sine, cosine);
  return { radius * cosine, radius * sine, z };
}

/// The areas of a tube's round ends and of its side, over two pi. A sphere has only one end.
struct RoundParts
{
  float Start = 0.0f;
  float Side = 0.0f;
  float End = 0.0f;

  explicit RoundParts(const Tube& tube)
  {
    const float end = tube.GetRadius(1.0f);
    if (tube.IsSphere())
    {
      this->End = 2.0f * tube.Radius * tube.Radius;
      return;
    }
    this->Start = tube.Joints[0] ? 0.0f : (1.0f - tube.Slope) * tube.Radius * tube.Radius;
    this->End = tube.Joints[1] ? 0.0f : (1.0f + tube.Slope) * end * end;
    this->Side = 0.5f * (tube.Radius + end) * (1.0f - tube.Slope * tube.Slope) * tube.Length;
  }

  float GetArea() const { return this->Start + this->Side + this->End; }
};

/// The place along a tube's side, from 0 to 1, before which a share of its area lies.
float FindAlong(const Tube& tube, float share)
{
  const float start = tube.Radius;
  const float growth = tube.GetRadius(1.0f) - start;
  const float root = std::sqrt(start * start + share * growth * (2.0f * start + growth));
  return std::clamp(share * (2.0f * start + growth) / std::max(start + root, 1e-30f), 0.0f, 1.0f);
}

/// A number of [0,1) that chooses one of `count`; what is left of it is uniform again.
std::size_t Choose(float& number, std::size_t count)
{
  const float scaled = number * static_cast<float>(count);
  const std::size_t index = std::min(static_cast<std::size_t>(scaled), count - 1);
  number = std::clamp(scaled - static_cast<float>(index), 0.0f, BelowOne);
  return index;
}
}

float GetRoundArea(const Mesh& mesh, std::uint32_t shape)
{
  if (mesh.Shape == Mesh::Shapes::Spheres)
  {
    return 4.0f * Pi * mesh.Radii[shape] * mesh.Radii[shape];
  }
  return 2.0f * Pi * RoundParts(GetTube(mesh, shape)).GetArea();
}

ShapePoints::ShapePoints(const Scene& scene, const ShapeLayout& layout)
  : World(scene)
  , PartsOfMeshes(scene.GetMeshes().size())
  , Ends(layout.GetUnits().size(), 0)
{
  for (const std::uint32_t unit : layout.Items)
  {
    ++this->Ends[unit];
  }
  std::partial_sum(this->Ends.begin(), this->Ends.end(), this->Ends.begin());
  std::vector<std::uint32_t> next(1, 0);
  next.insert(next.end(), this->Ends.begin(), this->Ends.end());
  this->Members.resize(layout.Items.size());
  for (std::uint32_t index = 0; index < scene.GetMeshes().size(); ++index)
  {
    if (!layout.Has(index))
    {
      continue;
    }
    const Mesh& mesh = scene.GetMeshes()[index];
    const std::size_t count =
      mesh.Instances.empty() ? mesh.GetNumberOfShapes() : mesh.Instances.size();
    for (std::uint32_t shape = 0; shape < count; ++shape)
    {
      this->Members[next[layout.Items[layout.FirstItems[index] + shape]]++] = { index, shape };
    }
    if (!mesh.Instances.empty())
    {
      this->AddParts(layout, index);
    }
  }
}

void ShapePoints::AddParts(const ShapeLayout& layout, std::uint32_t index)
{
  const Mesh& mesh = this->World.GetMeshes()[index];
  const std::size_t first = layout.FirstSides[index];
  double sum = 0.0;
  for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
  {
    if (mesh.Shape != Mesh::Shapes::Triangles)
    {
      sum += GetRoundArea(mesh, shape);
      this->PartsOfMeshes[index].Sums.push_back(sum);
      continue;
    }
    for (int side = 0; side < 2; ++side)
    {
      sum += ((layout.Sides[first + shape] >> side) & 1) != 0 ? mesh.GetArea(shape) : 0.0;
      this->PartsOfMeshes[index].Sums.push_back(sum);
    }
  }
}

bool ShapePoints::Get(std::size_t unit, float number, const glm::vec2& u, Point& point) const
{
  const std::uint32_t begin = unit > 0 ? this->Ends[unit - 1] : 0;
  const Member& member = this->Members[begin + Choose(number, this->Ends[unit] - begin)];
  const Mesh& mesh = this->World.GetMeshes()[member.Mesh];
  point.Seen.Mesh = member.Mesh;
  if (mesh.Instances.empty())
  {
    return GetOnRound(mesh, member.Shape, u, point);
  }
  const std::vector<double>& sums = this->PartsOfMeshes[member.Mesh].Sums;
  if (sums.empty() || !(sums.back() > 0.0))
  {
    return false;
  }
  const auto part = std::upper_bound(sums.begin(), sums.end(), number * sums.back());
  const auto index = static_cast<std::uint32_t>(
    std::min<std::ptrdiff_t>(part - sums.begin(), static_cast<std::ptrdiff_t>(sums.size()) - 1));
  point.Seen.Instance = member.Shape;
  return mesh.Shape == Mesh::Shapes::Triangles ? this->GetOnTriangle(mesh, index, u, point)
                                               : GetOnRound(mesh, index, u, point);
}

bool ShapePoints::GetOnTriangle(
  const Mesh& mesh, std::uint32_t part, const glm::vec2& u, Point& point) const
{
  const glm::vec2 place = SampleTriangle(u);
  point.Seen.Triangle = part / 2;
  point.Seen.U = place.x;
  point.Seen.V = place.y;
  point.Seen.Back = part % 2 != 0;
  const glm::uvec3& corners = mesh.Triangles[part / 2];
  const MeshInstance& instance = mesh.Instances[point.Seen.Instance];
  const glm::vec3 a = mesh.Vertices[corners.x];
  // Rounding of the offset would remove the edges of small instances.
  const glm::vec3 edges[3] = { glm::vec3(0.0f), instance.Linear * (mesh.Vertices[corners.y] - a),
    instance.Linear * (mesh.Vertices[corners.z] - a) };
  const bool isMirrored = glm::determinant(instance.Linear / GetSize(instance)) < 0.0f;
  const glm::vec3 out = (isMirrored != point.Seen.Back ? -1.0f : 1.0f) * FindFront(edges);
  const glm::vec3 position =
    ToScene(mesh, point.Seen.Instance, a) + InterpolateCorners(edges, place.x, place.y);
  point.View = { position + out, -out };
  point.Seen.Distance = 1.0f;
  return out != glm::vec3(0.0f);
}

bool ShapePoints::GetOnRound(
  const Mesh& mesh, std::uint32_t shape, const glm::vec2& u, Point& point)
{
  point.Seen.Triangle = shape;
  glm::vec3 center(0.0f);
  glm::vec3 normal = SampleSphere(u);
  float radius = 0.0f;
  if (mesh.Shape == Mesh::Shapes::Spheres)
  {
    center = mesh.Vertices[shape];
    radius = mesh.Radii[shape];
  }
  else
  {
    const Tube tube = GetTube(mesh, shape);
    const RoundParts parts(tube);
    // Heights along the axis are uniform on a part of a sphere. On the side, the mean height of all
    // normals is that of a cone.
    float number = u.x * parts.GetArea();
    float along = 0.0f;
    float height = -tube.Slope;
    if (number < parts.Start)
    {
      height = -1.0f + (1.0f - tube.Slope) * number / parts.Start;
    }
    else if (number - parts.Start < parts.Side)
    {
      along = FindAlong(tube, (number - parts.Start) / parts.Side);
    }
    else
    {
      number = std::min((number - parts.Start - parts.Side) / std::max(parts.End, 1e-30f), 1.0f);
      const float low = tube.IsSphere() ? -1.0f : -tube.Slope;
      height = low + (1.0f - low) * number;
      along = 1.0f;
    }
    center = tube.GetCenter(along);
    radius = tube.GetRadius(along);
    const Frame frame(tube.Axis);
    const float across = std::sqrt(std::max(0.0f, 1.0f - height * height));
    float sine = 0.0f;
    float cosine = 0.0f;
    SinCosOfTurn(u.y, sine, cosine);
    normal = frame.ToWorld({ across * cosine, across * sine, height });
  }
  glm::vec3 position = center + radius * normal;
  if (point.Seen.Instance != Hit::None)
  {
    const MeshInstance& instance = mesh.Instances[point.Seen.Instance];
    position = ToScene(mesh, point.Seen.Instance, position);
    normal = PlaceNormal(instance, normal);
    radius *= GetSize(instance);
  }
  // From near, because the distance's rounding must not turn the normal.
  point.View = { position + radius * normal, -normal };
  point.Seen.Distance = radius;
  return radius > 0.0f;
}
}
