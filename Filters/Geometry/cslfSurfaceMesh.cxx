// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceMesh.h"

#include "Pipeline/cslfParallelFor.h"

#include <meshoptimizer.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace cslf
{
namespace
{
constexpr std::size_t Stride = sizeof(glm::vec3);

/// How much less efficient the order of triangles may become so that those behind others follow.
constexpr float CacheLoss = 1.05f;

/// Fewer triangles are changed at once.
constexpr std::size_t MinimumApart = 20000;

/// About how long a reduction takes for a triangle.
constexpr double ChangeSeconds = 2e-6;

void DropFlat(SurfaceMesh& mesh)
{
  mesh.Triangles.erase(
    std::remove_if(mesh.Triangles.begin(), mesh.Triangles.end(),
      [](const glm::uvec3& corners)
      { return corners.x == corners.y || corners.y == corners.z || corners.z == corners.x; }),
    mesh.Triangles.end());
}

template <typename Value>
void Renumber(
  const std::vector<unsigned int>& numbers, std::size_t count, std::vector<Value>& values)
{
  std::vector<Value> moved(count);
  meshopt_remapVertexBuffer(
    moved.data(), values.data(), values.size(), sizeof(Value), numbers.data());
  values = std::move(moved);
}

/// Gives the points of triangles new numbers, of which there are `count`.
void Renumber(const std::vector<unsigned int>& numbers, std::size_t count, SurfaceMesh& mesh)
{
  meshopt_remapIndexBuffer(&mesh.Triangles.front().x, &mesh.Triangles.front().x,
    3 * mesh.Triangles.size(), numbers.data());
  if (!mesh.Regions.empty())
  {
    Renumber(numbers, count, mesh.Regions);
  }
  Renumber(numbers, count, mesh.Points);
}

/// A pass of one of meshoptimizer's functions, which have the same arguments.
template <typename Pass>
void Run(SurfaceMesh& mesh, const Pass& pass)
{
  std::vector<glm::uvec3> triangles(mesh.Triangles.size());
  const std::size_t indices = pass(&triangles.front().x, &mesh.Triangles.front().x,
    3 * mesh.Triangles.size(), &mesh.Points.front().x, mesh.Points.size());
  triangles.resize(indices / 3);
  mesh.Triangles = std::move(triangles);
}

/// Removes triangles until there are at most that many, or the surface would move by more than a
/// share of its extent.
void Collapse(SurfaceMesh& mesh, std::size_t most, float share)
{
  Run(mesh,
    [&](unsigned int* result, const unsigned int* indices, std::size_t count, const float* points,
      std::size_t pointCount)
    {
      return meshopt_simplify(
        result, indices, count, points, pointCount, Stride, 3 * most, share, 0, nullptr);
    });
}
}

void Append(const InstanceGroup& group, SurfaceMesh& mesh)
{
  for (const InstanceGroup::Placement& placement : group.Placements)
  {
    const auto first = static_cast<std::uint32_t>(mesh.Points.size());
    const bool isMirrored = glm::determinant(placement.Linear) < 0.0f;
    for (const glm::vec3& point : group.Prototype.Points)
    {
      mesh.Points.push_back(placement.Linear * point + placement.Offset);
    }
    mesh.Regions.insert(
      mesh.Regions.end(), group.Prototype.Regions.begin(), group.Prototype.Regions.end());
    for (const glm::uvec3& corners : group.Prototype.Triangles)
    {
      const glm::uvec3 moved = first + corners;
      mesh.Triangles.push_back(isMirrored ? glm::uvec3(moved.x, moved.z, moved.y) : moved);
    }
  }
}

void Keep(const std::vector<char>& isKept, SurfaceMesh& mesh)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    if (isKept[i] != 0)
    {
      mesh.Triangles[count++] = mesh.Triangles[i];
    }
  }
  mesh.Triangles.resize(count);
}

void DropUnused(SurfaceMesh& mesh)
{
  if (mesh.Triangles.empty())
  {
    mesh.Points.clear();
    mesh.Regions.clear();
    return;
  }
  std::vector<unsigned int> numbers(mesh.Points.size());
  const std::size_t count = meshopt_optimizeVertexFetchRemap(
    numbers.data(), &mesh.Triangles.front().x, 3 * mesh.Triangles.size(), mesh.Points.size());
  Renumber(numbers, count, mesh);
}

void Weld(SurfaceMesh& mesh)
{
  if (mesh.Triangles.empty())
  {
    DropUnused(mesh);
    return;
  }
  std::vector<unsigned int> numbers(mesh.Points.size());
  const meshopt_Stream streams[] = { { mesh.Points.data(), Stride, Stride },
    { mesh.Regions.data(), sizeof(std::uint32_t), sizeof(std::uint32_t) } };
  const std::size_t count =
    meshopt_generateVertexRemapMulti(numbers.data(), &mesh.Triangles.front().x,
      3 * mesh.Triangles.size(), mesh.Points.size(), streams, mesh.Regions.empty() ? 1 : 2);
  Renumber(numbers, count, mesh);
  DropFlat(mesh);
  DropUnused(mesh);
}

std::vector<std::uint32_t> NumberPlaces(const std::vector<glm::vec3>& points, std::size_t& count)
{
  std::vector<unsigned int> numbers(points.size());
  count = points.empty() ? 0
                         : meshopt_generateVertexRemap(numbers.data(), nullptr, points.size(),
                             points.data(), points.size(), Stride);
  return numbers;
}

void Simplify(SurfaceMesh& mesh, float tolerance)
{
  if (mesh.Triangles.empty())
  {
    return;
  }
  const float scale = meshopt_simplifyScale(&mesh.Points.front().x, mesh.Points.size(), Stride);
  Collapse(mesh, 0, scale > 0.0f ? tolerance / scale : 0.0f);
  DropUnused(mesh);
}

void SimplifyTo(SurfaceMesh& mesh, std::size_t most)
{
  Collapse(mesh, most, std::numeric_limits<float>::max());
}

void SimplifySloppily(SurfaceMesh& mesh, std::size_t most)
{
  Run(mesh,
    [&](unsigned int* result, const unsigned int* indices, std::size_t count, const float* points,
      std::size_t pointCount)
    {
      return meshopt_simplifySloppy(result, indices, count, points, pointCount, Stride, 3 * most,
        std::numeric_limits<float>::max(), nullptr);
    });
}

std::vector<glm::vec3> FindNormals(const SurfaceMesh& mesh)
{
  std::vector<glm::vec3> normals(mesh.Points.size(), glm::vec3(0.0f));
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    const glm::vec3& first = mesh.Points[corners.x];
    const glm::vec3 across =
      glm::cross(mesh.Points[corners.y] - first, mesh.Points[corners.z] - first);
    for (int i = 0; i < 3; ++i)
    {
      normals[corners[i]] += across;
    }
  }
  for (glm::vec3& normal : normals)
  {
    const float length = glm::length(normal);
    normal = length > 0.0f ? normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
  }
  return normals;
}

void ChangeApart(
  SurfaceMesh& mesh, const Progress& progress, const std::function<void(SurfaceMesh&)>& change)
{
  if (mesh.Triangles.size() < MinimumApart)
  {
    OrAbort(progress)(0.0);
    change(mesh);
    return;
  }
  const double seconds = ChangeSeconds * static_cast<double>(mesh.Triangles.size());
  // The function that makes the result may be copied, but the mesh should not.
  const auto changed = std::make_shared<SurfaceMesh>(std::move(mesh));
  mesh = SurfaceMesh();
  DoApart<void>(progress, seconds, [changed, change] { change(*changed); });
  mesh = std::move(*changed);
}

void SortForDrawing(SurfaceMesh& mesh)
{
  if (mesh.Triangles.empty())
  {
    return;
  }
  Run(mesh,
    [](unsigned int* result, const unsigned int* indices, std::size_t count, const float*,
      std::size_t pointCount)
    {
      meshopt_optimizeVertexCache(result, indices, count, pointCount);
      return count;
    });
  Run(mesh,
    [](unsigned int* result, const unsigned int* indices, std::size_t count, const float* points,
      std::size_t pointCount)
    {
      meshopt_optimizeOverdraw(result, indices, count, points, pointCount, Stride, CacheLoss);
      return count;
    });
  DropUnused(mesh);
}
}
