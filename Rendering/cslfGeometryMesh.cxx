// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryMesh.h"

#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"
#include "cslfChannel.h"
#include "cslfClosedParts.h"

#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <algorithm>

namespace cslf
{
namespace
{
/// The colours in an array. None if there is no such array.
std::vector<glm::vec4> GetColors(vtkPolyData* geometry, const char* name)
{
  std::vector<glm::vec4> colors;
  vtkDataArray* array = geometry->GetPointData()->GetArray(name);
  if (array && array->GetNumberOfComponents() == 4)
  {
    for (vtkIdType point = 0; point < geometry->GetNumberOfPoints(); ++point)
    {
      colors.push_back(GetColor(array, point));
    }
  }
  return colors;
}
}

std::shared_ptr<const GeometryMesh> MakeGeometryMesh(vtkPolyData* geometry, const Cube& box)
{
  if (!IsUsefulGeometry(geometry))
  {
    return nullptr;
  }
  const vtkSmartPointer<vtkPolyData> triangles = Triangulate(geometry);
  auto mesh = std::make_shared<GeometryMesh>();
  mesh->PointsCC.reserve(triangles->GetNumberOfPoints());
  for (vtkIdType point = 0; point < triangles->GetNumberOfPoints(); ++point)
  {
    double place[3];
    triangles->GetPoint(point, place);
    mesh->PointsCC.emplace_back(box.PointToCube({ place[0], place[1], place[2] }));
  }
  mesh->Colors = GetColors(triangles, ColorName);
  mesh->Colors.resize(mesh->PointsCC.size(), glm::vec4(0.0f));
  mesh->BackColors = GetColors(triangles, BackColorName);
  mesh->HasColors = std::all_of(mesh->Colors.begin(), mesh->Colors.end(),
    [](const glm::vec4& color) { return color.w > 0.0f; });
  mesh->IsComplete = GetGeometryLoss(geometry).value_or(1.0) <= MostLossIfComplete;
  mesh->Corners = ListCorners(triangles);
  mesh->ClosedCorners = SortClosedParts(mesh->PointsCC, mesh->Corners);
  return mesh;
}
}
