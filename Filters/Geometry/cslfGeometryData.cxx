// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryData.h"

#include "Pipeline/cslfGeometryArrays.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
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
  return data;
}
}
