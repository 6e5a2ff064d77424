// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFocus.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <vector>

namespace cslf
{
std::array<glm::dvec3, FaceCount> FindFocalPoints(
  const Description& description, vtkImageData* image)
{
  std::array<glm::dvec3, FaceCount> points;
  points.fill(glm::dvec3(0.0));
  const Channel* depth = description.FindChannel(DepthName);
  if (!depth)
  {
    return points;
  }
  vtkDataArray* colors = image->GetPointData()->GetArray(ColorName);
  vtkDataArray* depths = image->GetPointData()->GetArray(DepthName);
  const double scale = depth->Type == VTK_UNSIGNED_SHORT ? 1.0 / 65535.0 : 1.0;

  const Layout& grid = description.Grid;
  const int resolution = grid.GetResolution();
  const int middle = grid.GetViewpoints() / 2;
  for (int face = 0; face < FaceCount; ++face)
  {
    const int axis = FaceAxis(face);
    const int tile = TileOf(face, FaceOf(axis, -FaceSign(face)));
    const vtkIdType firstRow =
      static_cast<vtkIdType>(grid.SliceOf({ face, middle, middle })) * resolution;
    std::vector<double> fractions;
    for (int q = 0; q < resolution; ++q)
    {
      const vtkIdType row = (firstRow + q) * grid.GetStripWidth() + tile * resolution;
      for (vtkIdType texel = row; texel < row + resolution; ++texel)
      {
        if (colors->GetComponent(texel, 3) > 0.0)
        {
          fractions.push_back(scale * depths->GetComponent(texel, 0));
        }
      }
    }
    if (!fractions.empty())
    {
      const auto half = fractions.begin() + fractions.size() / 2;
      std::nth_element(fractions.begin(), half, fractions.end());
      points[face][axis] = FaceSign(face) * std::min(1.0 - 2.0 * *half, 0.0);
    }
  }
  return points;
}
}
