// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Mapped points keep their maps in all kinds of geometries: with sides, in bright light, beside
// points that are not mapped, as balls, and where viewpoints are looked up as well.
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfColor.h"
#include "cslfTestColorMaps.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkReverseSense.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using cslf::ColorMap;
using cslf::testing::AddBallGroup;
using cslf::testing::AddColors;
using cslf::testing::CountDifferent;
using cslf::testing::Darken;
using cslf::testing::DrawByVTK;
using cslf::testing::MakeMapper;
using cslf::testing::MakeRainbow;
using cslf::testing::MakeSphere;
using cslf::testing::MakeSteps;
using cslf::testing::MapComparison;
using cslf::testing::MapLight;
using cslf::testing::MapLook;
using cslf::testing::MapSize;
using cslf::testing::Picture;
using cslf::testing::Table;
using cslf::testing::View;

constexpr double Radius = 0.8;

vtkSmartPointer<vtkPolyData> MakePlane()
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-0.8, -0.8, 0.0);
  source->SetPoint1(0.8, -0.8, 0.0);
  source->SetPoint2(-0.8, 0.8, 0.0);
  source->Update();
  vtkSmartPointer<vtkPolyData> plane = source->GetOutput();
  plane->GetPointData()->Initialize();
  return plane;
}

/// Sides, light brighter than white, several rays for a pixel, and linear fields.
void TestLight()
{
  const auto plane = MakePlane();
  const Table own = MakeRainbow(-0.8, 0.8, 9);
  MapLook sides;
  sides.Scalar = [](const double* point) { return point[0]; };
  sides.Back = 0.2;
  AddColors(plane, own, sides);
  MapComparison sheet(plane);
  vtkCamera* camera = sheet.Field.GetCamera();
  sheet.Check("front", own);
  camera->SetPosition(0.5, 0.3, -5.0);
  sheet.Check("back", own, sides.Back);
  const Table steps = MakeSteps(-0.5, 0.5);
  sheet.Mapper->SetLookupTable(steps);
  sheet.Mapper->UseLookupTableScalarRangeOn();
  sheet.Check("back in another table", steps, sides.Back);
  camera->SetPosition(0.5, 0.3, 5.0);
  sheet.Check("front in another table", steps);

  // The mesh of closed parts is turned to the outside.
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputData(MakeSphere({ 0.0, 0.0, 0.0 }, Radius));
  reverse->Update();
  vtkPolyData* turned = reverse->GetOutput();
  sides.Front = 0.2;
  sides.Back = MapLight;
  AddColors(turned, own, sides);
  MapComparison ball(turned);
  ball.Check("turned", own);
  ball.Mapper->SetLookupTable(MakeSteps(0.0, 1.0));
  ball.Check("turned, in another table", MakeSteps(-0.8, 0.8));

  // Dark colours in bright light.
  MapLook bright;
  bright.Front = 4.0;
  bright.Back = 4.0;
  const auto sphere = MakeSphere({ 0.0, 0.0, 0.0 }, Radius, 40);
  Table dark = MakeRainbow(-Radius, Radius, 8);
  dark->SetValueRange(0.4, 0.5);
  dark->ForceBuild();
  AddColors(sphere, dark, bright);
  MapComparison lamp(sphere);
  lamp.Check("bright light", dark, 4.0);
  lamp.Mapper->SetLookupTable(MakeRainbow(0.0, 1.0, 8));
  lamp.Check("too bright light", MakeRainbow(-Radius, Radius, 8), 4.0);
  lamp.Mapper->SetPixelSamples(2);
  lamp.Mapper->SetLookupTable(dark);
  const Picture means = lamp.Field.Render();
  const Picture expected = DrawByVTK(sphere, dark, 4.0, lamp.Field.GetCamera());
  const double different = CountDifferent(means, expected);
  std::cout << "means of rays: " << 100.0 * different << " % differ\n";
  CSLF_CHECK(different < 0.12); // where bands meet

  MapLook linear;
  linear.ColorType = VTK_FLOAT;
  const auto floats = MakeSphere({ 0.0, 0.0, 0.0 }, Radius, 40);
  AddColors(floats, own, linear);
  MapComparison numbers(floats, VTK_FLOAT);
  numbers.Check("linear field", own);
}

/// Geometries that do not show the field alone.
void TestNotAlone()
{
  const auto geometry = MakeSphere({ 0.0, 0.0, 0.0 }, Radius, 40);
  const Table own = MakeRainbow(-Radius, Radius, 20);
  MapLook look;
  look.Loss = 0.05;
  AddColors(geometry, own, look);
  MapComparison sphere(geometry);
  sphere.Check("not alone", own);
  CSLF_CHECK(sphere.TakeWarning().empty());
  const Table steps = MakeSteps(-Radius, Radius);
  sphere.Mapper->SetLookupTable(steps);
  sphere.Check("not alone, in another table", steps);
  CSLF_CHECK(sphere.TakeWarning().find("alone") != std::string::npos);
  sphere.Field.Render();
  CSLF_CHECK(sphere.TakeWarning().empty()); // once

  // By depth, and without scalars, a table changes nothing.
  sphere.Mapper->SetGeometryData(MakeSphere({ 0.0, 0.0, 0.0 }, Radius, 40));
  sphere.Field.Render();
  CSLF_CHECK(sphere.TakeWarning().find("no geometry with scalars") != std::string::npos);
}

/// Joins parts, whose points have the maps of these numbers, or none.
vtkSmartPointer<vtkPolyData> Join(const std::vector<vtkSmartPointer<vtkPolyData>>& parts,
  const std::vector<int>& numbers, const std::vector<ColorMap>& maps)
{
  vtkNew<vtkAppendPolyData> append;
  for (const auto& part : parts)
  {
    append->AddInputData(part);
  }
  append->Update();
  vtkSmartPointer<vtkPolyData> all = append->GetOutput();
  AddColors(all, MakeSteps(-1.0, 1.0));
  cslf::MappedPoints points;
  points.Maps = maps;
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    for (vtkIdType i = 0; i < parts[part]->GetNumberOfPoints(); ++i)
    {
      points.Numbers.push_back(static_cast<std::uint8_t>(numbers[part]));
      points.Scalars.push_back(numbers[part] > 0 ? parts[part]->GetPoint(i)[2] : 0.0);
      for (const std::size_t side : { 0, 1 })
      {
        points.Light[side].emplace_back(static_cast<float>(cslf::EncodeLight(MapLight)));
      }
    }
  }
  cslf::AddMappedPoints(points, all);
  return all;
}

/// Parts with two maps, and one without: each is drawn as if it was alone.
void TestSeveral()
{
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  for (const double x : { -0.6, 0.0, 0.6 })
  {
    parts.push_back(MakeSphere({ x, 0.0, 0.0 }, 0.28, 40));
  }
  const Table first = MakeRainbow(-0.28, 0.28, 12);
  const Table second = MakeSteps(-0.1, 0.2);
  std::vector<ColorMap> maps = { cslf::MakeColorMap(first), cslf::MakeColorMap(second) };
  maps[0].Array = "Height";
  maps[1].Array = "Weight";
  maps[1].Component = "Magnitude";
  const auto geometry = Join(parts, { 1, 0, 2 }, maps);
  MapComparison several(geometry);
  several.Field.GetCamera()->SetPosition(0.9, 0.9, 5.0);
  const auto check = [&](const Picture& drawn, int part, vtkLookupTable* shown)
  {
    AddColors(parts[part], shown);
    const Picture expected = DrawByVTK(parts[part], shown, MapLight, several.Field.GetCamera());
    const double different = CountDifferent(drawn, expected);
    std::cout << "part " << part << ": " << 100.0 * different << " % differ\n";
    CSLF_CHECK(different < 0.004);
  };
  Picture drawn = several.Field.Render();
  check(drawn, 0, first);
  check(drawn, 2, second);
  const auto middle = static_cast<std::size_t>(3 * (MapSize / 2 * MapSize + MapSize / 2));
  const std::array<unsigned char, 3> plain = { drawn.Colors[middle], drawn.Colors[middle + 1],
    drawn.Colors[middle + 2] };

  // One of them, by the names that the field and its geometry have for it.
  const Table steps = MakeRainbow(0.0, 1.0, 5);
  several.Mapper->SetLookupTable(steps);
  for (const char* name : { "Weight", "Weight Magnitude" })
  {
    several.Mapper->SelectColorArray(name);
    drawn = several.Field.Render();
    check(drawn, 0, first);
    check(drawn, 2, MakeRainbow(-0.1, 0.2, 5));
    CSLF_CHECK_NEAR(several.Mapper->GetScalarRange()[1], 0.2, 1e-12);
  }
  CSLF_CHECK(several.TakeWarning().empty());
  for (std::size_t c = 0; c < 3; ++c)
  {
    CSLF_CHECK(drawn.Colors[middle + c] == plain[c]);
  }
}

/// Actors that share a mapper have plain colours of their own.
void TestShared()
{
  const auto geometry = MakeSphere({ 0.0, 0.0, 0.0 }, 0.5, 40);
  AddColors(geometry, MakeRainbow(-0.5, 0.5));
  const auto mapper = MakeMapper(geometry);
  mapper->ScalarVisibilityOff();
  View view(MapSize);
  const double colors[2][3] = { { 0.9, 0.2, 0.1 }, { 0.1, 0.3, 0.8 } };
  for (int i = 0; i < 2; ++i)
  {
    const auto actor = view.Add(mapper);
    actor->SetPosition(i == 0 ? -0.6 : 0.6, 0.0, 0.0);
    actor->GetProperty()->SetDiffuseColor(colors[i][0], colors[i][1], colors[i][2]);
  }
  view.GetCamera()->SetPosition(0.0, 0.0, 5.0);
  view.Render();
  const Picture picture = view.Render();
  for (int i = 0; i < 2; ++i)
  {
    const int column = MapSize / 2 + (i == 0 ? -1 : 1) * MapSize / 5;
    for (int c = 0; c < 3; ++c)
    {
      CSLF_CHECK_NEAR(
        picture.Colors[static_cast<std::size_t>(3 * (MapSize / 2 * MapSize + column) + c)],
        255.0 * Darken(colors[i][c], MapLight), 2.0);
    }
  }
}

/// Balls have colours of their own in graphics memory.
void TestBalls()
{
  constexpr double Small = 0.14;
  std::vector<std::array<double, 4>> spheres;
  vtkNew<vtkAppendPolyData> append;
  for (int i = 0; i < 36; ++i)
  {
    const std::array<double, 3> center{ -0.75 + 0.3 * (i % 6), -0.75 + 0.3 * (i / 6),
      0.05 * (i % 5) };
    spheres.push_back({ center[0], center[1], center[2], Small });
    append->AddInputData(MakeSphere(center, Small, 16));
  }
  append->Update();
  vtkPolyData* geometry = append->GetOutput();
  MapLook look;
  look.Scalar = [](const double* point) { return std::floor((point[0] + 0.9) / 0.3); };
  const Table own = MakeRainbow(0.0, 5.0);
  AddColors(geometry, own, look);
  AddBallGroup(geometry, spheres, 16);
  MapComparison balls(geometry);
  balls.Field.GetCamera()->SetPosition(0.3, 0.2, 5.0); // none hides another
  balls.Check("balls", own);
  const Table steps = MakeSteps(0.5, 4.5);
  balls.Mapper->SetLookupTable(steps);
  balls.Mapper->SetScalarRange(0.5, 4.5);
  balls.Check("balls in another table", steps);
}
}

int TestCSLFMapperColorMapParts(int, char*[])
{
  TestLight();
  TestNotAlone();
  TestSeveral();
  TestShared();
  TestBalls();
  return cslf::testing::Result();
}
