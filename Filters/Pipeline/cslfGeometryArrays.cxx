// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryArrays.h"

#include "cslfChannel.h"
#include "cslfValidPolyData.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
/// What rounding may add to a point of the cube.
constexpr double CoordinateLimit = 1.0 + 1e-6;

/// Codes of a doubling of brightness.
constexpr double StepsOfDoubling = 8.0;

std::optional<double> GetNumber(vtkPolyData* geometry, const char* name)
{
  vtkDataArray* array = geometry->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() == 1 ? std::optional(array->GetTuple1(0))
                                                  : std::nullopt;
}
}

PointColorArrays FindPointColors(vtkPolyData* geometry)
{
  const auto find = [geometry](const char* name, int components) -> vtkDataArray*
  {
    vtkDataArray* array = geometry->GetPointData()->GetArray(name);
    const bool fits = array && array->GetNumberOfComponents() == components &&
      array->GetNumberOfTuples() == geometry->GetNumberOfPoints();
    return fits ? array : nullptr;
  };
  vtkDataArray* front = find(ColorName, 4);
  vtkDataArray* back = front ? find(BackColorName, 4) : nullptr;
  const bool areAlike = back && back->GetDataType() == front->GetDataType();
  return { front, areAlike ? back : nullptr, front ? find(ExactColorName, 2) : nullptr };
}

unsigned char ToExactCode(double brightness)
{
  constexpr double most = 255.0;
  const double code = 1.0 + std::round(StepsOfDoubling * std::log2(std::max(brightness, 1.0)));
  return static_cast<unsigned char>(std::min(code, most));
}

double PointColorArrays::GetCode(vtkIdType point, bool isBack) const
{
  return this->Exact ? this->Exact->GetComponent(point, isBack && this->Back ? 1 : 0) : 0.0;
}

double PointColorArrays::GetBrightness(vtkIdType point, bool isBack) const
{
  return std::exp2(std::max(this->GetCode(point, isBack) - 1.0, 0.0) / StepsOfDoubling);
}

std::optional<double> GetGeometryError(vtkPolyData* geometry)
{
  return GetNumber(geometry, GeometryErrorName);
}

std::optional<double> GetGeometryLoss(vtkPolyData* geometry)
{
  const std::optional<double> loss = GetNumber(geometry, GeometryLossName);
  return loss ? loss : GetNumber(geometry, GeometryOpaqueLossName);
}

bool IsOpaqueGeometry(vtkPolyData* geometry)
{
  return !GetNumber(geometry, GeometryLossName) &&
    GetNumber(geometry, GeometryOpaqueLossName).has_value();
}

bool IsCompleteGeometry(vtkPolyData* geometry)
{
  return GetNumber(geometry, GeometryLossName).value_or(1.0) <= MaximumLossIfComplete;
}

bool IsUsefulGeometry(vtkPolyData* geometry)
{
  const bool hasPolygons = geometry->GetNumberOfPolys() + geometry->GetNumberOfStrips() > 0;
  return hasPolygons && GetGeometryLoss(geometry).value_or(0.0) <= MaximumUsefulLoss;
}

std::string DescribeGeometryError(vtkPolyData* geometry, const Cube& box)
{
  if (!MakeSound(geometry).IsWhole())
  {
    return "the geometry has cells of points that do not exist";
  }
  bool isInside = true;
  for (vtkCellArray* cells : { geometry->GetPolys(), geometry->GetStrips() })
  {
    ForEachCell(cells,
      [&](vtkIdType, vtkIdType count, const vtkIdType* points)
      {
        for (vtkIdType k = 0; k < count; ++k)
        {
          double point[3];
          geometry->GetPoint(points[k], point);
          const glm::dvec3 pointCC = glm::abs(box.PointToCube({ point[0], point[1], point[2] }));
          // False for NaN, too.
          isInside = isInside && glm::all(glm::lessThanEqual(pointCC, glm::dvec3(CoordinateLimit)));
        }
      });
  }
  return isInside ? "" : "a point of the geometry lies outside of the cube";
}

std::string DescribeGeometryLoss(vtkPolyData* geometry, vtkIdType mostTriangles)
{
  const double loss = GetGeometryLoss(geometry).value_or(0.0);
  const vtkIdType triangles = geometry->GetNumberOfPolys();
  if (triangles == 0 && loss <= MaximumUsefulLoss)
  {
    return "The geometry is empty, because the viewpoints hardly see any surface: fit the cube to "
           "the visible parts of the scene, or increase the resolution.";
  }
  // Reduced geometries may have somewhat fewer triangles than allowed.
  const bool areFew = triangles < mostTriangles / 2;
  return loss > MaximumUsefulLoss ? "With " + std::to_string(triangles) +
      " triangles, the geometry loses " + std::to_string(std::lround(100.0 * loss)) +
      " % of the visible surfaces, and mappers use depth instead: " +
      (areFew ? "increase the resolution, or fit the cube to the scene."
              : "increase GeometryTriangles.")
                                  : "";
}

std::vector<BodyGroupData> ListBodyGroups(
  vtkPolyData* geometry, std::size_t points, std::size_t triangles)
{
  vtkFieldData* fields = geometry->GetFieldData();
  vtkDataArray* sizes = fields->GetArray(GeometryGroupsName);
  vtkDataArray* prototypes = fields->GetArray(GeometryPrototypesName);
  vtkDataArray* placements = fields->GetArray(GeometryPlacementsName);
  if (!sizes || !prototypes || !placements || sizes->GetNumberOfComponents() != 4 ||
    prototypes->GetNumberOfComponents() != 3 || placements->GetNumberOfComponents() != 12)
  {
    return {};
  }
  std::vector<BodyGroupData> groups;
  vtkIdType prototype = 0;
  vtkIdType placement = 0;
  std::size_t point = points;
  std::size_t triangle = triangles;
  for (vtkIdType i = 0; i < sizes->GetNumberOfTuples(); ++i)
  {
    double size[4];
    sizes->GetTuple(i, size);
    if (!(std::min({ size[0], size[1], size[2] }) >= 1.0) ||
      !(size[0] <= static_cast<double>(prototypes->GetNumberOfTuples() - prototype)) ||
      !(size[2] <= static_cast<double>(placements->GetNumberOfTuples() - placement)) ||
      !(size[0] * size[2] <= static_cast<double>(point)) ||
      !(size[1] * size[2] <= static_cast<double>(triangle)))
    {
      return {};
    }
    BodyGroupData& group = groups.emplace_back();
    group.Prototype.resize(static_cast<std::size_t>(size[0]));
    for (glm::dvec3& place : group.Prototype)
    {
      prototypes->GetTuple(prototype++, &place.x);
    }
    group.Triangles = static_cast<std::size_t>(size[1]);
    group.Matrices.resize(static_cast<std::size_t>(size[2]));
    for (std::array<double, 12>& matrix : group.Matrices)
    {
      placements->GetTuple(placement++, matrix.data());
    }
    group.AreBalls = size[3] != 0.0;
    point -= group.Prototype.size() * group.Matrices.size();
    triangle -= group.Triangles * group.Matrices.size();
  }
  if (prototype != prototypes->GetNumberOfTuples() || placement != placements->GetNumberOfTuples())
  {
    return {};
  }
  for (BodyGroupData& group : groups)
  {
    group.FirstPoint = point;
    group.FirstTriangle = triangle;
    point += group.Prototype.size() * group.Matrices.size();
    triangle += group.Triangles * group.Matrices.size();
  }
  return groups;
}
}
