// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTriangles.h"

#include "cslfValidPolyData.h"

#include <vtkDataSetAttributes.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangleFilter.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslf
{
namespace
{
bool AreFinite(vtkPolyData* data, vtkIdType count, const vtkIdType* points)
{
  return std::all_of(
    points, points + count, [data](vtkIdType point) { return IsFinite(GetPoint(data, point)); });
}

bool HasArea(vtkPolyData* data, const vtkIdType corners[3])
{
  const glm::dvec3 first = GetPoint(data, corners[0]);
  const glm::dvec3 normal =
    glm::cross(GetPoint(data, corners[1]) - first, GetPoint(data, corners[2]) - first);
  return glm::length(normal) > 0.0;
}

/// The data without polygons of four or more corners that are not all finite. VTK's triangulation
/// must not get those.
vtkSmartPointer<vtkPolyData> RemoveBrokenPolygons(vtkPolyData* data, vtkIdType& removed)
{
  const vtkIdType firstPolygon = data->GetNumberOfVerts() + data->GetNumberOfLines();
  std::vector<vtkIdType> broken;
  ForEachCell(data->GetPolys(),
    [&](vtkIdType cell, vtkIdType count, const vtkIdType* points)
    {
      if (count > 3 && !AreFinite(data, count, points))
      {
        broken.push_back(firstPolygon + cell);
      }
    });
  if (broken.empty())
  {
    return data;
  }
  removed += static_cast<vtkIdType>(broken.size());
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(data);
  copy->BuildCells();
  for (vtkIdType cell : broken)
  {
    copy->DeleteCell(cell);
  }
  copy->RemoveDeletedCells();
  return copy;
}
}

bool IsFinite(const glm::dvec3& point)
{
  constexpr double limit = std::numeric_limits<float>::max();
  return std::abs(point.x) < limit && std::abs(point.y) < limit && std::abs(point.z) < limit;
}

bool IsGhost(vtkPolyData* data, vtkIdType cell)
{
  constexpr int ghost = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  return ghosts && (ghosts->GetValue(cell) & ghost) != 0;
}

glm::dvec3 GetPoint(vtkPolyData* data, vtkIdType index)
{
  double point[3];
  data->GetPoint(index, point);
  return { point[0], point[1], point[2] };
}

TriangleSelection SelectTriangles(vtkPolyData* data)
{
  TriangleSelection selection;
  vtkNew<vtkTriangleFilter> triangulation;
  triangulation->SetInputData(RemoveBrokenPolygons(data, selection.Removed));
  triangulation->PassVertsOff();
  triangulation->PassLinesOff();
  triangulation->Update();
  selection.Surface = triangulation->GetOutput();
  ForEachCell(selection.Surface->GetPolys(),
    [&](vtkIdType cell, vtkIdType count, const vtkIdType* points)
    {
      if (IsGhost(selection.Surface, cell))
      {
        return;
      }
      if (count != 3 || !AreFinite(selection.Surface, count, points))
      {
        ++selection.Removed;
      }
      else if (HasArea(selection.Surface, points))
      {
        selection.Cells.push_back(cell);
      }
    });
  return selection;
}
}
