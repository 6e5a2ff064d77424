// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryTexels.h"

#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"

#include <vtkDataArray.h>
#include <vtkPolyData.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace cslf
{
namespace
{
using Color = DrawnTexels::Color;

std::vector<glm::dvec3> ListPoints(vtkPolyData* triangles, const Cube& box)
{
  std::vector<glm::dvec3> points;
  points.reserve(triangles->GetNumberOfPoints());
  for (vtkIdType k = 0; k < triangles->GetNumberOfPoints(); ++k)
  {
    double point[3];
    triangles->GetPoint(k, point);
    points.push_back(box.PointToCube({ point[0], point[1], point[2] }));
  }
  return points;
}

unsigned short ToDepth(float inverse)
{
  return inverse > 0.0F
    ? static_cast<unsigned short>(std::min(65535.0 / inverse + 0.5, GeometryTexels::None - 1.0))
    : GeometryTexels::None;
}
}

GeometryTexels::GeometryTexels(vtkPolyData* triangles, const Cube& box, const Layout& grid)
  : Grid(grid)
  , Triangles(ListPoints(triangles, box), ListCorners(triangles))
{
  this->TakeColors(triangles);
}

void GeometryTexels::TakeColors(vtkPolyData* triangles)
{
  const PointColorArrays arrays = FindPointColors(triangles);
  if (!arrays.Exact || arrays.Front->GetDataType() != VTK_UNSIGNED_CHAR)
  {
    return;
  }
  this->Mapped = FindMappedPoints(triangles);
  for (const int side : { 0, 1 })
  {
    vtkDataArray* colors = side == 1 && arrays.Back ? arrays.Back : arrays.Front;
    for (vtkIdType point = 0; point < triangles->GetNumberOfPoints(); ++point)
    {
      double color[4];
      colors->GetTuple(point, color);
      const bool isExact = arrays.IsExact(point, side == 1) && color[3] == 255.0;
      this->Colors[side].emplace_back(color[0], color[1], color[2], isExact ? 255 : 0);
    }
  }
}

bool GeometryTexels::AreAllExact() const
{
  return this->HasColors() &&
    std::all_of(this->Colors.begin(), this->Colors.end(),
      [](const std::vector<Color>& side) {
        return std::all_of(
          side.begin(), side.end(), [](const Color& color) { return color.w > 0; });
      });
}

bool GeometryTexels::Draw(int slice, DrawnTexels& drawn, const std::atomic<bool>& isStopped) const
{
  const int resolution = this->Grid.GetResolution();
  std::fill(drawn.Depths.begin(), drawn.Depths.end(), None);
  std::fill(drawn.Colors.begin(), drawn.Colors.end(), Color(0));
  for (int number = 0; number < TileCount; ++number)
  {
    DepthTile tile(this->Grid, slice, number);
    if (!tile.HasRays())
    {
      continue;
    }
    if (!tile.Draw(this->Triangles, isStopped))
    {
      return false;
    }
    const TileFrame frame(this->Grid, slice, number);
    std::size_t from = 0;
    for (int y = 0; y < resolution; ++y)
    {
      std::size_t to = (static_cast<std::size_t>(y) * TileCount + number) * resolution;
      for (int x = 0; x < resolution; ++x, ++from, ++to)
      {
        drawn.Depths[to] = ToDepth(tile.GetInverseDepths()[from]);
        if (!drawn.Colors.empty() && drawn.Depths[to] < None)
        {
          drawn.Colors[to] = this->FindColor(frame, tile.GetTriangles()[from], x, y);
        }
      }
    }
  }
  return true;
}

DrawnTexels::Color GeometryTexels::FindColor(
  const TileFrame& frame, std::uint32_t triangle, int x, int y) const
{
  if (!this->HasColors())
  {
    return Color(0);
  }
  const unsigned int* corners = &this->Triangles.GetCorners()[3 * std::size_t(triangle)];
  const glm::dvec3 ray = frame.VectorToCube(frame.GetRay(x, y));
  const auto place = [&](int corner)
  { return this->Triangles.GetPoints()[corners[corner % 3]] - frame.From; };
  // The volumes of the ray and two corners are the third one's barycentric coordinate, and their
  // sum is that of the ray and the normal.
  glm::dvec3 weights;
  for (int k = 0; k < 3; ++k)
  {
    weights[k] = glm::dot(ray, glm::cross(place(k + 1), place(k + 2)));
  }
  const double sum = weights.x + weights.y + weights.z;
  const std::vector<Color>& colors = this->Colors[sum > 0.0 ? 1 : 0];
  glm::dvec3 color(0.0);
  for (int k = 0; k < 3; ++k)
  {
    const Color& own = colors[corners[k]];
    if (own.w == 0)
    {
      return Color(0);
    }
    color += weights[k] / sum * glm::dvec3(own);
  }
  const std::array<std::size_t, 3> points{ corners[0], corners[1], corners[2] };
  const auto isMapped = [this](std::size_t point) { return this->Mapped.Has(point); };
  if (sum != 0.0 && std::all_of(points.begin(), points.end(), isMapped))
  {
    color = 255.0 * ShowPlace(this->Mapped, sum > 0.0 ? 1 : 0, points, weights / sum);
  }
  // Slivers, and rays along a triangle.
  return sum != 0.0 ? Color(glm::clamp(color, 0.0, 255.0) + 0.5, 255) : Color(0);
}
}
