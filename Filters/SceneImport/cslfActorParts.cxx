// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfActorParts.h"

#include "vtkCSLFMaterial.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkGraphMapper.h>
#include <vtkMapper.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

namespace cslf
{
namespace
{
vtkSmartPointer<vtkDoubleArray> MakeRadii(const char* name, vtkIdType count)
{
  auto radii = vtkSmartPointer<vtkDoubleArray>::New();
  radii->SetName(name);
  radii->SetNumberOfTuples(count);
  return radii;
}
}

std::optional<ActorParts> TakeApart(vtkActor* actor, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  vtkMapper* mapper = actor->GetMapper();
  if (mapper->IsA("vtkMoleculeMapper"))
  {
    return TakeMoleculeApart(actor, mapper, matrix, scene);
  }
  if (auto* graph = vtkGraphMapper::SafeDownCast(mapper))
  {
    return TakeGraphApart(graph, scene);
  }
  if (auto* splats = vtkPointGaussianMapper::SafeDownCast(mapper))
  {
    return TakeSplatsApart(actor, splats, matrix, scene);
  }
  auto* shapes = vtkPolyDataMapper::SafeDownCast(mapper);
  if (shapes && shapes->IsA("vtkOpenGLSphereMapper"))
  {
    return TakeSpheresApart(actor, shapes, matrix, scene);
  }
  if (shapes && shapes->IsA("vtkOpenGLStickMapper"))
  {
    return TakeSticksApart(actor, shapes, matrix, scene);
  }
  return std::nullopt;
}

vtkSmartPointer<vtkProperty> CopyProperty(vtkProperty* property)
{
  auto copy = vtkSmartPointer<vtkProperty>::New();
  copy->DeepCopy(property);
  copy->SetEmissiveFactor(property->GetEmissiveFactor());
  copy->GetAllTextures().clear(); // it has not been registered as their user
  for (const auto& [name, texture] : property->GetAllTextures())
  {
    copy->SetTexture(name.c_str(), texture);
  }
  return copy;
}

ActorPart MakePart(vtkPolyData* data, vtkActor* whole, vtkMatrix4x4* matrix)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  ActorPart part;
  part.Actor = vtkSmartPointer<vtkActor>::New();
  part.Actor->SetMapper(mapper);
  part.Actor->SetProperty(CopyProperty(whole->GetProperty()));
  part.Actor->GetProperty()->SetRepresentationToSurface();
  part.Actor->GetProperty()->EdgeVisibilityOff();
  part.Actor->GetProperty()->VertexVisibilityOff();
  part.Actor->SetTexture(whole->GetTexture());
  part.Matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  part.Matrix->DeepCopy(matrix ? matrix : whole->GetMatrix());
  return part;
}

vtkSmartPointer<vtkPolyData> MakeSpheres(
  vtkPoints* points, vtkDataArray* radii, vtkUnsignedCharArray* colors)
{
  auto spheres = vtkSmartPointer<vtkPolyData>::New();
  spheres->SetPoints(points);
  vtkNew<vtkCellArray> vertices;
  const vtkSmartPointer<vtkDoubleArray> ofPoints =
    MakeRadii(vtkCSLFMaterial::PointRadiusName(), points->GetNumberOfPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
    ofPoints->SetValue(i, radii->GetComponent(i, 0));
  }
  spheres->SetVerts(vertices);
  spheres->GetPointData()->AddArray(ofPoints);
  spheres->GetPointData()->SetScalars(colors);
  return spheres;
}

vtkSmartPointer<vtkPolyData> MakeSticks(
  vtkPoints* centers, vtkDataArray* scales, vtkDataArray* directions, vtkUnsignedCharArray* colors)
{
  const vtkIdType count = centers->GetNumberOfPoints();
  vtkNew<vtkPoints> ends;
  ends->SetDataTypeToDouble();
  ends->SetNumberOfPoints(2 * count);
  vtkNew<vtkCellArray> lines;
  const vtkSmartPointer<vtkDoubleArray> radii =
    MakeRadii(vtkCSLFMaterial::LineRadiusName(), 2 * count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double center[3];
    centers->GetPoint(i, center);
    const vtkIdType line[2] = { 2 * i, 2 * i + 1 };
    for (int end = 0; end < 2; ++end)
    {
      const double along = (end == 0 ? -0.5 : 0.5) * scales->GetComponent(i, 0);
      ends->SetPoint(line[end], center[0] + along * directions->GetComponent(i, 0),
        center[1] + along * directions->GetComponent(i, 1),
        center[2] + along * directions->GetComponent(i, 2));
      radii->SetValue(line[end], scales->GetComponent(i, 1));
    }
    lines->InsertNextCell(2, line);
  }
  auto sticks = vtkSmartPointer<vtkPolyData>::New();
  sticks->SetPoints(ends);
  sticks->SetLines(lines);
  sticks->GetPointData()->AddArray(radii);
  sticks->GetCellData()->SetScalars(colors);
  return sticks;
}
}
