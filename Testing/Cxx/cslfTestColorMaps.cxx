// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTestColorMaps.h"

#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfChannel.h"
#include "cslfColor.h"
#include "cslfTestField.h"
#include "cslfTesting.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iostream>

namespace cslf
{
namespace testing
{
namespace
{
/// The colours of a table in some light.
Table DarkenTable(vtkLookupTable* table, double light)
{
  auto dark = Table::New();
  dark->SetScale(table->GetScale());
  dark->SetTableRange(table->GetTableRange());
  dark->SetNumberOfTableValues(table->GetNumberOfTableValues());
  const auto darken = [light](const double* color)
  {
    return std::array<double, 4>{ Darken(color[0], light), Darken(color[1], light),
      Darken(color[2], light), 1.0 };
  };
  for (vtkIdType i = 0; i < table->GetNumberOfTableValues(); ++i)
  {
    double color[4];
    table->GetTableValue(i, color);
    dark->SetTableValue(i, darken(color).data());
  }
  dark->SetBelowRangeColor(darken(table->GetBelowRangeColor()).data());
  dark->SetUseBelowRangeColor(table->GetUseBelowRangeColor());
  dark->SetAboveRangeColor(darken(table->GetAboveRangeColor()).data());
  dark->SetUseAboveRangeColor(table->GetUseAboveRangeColor());
  dark->SetNanColor(darken(table->GetNanColor()).data());
  return dark;
}

}

Table MakeRainbow(double first, double last, int steps)
{
  auto table = Table::New();
  table->SetNumberOfTableValues(steps);
  table->SetHueRange(0.667, 0.0);
  table->SetTableRange(first, last);
  table->Build();
  return table;
}

Table MakeSteps(double first, double last)
{
  auto table = Table::New();
  table->SetNumberOfTableValues(7);
  for (int i = 0; i < 7; ++i)
  {
    table->SetTableValue(i, 0.9 - 0.1 * i, 0.8 - 0.05 * i, 0.1 + 0.1 * i);
  }
  table->SetTableRange(first, last);
  table->SetBelowRangeColor(0.1, 0.4, 0.1, 1.0);
  table->UseBelowRangeColorOn();
  table->SetAboveRangeColor(0.9, 0.1, 0.6, 1.0);
  table->UseAboveRangeColorOn();
  table->SetNanColor(0.3, 0.3, 0.3, 1.0);
  return table;
}

double Darken(double encoded, double light)
{
  return LinearToSRGB(light * SRGBToLinear(encoded));
}

vtkSmartPointer<vtkPolyData> MakeSphere(
  const std::array<double, 3>& center, double radius, int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(center[0], center[1], center[2]);
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkSmartPointer<vtkPolyData> sphere = source->GetOutput();
  sphere->GetPointData()->Initialize();
  return sphere;
}

void AddBallGroup(
  vtkPolyData* geometry, const std::vector<std::array<double, 4>>& balls, int resolution)
{
  const auto prototype = MakeSphere({ 0.0, 0.0, 0.0 }, 1.0, resolution);
  vtkNew<vtkIdTypeArray> sizes;
  sizes->SetName(GeometryGroupsName);
  sizes->SetNumberOfComponents(4);
  sizes->InsertNextTuple4(static_cast<double>(prototype->GetNumberOfPoints()),
    static_cast<double>(prototype->GetNumberOfPolys()), static_cast<double>(balls.size()), 1.0);
  vtkNew<vtkDoubleArray> points;
  points->SetName(GeometryPrototypesName);
  points->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < prototype->GetNumberOfPoints(); ++i)
  {
    points->InsertNextTuple(prototype->GetPoint(i));
  }
  vtkNew<vtkDoubleArray> placements;
  placements->SetName(GeometryPlacementsName);
  placements->SetNumberOfComponents(12);
  for (const auto& [x, y, z, radius] : balls)
  {
    const double matrix[12] = { radius, 0.0, 0.0, x, 0.0, radius, 0.0, y, 0.0, 0.0, radius, z };
    placements->InsertNextTuple(matrix);
  }
  geometry->GetFieldData()->AddArray(sizes);
  geometry->GetFieldData()->AddArray(points);
  geometry->GetFieldData()->AddArray(placements);
}

void AddColors(vtkPolyData* geometry, vtkLookupTable* table, const MapLook& look)
{
  MappedPoints points;
  points.Maps = { MakeColorMap(table) };
  points.Maps[0].Array = "Height";
  const vtkIdType count = geometry->GetNumberOfPoints();
  vtkDataArray* colors[2];
  for (int side = 0; side < 2; ++side)
  {
    const auto array =
      vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(look.ColorType));
    array->SetName(side == 0 ? ColorName : BackColorName);
    array->SetNumberOfComponents(4);
    array->SetNumberOfTuples(count);
    geometry->GetPointData()->AddArray(array);
    colors[side] = array;
  }
  vtkNew<vtkUnsignedCharArray> exact;
  exact->SetName(ExactColorName);
  exact->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points.Numbers.push_back(1);
    points.Scalars.push_back(look.Scalar(geometry->GetPoint(i)));
    for (const std::size_t side : { 0, 1 })
    {
      const double light = side == 0 ? look.Front : look.Back;
      points.Light[side].emplace_back(static_cast<float>(EncodeLight(light)));
      const glm::dvec3 color = ShowLight(
        points.Light[side].back(), points.Maps[0], points.GetPlace(static_cast<std::size_t>(i)));
      const bool isEncoded = look.ColorType == VTK_UNSIGNED_CHAR;
      SetColor(colors[side], i, glm::vec4(isEncoded ? color : SRGBToLinear(color), 1.0));
    }
    exact->InsertNextTuple2(1.0, 1.0);
  }
  geometry->GetPointData()->AddArray(exact);
  vtkNew<vtkDoubleArray> loss;
  loss->SetName(GeometryLossName);
  loss->InsertNextValue(look.Loss);
  geometry->GetFieldData()->AddArray(loss);
  AddMappedPoints(points, geometry);
}

vtkSmartPointer<vtkCSLFMapper> MakeMapper(vtkPolyData* geometry, int type)
{
  const int depth = type == VTK_UNSIGNED_CHAR ? VTK_UNSIGNED_SHORT : VTK_FLOAT;
  auto mapper = vtkSmartPointer<vtkCSLFMapper>::New();
  mapper->SetInputData(MakeTestField(Layout(2, 16), Cube(), type, depth));
  mapper->SetGeometryData(geometry);
  mapper->SetPixelSamples(1);
  return mapper;
}

Picture DrawByVTK(vtkPolyData* geometry, vtkLookupTable* table, double light, vtkCamera* camera)
{
  View view(MapSize);
  view.GetCamera()->DeepCopy(camera);
  // It would prefer the table that the array has.
  vtkNew<vtkPolyData> surface;
  surface->DeepCopy(geometry);
  surface->GetPointData()->GetArray("Height")->SetLookupTable(nullptr);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(surface);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("Height");
  mapper->SetLookupTable(DarkenTable(table, light));
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  view.Add(mapper)->GetProperty()->LightingOff();
  return view.Render();
}

double CountDifferent(const Picture& a, const Picture& b)
{
  const auto isInside = [&](int column, int row)
  {
    for (int i = 0; i < 25; ++i)
    {
      const int x = std::clamp(column + i % 5 - 2, 0, MapSize - 1);
      const int y = std::clamp(row + i / 5 - 2, 0, MapSize - 1);
      if (b.Depths[static_cast<std::size_t>(y) * MapSize + x] >= 1.0)
      {
        return false;
      }
    }
    return true;
  };
  int inside = 0;
  int different = 0;
  for (int pixel = 0; pixel < MapSize * MapSize; ++pixel)
  {
    if (isInside(pixel % MapSize, pixel / MapSize))
    {
      ++inside;
      int largest = 0;
      for (int c = 0; c < 3; ++c)
      {
        const auto at = static_cast<std::size_t>(3 * pixel + c);
        largest = std::max(largest, std::abs(a.Colors[at] - b.Colors[at]));
      }
      different += largest > 2 ? 1 : 0;
    }
  }
  CSLF_CHECK(inside > 300);
  return static_cast<double>(different) / std::max(inside, 1);
}

MapComparison::MapComparison(vtkPolyData* geometry, int type)
  : Geometry(geometry)
  , Mapper(MakeMapper(geometry, type))
{
  this->Actor = this->Field.Add(this->Mapper);
  this->Field.GetCamera()->SetPosition(2.6, 2.2, 3.6);
  this->Mapper->AddObserver(vtkCommand::WarningEvent, this->Warnings);
}

void MapComparison::Check(const std::string& name, vtkLookupTable* shown, double light)
{
  const Picture drawn = this->Field.Render();
  const Picture expected = DrawByVTK(this->Geometry, shown, light, this->Field.GetCamera());
  const double different = CountDifferent(drawn, expected);
  std::cout << name << ": " << 100.0 * different << " % of the pixels differ\n";
  CSLF_CHECK(different < 0.004);
}

std::string MapComparison::TakeWarning()
{
  const std::string text =
    this->Warnings->GetWarning() ? this->Warnings->GetWarningMessage() : std::string();
  this->Warnings->Clear();
  return text;
}
}
}
