// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceError.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cslf
{
namespace
{
vtkNew<vtkPolyData> ToPolyData(const SurfaceMesh& surface)
{
  vtkNew<vtkPoints> points;
  for (const glm::vec3& point : surface.Points)
  {
    points->InsertNextPoint(point.x, point.y, point.z);
  }
  vtkNew<vtkCellArray> cells;
  for (const glm::uvec3& corners : surface.Triangles)
  {
    cells->InsertNextCell({ corners.x, corners.y, corners.z });
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}
}

SurfaceError MeasureError(
  const std::vector<glm::vec3>& points, const SurfaceMesh& mesh, double most)
{
  SurfaceError error;
  if (mesh.Triangles.empty() || points.empty())
  {
    error.Loss = points.empty() ? 0.0 : 1.0;
    return error;
  }
  const auto data = ToPolyData(mesh);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  double squares = 0.0;
  std::size_t near = 0;
  for (const glm::vec3& place : points)
  {
    const double point[3] = { place.x, place.y, place.z };
    double closest[3];
    vtkIdType cell = 0;
    int part = 0;
    double square = 0.0;
    locator->FindClosestPoint(point, closest, cell, part, square);
    if (square <= most * most)
    {
      squares += square;
      ++near;
    }
  }
  error.RootMeanSquare = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(near, 1)));
  error.Loss = 1.0 - static_cast<double>(near) / static_cast<double>(points.size());
  return error;
}
}
