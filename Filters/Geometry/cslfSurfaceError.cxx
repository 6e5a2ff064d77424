// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceError.h"

#include "cslfGeometryData.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cslf
{
SurfaceError MeasureError(
  const std::vector<glm::vec3>& points, const SurfaceMesh& mesh, double most)
{
  SurfaceError error;
  if (mesh.Triangles.empty() || points.empty())
  {
    error.Loss = points.empty() ? 0.0 : 1.0;
    return error;
  }
  const auto data = MakePolyData(mesh, glm::dvec3(0.0), glm::dvec3(1.0));
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
