// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryDepths.h"

#include "Pipeline/cslfTriangleList.h"

#include <vtkPolyData.h>

#include <algorithm>

namespace cslf
{
namespace
{
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

/// Writes a tile's depths to the strip.
void Write(
  const std::vector<float>& inverseDepths, int resolution, int tile, unsigned short* depths)
{
  std::size_t from = 0;
  for (int y = 0; y < resolution; ++y)
  {
    unsigned short* row = depths + static_cast<std::size_t>(y) * TileCount * resolution +
      static_cast<std::size_t>(tile) * resolution;
    for (int x = 0; x < resolution; ++x, ++from)
    {
      const float inverse = inverseDepths[from];
      row[x] = inverse > 0.0
        ? static_cast<unsigned short>(std::min(65535.0 / inverse + 0.5, GeometryDepths::None - 1.0))
        : GeometryDepths::None;
    }
  }
}
}

GeometryDepths::GeometryDepths(vtkPolyData* triangles, const Cube& box, const Layout& grid)
  : Grid(grid)
  , Triangles(ListPoints(triangles, box), ListCorners(triangles))
{
}

bool GeometryDepths::Draw(
  int slice, unsigned short* depths, const std::atomic<bool>& isStopped) const
{
  std::fill_n(depths, this->Grid.GetStripTexels(), None);
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
    Write(tile.GetInverseDepths(), this->Grid.GetResolution(), number, depths);
  }
  return true;
}
}
