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

/// How many triangles there are, at most, if all edges are divided into equal parts. Each halving
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
}

void Subdivide(SurfaceMesh& mesh, double longest, std::size_t most)
{
  const std::vector<double> edges = FindLongestEdges(mesh);
  const double all = edges.empty() ? 0.0 : *std::max_element(edges.begin(), edges.end());
  while (longest < all && CountDivided(edges, longest) > static_cast<double>(most))
  {
    longest *= 2.0;
  }
  if (!(longest > 0.0) || !(longest < all))
  {
    return;
  }
  vtkNew<vtkAdaptiveSubdivisionFilter> divider;
  divider->SetInputData(MakePolyData(mesh, glm::dvec3(0.0), glm::dvec3(1.0)));
  divider->SetMaximumEdgeLength(longest);
  divider->SetMaximumTriangleArea(VTK_DOUBLE_MAX);
  divider->Update();
  vtkPolyData* divided = divider->GetOutput();
  const std::vector<unsigned int> corners = ListCorners(divided);
  mesh.Points.resize(divided->GetNumberOfPoints());
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    double point[3];
    divided->GetPoint(static_cast<vtkIdType>(i), point);
    mesh.Points[i] = { point[0], point[1], point[2] };
  }
  mesh.Triangles.clear();
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
  {
    mesh.Triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
  }
}
}
