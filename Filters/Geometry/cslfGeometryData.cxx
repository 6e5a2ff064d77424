// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryData.h"

#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

namespace cslf
{
namespace
{
void AddNumber(const char* name, double number, vtkPolyData* data)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(number);
  data->GetFieldData()->AddArray(array);
}

template <typename Array>
Array* AddArray(const char* name, int components, vtkPolyData* data)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  data->GetFieldData()->AddArray(array);
  return array;
}

void AddGroupArrays(const std::vector<InstanceGroup>& groups, const glm::dvec3& center,
  const glm::dvec3& scale, vtkPolyData* data)
{
  if (groups.empty())
  {
    return;
  }
  auto* sizes = AddArray<vtkIdTypeArray>(GeometryGroupsName, 4, data);
  auto* prototypes = AddArray<vtkDoubleArray>(GeometryPrototypesName, 3, data);
  auto* placements = AddArray<vtkDoubleArray>(GeometryPlacementsName, 12, data);
  for (const InstanceGroup& group : groups)
  {
    sizes->InsertNextTuple4(static_cast<double>(group.Prototype.Points.size()),
      static_cast<double>(group.Prototype.Triangles.size()),
      static_cast<double>(group.Placements.size()), group.IsBall ? 1.0 : 0.0);
    for (const glm::vec3& point : group.Prototype.Points)
    {
      prototypes->InsertNextTuple3(point.x, point.y, point.z);
    }
    for (const InstanceGroup::Placement& placement : group.Placements)
    {
      double matrix[12];
      for (int row = 0; row < 3; ++row)
      {
        for (int column = 0; column < 3; ++column)
        {
          matrix[4 * row + column] = scale[row] * placement.Linear[column][row];
        }
        matrix[4 * row + 3] = center[row] + scale[row] * placement.Offset[row];
      }
      placements->InsertNextTuple(matrix);
    }
  }
}
}

vtkSmartPointer<vtkPolyData> MakePolyData(
  const SurfaceMesh& mesh, const glm::dvec3& center, const glm::dvec3& scale)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const glm::vec3& point : mesh.Points)
  {
    const glm::dvec3 place = center + scale * glm::dvec3(point);
    points->InsertNextPoint(place.x, place.y, place.z);
  }
  vtkNew<vtkCellArray> triangles;
  for (const glm::uvec3& corners : mesh.Triangles)
  {
    triangles->InsertNextCell({ corners.x, corners.y, corners.z });
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

SurfaceMesh MakeMesh(vtkPolyData* data)
{
  SurfaceMesh mesh;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double point[3];
    data->GetPoint(i, point);
    mesh.Points.emplace_back(point[0], point[1], point[2]);
  }
  const std::vector<unsigned int> corners = ListCorners(data);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
  {
    mesh.Triangles.emplace_back(corners[i], corners[i + 1], corners[i + 2]);
  }
  return mesh;
}

vtkSmartPointer<vtkPolyData> MakeGeometryData(const SurfaceMesh& mesh, const glm::dvec3& center,
  const glm::dvec3& scale, const GeometryRecord& record)
{
  vtkSmartPointer<vtkPolyData> data = MakePolyData(mesh, center, scale);
  AddNumber(GeometryErrorName, record.Error, data);
  AddNumber(record.IsOpaque ? GeometryOpaqueLossName : GeometryLossName, record.Loss, data);
  if (!record.Scene.empty())
  {
    vtkNew<vtkStringArray> hash;
    hash->SetName(GeometrySceneName);
    hash->InsertNextValue(record.Scene);
    data->GetFieldData()->AddArray(hash);
  }
  AddGroupArrays(record.Groups, center, scale, data);
  return data;
}
}
