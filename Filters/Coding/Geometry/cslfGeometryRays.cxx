// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryRays.h"

#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfTriangleList.h"

#include <vtkDataArray.h>
#include <vtkGenericCell.h>
#include <vtkPoints.h>
#include <vtkPolygon.h>

#include <glm/geometric.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace cslf
{
GeometryRays::GeometryRays(vtkPolyData* geometry, const Description& field)
  : HasAll(IsCompleteGeometry(geometry))
{
  this->TrianglesCC->ShallowCopy(Triangulate(geometry));
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<glm::vec3> pointsCC;
  for (vtkIdType i = 0; i < this->TrianglesCC->GetNumberOfPoints(); ++i)
  {
    double place[3];
    this->TrianglesCC->GetPoint(i, place);
    const glm::dvec3 point = field.Box.PointToCube({ place[0], place[1], place[2] });
    points->InsertNextPoint(point.x, point.y, point.z);
    pointsCC.emplace_back(point);
  }
  if (IsOpaqueGeometry(geometry))
  {
    this->Cells = std::make_shared<SurfaceCells>(field, pointsCC, ListCorners(this->TrianglesCC));
  }
  this->TrianglesCC->SetPoints(points);
  this->Colors = FindPointColors(this->TrianglesCC);
  this->Mapped = FindMappedPoints(this->TrianglesCC);
  // Threads must find it built.
  this->TrianglesCC->BuildCells();
  this->Locator->SetDataSet(this->TrianglesCC);
  this->Locator->BuildLocator();
}

std::optional<GeometryRays::Hit> GeometryRays::Intersect(const RayCoordinates& ray) const
{
  const glm::dvec3 entry = FaceToCube(ray.Entry.Face, ray.Entry.Coordinates);
  const glm::dvec3 exit = FaceToCube(ray.Exit.Face, ray.Exit.Coordinates);
  thread_local const vtkNew<vtkGenericCell> cell;
  Hit hit;
  double t = 0.0;
  double parametric[3];
  int part = 0;
  vtkIdType number = 0;
  if (this->Locator->IntersectWithLine(
        &entry.x, &exit.x, 0.0, t, &hit.Point.PointCC.x, parametric, part, number, cell) == 0)
  {
    return std::nullopt;
  }
  vtkPolygon::ComputeNormal(cell->GetPoints(), &hit.Point.NormalCC.x);
  const bool isFront = glm::dot(hit.Point.NormalCC, exit - entry) < 0.0;
  vtkDataArray* colors = !isFront && this->Colors.Back ? this->Colors.Back : this->Colors.Front;
  hit.Color = glm::dvec4(0.0);
  const double weights[3] = { 1.0 - parametric[0] - parametric[1], parametric[0], parametric[1] };
  hit.IsExact = true;
  for (int corner = 0; colors && corner < 3; ++corner)
  {
    hit.IsExact = hit.IsExact && this->Colors.IsExact(cell->GetPointId(corner), !isFront);
    hit.Color += weights[corner] * glm::dvec4(GetColor(colors, cell->GetPointId(corner)));
  }
  hit.IsExact = hit.IsExact && hit.Color.w > 0.0;
  hit.Color /= hit.IsExact ? hit.Color.w : 1.0;
  std::array<std::size_t, 3> points{};
  bool areMapped = hit.IsExact;
  for (std::size_t corner = 0; areMapped && corner < points.size(); ++corner)
  {
    points[corner] = static_cast<std::size_t>(cell->GetPointId(static_cast<int>(corner)));
    areMapped = this->Mapped.Has(points[corner]);
  }
  if (areMapped)
  {
    hit.Color = glm::dvec4(
      ShowPlace(this->Mapped, isFront ? 0 : 1, points, { weights[0], weights[1], weights[2] }),
      1.0);
  }
  return hit;
}
}
