// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTriangles.h"

#include "Pipeline/cslfValidPolyData.h"

#include <vtkDataSetAttributes.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <glm/geometric.hpp>

#include <algorithm>

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

}

bool IsGhost(vtkPolyData* data, vtkIdType cell)
{
  constexpr int ghost = vtkDataSetAttributes::DUPLICATECELL | vtkDataSetAttributes::HIDDENCELL;
  vtkUnsignedCharArray* ghosts = data->GetCellGhostArray();
  return ghosts && (ghosts->GetValue(cell) & ghost) != 0;
}

TriangleSelection SelectTriangles(vtkPolyData* data)
{
  TriangleSelection selection;
  const Triangulation triangulation = TriangulatePolygons(data);
  selection.Surface = triangulation.Triangles;
  selection.Removed = triangulation.NotFinite;
  selection.WithoutArea = triangulation.WithoutArea;
  selection.Tangled = triangulation.Tangled;
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
