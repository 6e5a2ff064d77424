// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceError.h"

#include "Pipeline/cslfParallelFor.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPThreadLocal.h>
#include <vtkStaticPointLocator.h>
#include <vtkType.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace cslf
{
namespace
{
using Corners = std::array<glm::dvec3, 3>;

/// The square of the distance of a point from the line between two others.
double FindSquare(const glm::dvec3& point, const glm::dvec3& first, const glm::dvec3& last)
{
  const glm::dvec3 way = last - first;
  const double square = glm::dot(way, way);
  const double share =
    square > 0.0 ? std::clamp(glm::dot(point - first, way) / square, 0.0, 1.0) : 0.0;
  const glm::dvec3 rest = point - first - share * way;
  return glm::dot(rest, rest);
}

/// The square of the distance of a point from a triangle.
double FindSquare(const glm::dvec3& point, const Corners& triangle)
{
  const auto& [a, b, c] = triangle;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double square = glm::dot(normal, normal);
  const auto isInside = [&](const glm::dvec3& first, const glm::dvec3& last)
  { return glm::dot(glm::cross(last - first, point - first), normal) >= 0.0; };
  if (square > 0.0 && isInside(a, b) && isInside(b, c) && isInside(c, a))
  {
    const double distance = glm::dot(point - a, normal);
    return distance * distance / square;
  }
  return std::min({ FindSquare(point, a, b), FindSquare(point, b, c), FindSquare(point, c, a) });
}

/// Lowers the squares of the distances of points near a triangle.
void Approach(vtkStaticPointLocator* locator, const std::vector<glm::vec3>& points,
  const Corners& triangle, double most, vtkIdList* near, std::vector<double>& squares)
{
  const auto& [a, b, c] = triangle;
  const glm::dvec3 low = glm::min(a, glm::min(b, c));
  const glm::dvec3 high = glm::max(a, glm::max(b, c));
  const glm::dvec3 middle = 0.5 * (low + high);
  locator->FindPointsWithinRadius(0.5 * glm::distance(low, high) + most, &middle.x, near);
  for (vtkIdType k = 0; k < near->GetNumberOfIds(); ++k)
  {
    const vtkIdType id = near->GetId(k);
    const glm::dvec3 point(points[id]);
    // Most triangles are farther than the nearest so far, as their boxes show.
    const glm::dvec3 toBox = point - glm::clamp(point, low, high);
    if (glm::dot(toBox, toBox) <= std::min(squares[id], most * most))
    {
      squares[id] = std::min(squares[id], FindSquare(point, triangle));
    }
  }
}
}

SurfaceError MeasureError(const std::vector<glm::vec3>& points, const SurfaceMesh& mesh,
  double most, const Progress& progress)
{
  SurfaceError error;
  if (mesh.Triangles.empty() || points.empty())
  {
    error.Loss = points.empty() ? 0.0 : 1.0;
    return error;
  }
  // There are few points, and each is far from most triangles, so triangles look for points.
  vtkNew<vtkPoints> places;
  for (const glm::vec3& point : points)
  {
    places->InsertNextPoint(point.x, point.y, point.z);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(places);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  vtkSMPThreadLocal<std::vector<double>> parts{ std::vector<double>(
    points.size(), std::numeric_limits<double>::infinity()) };
  const auto measure = [&](vtkIdType begin, vtkIdType end)
  {
    std::vector<double>& squares = parts.Local();
    vtkNew<vtkIdList> near;
    for (vtkIdType i = begin; i < end; ++i)
    {
      const glm::uvec3& corners = mesh.Triangles[i];
      Approach(locator, points,
        { mesh.Points[corners.x], mesh.Points[corners.y], mesh.Points[corners.z] }, most, near,
        squares);
    }
  };
  ParallelFor(0, static_cast<vtkIdType>(mesh.Triangles.size()), OrAbort(progress), measure);
  double sum = 0.0;
  std::size_t near = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    double square = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& squares : parts)
    {
      square = std::min(square, squares[i]);
    }
    const bool isNear = square <= most * most;
    sum += isNear ? square : 0.0;
    near += isNear ? 1 : 0;
  }
  error.RootMeanSquare = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(near, 1)));
  error.Loss = 1.0 - static_cast<double>(near) / static_cast<double>(points.size());
  return error;
}
}
