// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFocus.h"

#include <vtkDataArray.h>

#include <algorithm>
#include <vector>

namespace cslf
{
int FindFocalSlice(const Description& description, int face)
{
  const int middle = description.Grid.GetViewpoints() / 2;
  return description.Grid.SliceOf({ face, middle, middle });
}

glm::dvec3 FindFocalPoint(const Description& description, int face, const ViewpointSamples& samples)
{
  glm::dvec3 point(0.0);
  const Channel* depth = description.FindChannel(KnownChannel::Depth);
  if (!depth || samples.IsEmpty())
  {
    return point;
  }
  const double scale = depth->Type == VTK_UNSIGNED_SHORT ? 1.0 / 65535.0 : 1.0;
  vtkDataArray* colors = samples.GetArray(KnownChannel::Color);
  vtkDataArray* depths = samples.GetArray(KnownChannel::Depth);
  const Layout& grid = description.Grid;
  const int resolution = grid.GetResolution();
  const int axis = FaceAxis(face);
  const int tile = TileOf(face, FaceOf(axis, -FaceSign(face)));
  std::vector<double> fractions;
  for (int q = 0; q < resolution; ++q)
  {
    const vtkIdType row = samples.GetFirst() + q * grid.GetStripWidth() + tile * resolution;
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
    point[axis] = FaceSign(face) * std::min(1.0 - 2.0 * *half, 0.0);
  }
  return point;
}

std::array<glm::dvec3, FaceCount> FindFocalPoints(
  const Description& description, vtkImageData* image)
{
  const std::shared_ptr<FieldStore> store = MakeStore(description, image);
  std::array<glm::dvec3, FaceCount> points;
  for (int face = 0; face < FaceCount; ++face)
  {
    points[face] = FindFocalPoint(description, face, store->Get(FindFocalSlice(description, face)));
  }
  return points;
}
}
