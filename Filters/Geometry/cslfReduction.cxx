// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfReduction.h"

#include <vtkMath.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace cslf
{
namespace
{
/// A part keeps at least a tetrahedron.
constexpr std::size_t MinimumPartTriangles = 4;

/// Parts with at most this many triangles lose much of their volume with each one.
constexpr std::size_t SmallPartTriangles = 100;

/// The smallest variance of a part along an axis, as a share of the sum along all axes. What was
/// flatter, or became so, is not stretched along it.
constexpr double MinimumVariance = 1e-4;

/// The connected parts of a surface.
struct Parts
{
  std::vector<std::uint32_t> OfPoints;
  std::vector<std::vector<glm::uvec3>> Triangles;
};

/// One of the points that triangles join with each point.
std::vector<std::uint32_t> JoinPoints(const SurfaceMesh& mesh)
{
  std::vector<std::uint32_t> next(mesh.Points.size());
  std::iota(next.begin(), next.end(), 0U);
  const auto find = [&](std::uint32_t point)
  {
    for (; next[point] != point; point = next[point])
    {
      next[point] = next[next[point]];
    }
    return point;
  };
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    const std::uint32_t part = find(corners.x);
    next[find(corners.y)] = part;
    next[find(corners.z)] = part;
  }
  for (std::uint32_t point = 0; point < next.size(); ++point)
  {
    next[point] = find(point);
  }
  return next;
}

Parts FindParts(const SurfaceMesh& mesh)
{
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  Parts parts;
  parts.OfPoints = JoinPoints(mesh);
  std::vector<std::uint32_t> numbers(mesh.Points.size(), none);
  std::uint32_t count = 0;
  for (std::uint32_t& part : parts.OfPoints)
  {
    std::uint32_t& number = numbers[part];
    number = number == none ? count++ : number;
    part = number;
  }
  parts.Triangles.resize(count);
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    parts.Triangles[parts.OfPoints[corners.x]].push_back(corners);
  }
  return parts;
}

/// Where the area of a surface lies.
struct Moments
{
  double Area = 0.0;
  glm::dvec3 Mean{ 0.0 };
  glm::dmat3 Variance{ 0.0 };
};

Moments FindMoments(const std::vector<glm::vec3>& points, const std::vector<glm::uvec3>& triangles)
{
  Moments moments;
  if (triangles.empty())
  {
    return moments;
  }
  glm::dvec3 sum(0.0);
  glm::dmat3 squares(0.0);
  const glm::dvec3 origin(points[triangles.front().x]);
  for (const glm::uvec3& corners : triangles)
  {
    const glm::dvec3 a = glm::dvec3(points[corners.x]) - origin;
    const glm::dvec3 b = glm::dvec3(points[corners.y]) - origin;
    const glm::dvec3 c = glm::dvec3(points[corners.z]) - origin;
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    const glm::dvec3 all = a + b + c;
    moments.Area += area;
    sum += area / 3.0 * all;
    squares += area / 12.0 *
      (glm::outerProduct(a, a) + glm::outerProduct(b, b) + glm::outerProduct(c, c) +
        glm::outerProduct(all, all));
  }
  if (moments.Area > 0.0)
  {
    const glm::dvec3 mean = sum / moments.Area;
    moments.Mean = origin + mean;
    moments.Variance = squares * (1.0 / moments.Area) - glm::outerProduct(mean, mean);
  }
  return moments;
}

/// A power of a symmetric matrix whose eigenvalues are raised to a lowest one.
glm::dmat3 Power(const glm::dmat3& matrix, double exponent, double least)
{
  double rows[3][3];
  double vectors[3][3];
  double values[3];
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      rows[i][j] = matrix[j][i];
    }
  }
  double* rowPointers[3] = { rows[0], rows[1], rows[2] };
  double* vectorPointers[3] = { vectors[0], vectors[1], vectors[2] };
  vtkMath::Jacobi(rowPointers, values, vectorPointers);
  glm::dmat3 result(0.0);
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3 axis(vectors[0][k], vectors[1][k], vectors[2][k]);
    result += std::pow(std::max(values[k], least), exponent) * glm::outerProduct(axis, axis);
  }
  return result;
}

/// An affine map.
struct Stretch
{
  glm::dmat3 Linear{ 1.0 };
  glm::dvec3 Offset{ 0.0 };
};

/// Makes a surface's moments those that are wanted: a body whose section became a triangle gets as
/// thick as it was.
Stretch FindStretch(const Moments& moments, const Moments& wanted)
{
  Stretch stretch;
  if (moments.Area > 0.0 && wanted.Area > 0.0)
  {
    const glm::dmat3& all = wanted.Variance;
    const double least = MinimumVariance * (all[0][0] + all[1][1] + all[2][2]);
    const glm::dmat3 variance = Power(all, 1.0, least);
    const glm::dmat3 root = Power(moments.Variance, 0.5, least);
    const glm::dmat3 inverse = Power(moments.Variance, -0.5, least);
    stretch.Linear = inverse * Power(root * variance * root, 0.5, 0.0) * inverse;
    stretch.Offset = wanted.Mean - stretch.Linear * moments.Mean;
  }
  return stretch;
}

/// Stretches small parts. The points are still those of the original.
void Restore(const Parts& original, SurfaceMesh& mesh)
{
  std::vector<std::vector<glm::uvec3>> triangles(original.Triangles.size());
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    triangles[original.OfPoints[corners.x]].push_back(corners);
  }
  std::vector<Stretch> stretches(triangles.size());
  for (std::size_t part = 0; part < triangles.size(); ++part)
  {
    const std::vector<glm::uvec3>& before = original.Triangles[part];
    if (before.size() <= SmallPartTriangles && triangles[part].size() < before.size())
    {
      stretches[part] =
        FindStretch(FindMoments(mesh.Points, triangles[part]), FindMoments(mesh.Points, before));
    }
  }
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    const Stretch& stretch = stretches[original.OfPoints[i]];
    mesh.Points[i] = glm::vec3(stretch.Linear * glm::dvec3(mesh.Points[i]) + stretch.Offset);
  }
}

/// The triangles of a part, reduced.
std::vector<glm::uvec3> ReducePart(const std::vector<glm::vec3>& points,
  const std::vector<glm::uvec3>& triangles, std::size_t most, std::vector<std::uint32_t>& places)
{
  if (triangles.size() <= most)
  {
    return triangles;
  }
  SurfaceMesh part;
  std::vector<std::uint32_t> sources;
  for (const glm::uvec3& corners : triangles)
  {
    glm::uvec3 moved;
    for (int i = 0; i < 3; ++i)
    {
      std::uint32_t& place = places[corners[i]];
      if (place >= sources.size() || sources[place] != corners[i])
      {
        place = static_cast<std::uint32_t>(sources.size());
        sources.push_back(corners[i]);
        part.Points.push_back(points[corners[i]]);
      }
      moved[i] = place;
    }
    part.Triangles.push_back(moved);
  }
  SimplifyTo(part, most);
  if (part.Triangles.empty())
  {
    return triangles;
  }
  for (glm::uvec3& corners : part.Triangles)
  {
    corners = { sources[corners.x], sources[corners.y], sources[corners.z] };
  }
  return part.Triangles;
}

/// The same share of each part, if there are not too many for that.
void ReduceParts(const Parts& parts, std::size_t most, SurfaceMesh& mesh)
{
  if (parts.Triangles.size() * MinimumPartTriangles > most)
  {
    return;
  }
  std::vector<std::uint32_t> order(parts.Triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b)
    { return parts.Triangles[a].size() < parts.Triangles[b].size(); });
  // What one part does not use is left to the larger ones.
  std::size_t left = mesh.Triangles.size();
  std::size_t unused = most;
  std::vector<std::uint32_t> places(mesh.Points.size(), 0);
  mesh.Triangles.clear();
  for (const std::uint32_t number : order)
  {
    const std::vector<glm::uvec3>& part = parts.Triangles[number];
    const double share = double(part.size()) * double(unused) / double(left);
    const std::vector<glm::uvec3> reduced = ReducePart(mesh.Points, part,
      std::max(static_cast<std::size_t>(share + 0.5), MinimumPartTriangles), places);
    left -= part.size();
    unused -= std::min(unused, reduced.size());
    mesh.Triangles.insert(mesh.Triangles.end(), reduced.begin(), reduced.end());
  }
}
}

void Reduce(SurfaceMesh& mesh, std::size_t most, bool byParts)
{
  if (mesh.Triangles.size() <= most)
  {
    return;
  }
  const Parts parts = FindParts(mesh);
  if (byParts)
  {
    ReduceParts(parts, most, mesh);
  }
  if (mesh.Triangles.size() > most)
  {
    SimplifyTo(mesh, most);
  }
  if (mesh.Triangles.size() <= most)
  {
    Restore(parts, mesh);
  }
  else
  {
    SimplifySloppily(mesh, most);
  }
  DropUnused(mesh);
}

SurfaceError ReduceWell(SurfaceMesh& mesh, std::size_t most, const std::vector<glm::vec3>& points,
  double lost, const Progress& progress)
{
  if (mesh.Triangles.size() <= most)
  {
    return MeasureError(points, mesh, lost, progress);
  }
  SurfaceMesh other = mesh;
  ChangeApart(mesh, Within(progress, 0.0, 0.3),
    [most](SurfaceMesh& changed) { Reduce(changed, most, true); });
  const SurfaceError error = MeasureError(points, mesh, lost, Within(progress, 0.3, 0.5));
  ChangeApart(other, Within(progress, 0.5, 0.8),
    [most](SurfaceMesh& changed) { Reduce(changed, most, false); });
  const SurfaceError otherError = MeasureError(points, other, lost, Within(progress, 0.8, 1.0));
  if (error.GetMeanSquare(lost) <= otherError.GetMeanSquare(lost))
  {
    return error;
  }
  mesh = std::move(other);
  return otherError;
}
}
