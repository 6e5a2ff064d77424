// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTessellation.h"

#include "Geometry/cslfReduction.h"
#include "PathTracing/Shapes/cslfTube.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cslf
{
namespace
{
/// The sides of a regular polygon around a circle: at least 6, and not more than 64.
constexpr int MinimumSides = 6;
constexpr int MaximumSides = 64;

/// The fewest triangles that a coarser instance has.
constexpr std::size_t MinimumPartTriangles = 8;

/// The spheres or tubes between two reports of progress.
constexpr std::size_t ShapesOfReport = 4096;

/// The triangles of the coarsest sphere; tubes have about as many.
constexpr std::size_t MinimumOfRound = 24;

/// A polygon of the circle's area lies within about `tolerance` of the circle on both sides.
int CountSides(float radius, float tolerance)
{
  const float cosine = std::clamp(1.0f - 1.5f * tolerance / std::max(radius, 1e-30f), -1.0f, 1.0f);
  const float half = std::max(std::acos(cosine), 1e-3f);
  return std::clamp(
    static_cast<int>(std::ceil(glm::pi<float>() / half)), MinimumSides, MaximumSides);
}

/// Adds surfaces of revolution.
class Turner
{
public:
  Turner(SurfaceMesh& mesh, const glm::vec3& axis, int sides)
    : Result(mesh)
    , Axis(axis)
    , Sides(sides)
    // A polygon with the area of the circle, so that outlines do not shrink.
    , Growth(std::sqrt(glm::two_pi<float>() /
        (static_cast<float>(sides) * std::sin(glm::two_pi<float>() / static_cast<float>(sides)))))
  {
    const glm::vec3 other =
      std::abs(axis.x) < 0.5f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    this->Across = glm::normalize(glm::cross(axis, other));
    this->Up = glm::cross(axis, this->Across);
  }

  /// A circle of a sphere, at an angle from the plane across the axis, joined with the last one.
  void AddRing(const glm::vec3& center, float circle, float latitude)
  {
    const float radius = this->Growth * circle;
    const auto first = static_cast<std::uint32_t>(this->Result.Points.size());
    const glm::vec3 middle = center + radius * std::sin(latitude) * this->Axis;
    for (int side = 0; side < this->Sides; ++side)
    {
      const float angle =
        glm::two_pi<float>() * static_cast<float>(side) / static_cast<float>(this->Sides);
      this->Result.Points.push_back(middle +
        radius * std::cos(latitude) *
          (std::cos(angle) * this->Across + std::sin(angle) * this->Up));
    }
    if (this->Rings++ > 0)
    {
      const std::uint32_t before = first - static_cast<std::uint32_t>(this->Sides);
      for (int side = 0; side < this->Sides; ++side)
      {
        const auto a = static_cast<std::uint32_t>(side);
        const auto b = static_cast<std::uint32_t>((side + 1) % this->Sides);
        this->Result.Triangles.emplace_back(before + a, before + b, first + b);
        this->Result.Triangles.emplace_back(before + a, first + b, first + a);
      }
    }
  }

  /// The circles of a sphere between two latitudes.
  void AddCap(const glm::vec3& center, float radius, float from, float to)
  {
    const float step = glm::two_pi<float>() / static_cast<float>(this->Sides);
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / step - 0.01f)));
    for (int part = 0; part <= parts; ++part)
    {
      this->AddRing(
        center, radius, from + (to - from) * static_cast<float>(part) / static_cast<float>(parts));
    }
  }

private:
  SurfaceMesh& Result;
  glm::vec3 Axis;
  glm::vec3 Across;
  glm::vec3 Up;
  int Sides;
  float Growth;
  int Rings = 0;
};

void AddSphere(const glm::vec3& center, float radius, float tolerance, SurfaceMesh& result)
{
  constexpr float pole = glm::half_pi<float>();
  Turner(result, glm::vec3(0.0f, 0.0f, 1.0f), CountSides(radius, tolerance))
    .AddCap(center, radius, -pole, pole);
}

void AddTube(const Tube& tube, float tolerance, SurfaceMesh& result)
{
  if (tube.IsSphere())
  {
    AddSphere(tube.Start, tube.Radius, tolerance, result);
    return;
  }
  constexpr float pole = glm::half_pi<float>();
  // Where the cone touches the spheres.
  const float touch = std::asin(-tube.Slope);
  const float radii[2] = { tube.GetRadius(0.0f), tube.GetRadius(1.0f) };
  Turner turner(result, tube.Axis, CountSides(std::max(radii[0], radii[1]), tolerance));
  turner.AddCap(tube.GetCenter(0.0f), radii[0], tube.Joints[0] ? touch : -pole, touch);
  turner.AddCap(tube.GetCenter(1.0f), radii[1], touch, tube.Joints[1] ? touch : pole);
}

void AddTube(const Mesh& mesh, std::uint32_t shape, float tolerance, SurfaceMesh& result)
{
  const std::size_t first = 2 * std::size_t(shape);
  Tube tube(
    mesh.Vertices[first], mesh.Vertices[first + 1], mesh.Radii[first], mesh.Radii[first + 1]);
  for (int end = 0; end < 2 && !mesh.Joints.empty(); ++end)
  {
    tube.Joints[end] = mesh.Joints[first + end] != 0;
  }
  AddTube(tube, tolerance, result);
}

/// Adds a triangle with points of its own.
void AddTriangle(const Mesh& mesh, std::uint32_t shape, std::uint32_t region, SurfaceMesh& result)
{
  const auto first = static_cast<std::uint32_t>(result.Points.size());
  result.Triangles.push_back(first + glm::uvec3(0, 1, 2));
  for (int i = 0; i < 3; ++i)
  {
    result.Points.push_back(mesh.Vertices[mesh.Triangles[shape][i]]);
    result.Regions.push_back(region);
  }
}

/// How far spheres and tubes may be from their triangles.
float GetRoundTolerance(const TessellationSettings& settings)
{
  return settings.Tolerance * static_cast<float>(1 << 2 * settings.Coarseness);
}

/// The opaque shapes of a mesh without its instances, in its own space.
SurfaceMesh TessellateOne(
  const Mesh& mesh, float scale, const TessellationSettings& settings, const Progress& progress)
{
  SurfaceMesh result;
  const float tolerance = GetRoundTolerance(settings) / scale;
  const SurfaceRegions* regions = settings.Regions;
  const bool isDivided = regions && regions->HasSeveral(mesh);
  const std::size_t shapes = mesh.GetNumberOfShapes();
  const auto report = [&](std::size_t shape)
  {
    if (shape % ShapesOfReport == 0)
    {
      OrAbort(progress)(static_cast<double>(shape) / static_cast<double>(shapes));
    }
  };
  if (mesh.Shape == Mesh::Shapes::Triangles && !isDivided)
  {
    result.Points = mesh.Vertices;
  }
  for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
  {
    report(shape);
    if (!IsOpaque(mesh, shape))
    {
      continue;
    }
    const bool isRound = mesh.Shape != Mesh::Shapes::Triangles;
    switch (mesh.Shape)
    {
      case Mesh::Shapes::Triangles:
        if (isDivided)
        {
          AddTriangle(mesh, shape, regions->Get(mesh, shape), result);
          break;
        }
        result.Triangles.push_back(mesh.Triangles[shape]);
        break;
      case Mesh::Shapes::Spheres:
        AddSphere(mesh.Vertices[shape], mesh.Radii[shape], tolerance, result);
        break;
      case Mesh::Shapes::Tubes:
        AddTube(mesh, shape, tolerance, result);
        break;
    }
    if (isDivided && isRound)
    {
      result.Regions.resize(result.Points.size(), regions->Get(mesh, shape));
    }
  }
  if (regions && !isDivided)
  {
    result.Regions.assign(result.Points.size(), regions->Get(mesh, 0));
  }
  ChangeApart(result, Within(progress, 1.0, 1.0), Weld);
  return result;
}
}

float FindLargestScale(const Mesh& mesh)
{
  float scale = 0.0f;
  for (const MeshInstance& instance : mesh.Instances)
  {
    for (int column = 0; column < 3; ++column)
    {
      scale = std::max(scale, glm::length(instance.Linear[column]));
    }
  }
  return scale;
}

InstanceGroup TessellateInstances(
  const Mesh& mesh, const TessellationSettings& settings, const Progress& progress)
{
  InstanceGroup group;
  const float scale = FindLargestScale(mesh);
  if (!(scale > 0.0f))
  {
    return group;
  }
  const float tolerance = settings.Tolerance;
  SurfaceMesh& part = group.Prototype;
  part = TessellateOne(mesh, scale, settings, progress);
  if (part.Triangles.empty())
  {
    return group;
  }
  const std::size_t most = settings.MaximumTriangles / mesh.Instances.size();
  ChangeApart(part, Within(progress, 1.0, 1.0),
    [most, tolerance = tolerance / scale, coarseness = settings.Coarseness](SurfaceMesh& changed)
    {
      Simplify(changed, tolerance);
      constexpr bool byParts = true;
      Reduce(changed,
        std::max(std::min(changed.Triangles.size() >> coarseness, most), MinimumPartTriangles),
        byParts);
    });
  for (const MeshInstance& instance : mesh.Instances)
  {
    if (IsOpaque(instance))
    {
      group.Placements.push_back({ instance.Linear, instance.Offset });
    }
  }
  return group;
}

bool IsOpaque(const Mesh& mesh, std::uint32_t shape)
{
  if (mesh.Material.Hides(false) || mesh.Material.Hides(true) ||
    (mesh.Textures.BaseColor && mesh.Textures.BaseColor->IsTranslucent()))
  {
    return false;
  }
  // Opacities are interpolated, so the smallest is at a corner.
  constexpr glm::vec2 corners[] = { { 0.0f, 0.0f }, { 1.0f, 0.0f }, { 0.0f, 1.0f } };
  return std::all_of(std::begin(corners), std::end(corners),
    [&](const glm::vec2& corner) {
      return mesh.GetOpacity({ shape, corner.x, corner.y }) >= 1.0f;
    });
}

bool IsOpaque(const MeshInstance& instance)
{
  return instance.Opacity >= 1.0f;
}

std::size_t CountTriangles(const std::vector<const Mesh*>& meshes, int coarseness)
{
  std::size_t count = 0;
  for (const Mesh* mesh : meshes)
  {
    const bool isRound = mesh->Shape != Mesh::Shapes::Triangles;
    const std::size_t shapes = mesh->GetNumberOfShapes() * (isRound ? MinimumOfRound : 1);
    count += mesh->Instances.empty() ? shapes
                                     : mesh->Instances.size() *
        std::max(std::min(shapes, shapes >> coarseness), MinimumPartTriangles);
  }
  return count;
}

SurfaceMesh Tessellate(const std::vector<const Mesh*>& meshes, const TessellationSettings& settings,
  const Progress& progress)
{
  SurfaceMesh result;
  const auto all = static_cast<double>(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    const Progress step =
      Within(progress, static_cast<double>(i) / all, (static_cast<double>(i) + 1.0) / all);
    if (!meshes[i]->Instances.empty())
    {
      Append(TessellateInstances(*meshes[i], settings, step), result);
      continue;
    }
    InstanceGroup one;
    one.Prototype = TessellateOne(*meshes[i], 1.0f, settings, step);
    one.Placements.emplace_back();
    Append(one, result);
  }
  ChangeApart(result, Within(progress, 1.0, 1.0), Weld);
  return result;
}
}
