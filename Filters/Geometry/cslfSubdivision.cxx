// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSubdivision.h"

#include "Pipeline/cslfTriangleList.h"
#include "cslfGeometryData.h"

#include <vtkAdaptiveSubdivisionFilter.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
/// The length of the longest edge of each triangle.
std::vector<double> FindLongestEdges(const SurfaceMesh& mesh)
{
  std::vector<double> lengths;
  lengths.reserve(mesh.Triangles.size());
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    const glm::dvec3 a(mesh.Points[corners.x]);
    const glm::dvec3 b(mesh.Points[corners.y]);
    const glm::dvec3 c(mesh.Points[corners.z]);
    lengths.push_back(std::max({ glm::distance(a, b), glm::distance(b, c), glm::distance(c, a) }));
  }
  return lengths;
}

/// About how many triangles there are if all edges are divided into equal parts. Each halving
/// divides a triangle into four.
double CountDivided(const std::vector<double>& edges, double longest)
{
  double count = 0.0;
  for (const double edge : edges)
  {
    count += edge > longest ? std::pow(4.0, std::ceil(std::log2(edge / longest))) : 1.0;
  }
  return count;
}

SurfaceMesh Divide(const SurfaceMesh& mesh, double longest)
{
  vtkNew<vtkAdaptiveSubdivisionFilter> divider;
  divider->SetInputData(MakePolyData(mesh, glm::dvec3(0.0), glm::dvec3(1.0)));
  divider->SetMaximumEdgeLength(longest);
  divider->SetMaximumTriangleArea(VTK_DOUBLE_MAX);
  divider->Update();
  vtkPolyData* data = divider->GetOutput();
  SurfaceMesh divided;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double point[3];
    data->GetPoint(i, point);
    divided.Points.emplace_back(point[0], point[1], point[2]);
  }
  const std::vector<unsigned int> corners = ListCorners(data);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
  {
    divided.Triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
  }
  return divided;
}
}

void Subdivide(SurfaceMesh& mesh, double longest, std::size_t most)
{
  const std::vector<double> edges = FindLongestEdges(mesh);
  const double all = edges.empty() ? 0.0 : *std::max_element(edges.begin(), edges.end());
  for (; longest > 0.0 && longest < all; longest *= 2.0)
  {
    if (CountDivided(edges, longest) <= static_cast<double>(most))
    {
      SurfaceMesh divided = Divide(mesh, longest);
      if (divided.Triangles.size() <= most)
      {
        mesh = std::move(divided);
        return;
      }
    }
  }
}
}
