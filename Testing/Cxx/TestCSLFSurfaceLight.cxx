// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Colours of a geometry's points alone show surfaces that look the same from all directions:
// triangles are divided where these jump or bend, and only there, and points are doubled at
// creases. Lamps keep how bright they are.
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"

#include <vtkCellData.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <vector>

namespace
{
void SetUp(vtkCSLFSampler* sampler, vtkPolyData* scene)
{
  sampler->SetInputData(scene);
  sampler->SetViewpoints(3);
  sampler->SetResolution(64);
}

/// A colour for each cell, that of its number.
void AddColors(vtkPolyData* data, const std::vector<std::array<double, 3>>& colors)
{
  vtkNew<vtkUnsignedCharArray> array;
  array->SetName("Own");
  array->SetNumberOfComponents(3);
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    const std::array<double, 3>& color = colors[cell % colors.size()];
    array->InsertNextTuple3(color[0], color[1], color[2]);
  }
  data->GetCellData()->SetScalars(array);
}

/// Six faces of other colours: each corner of the cube has three points, and all are exact.
void TestCreases()
{
  const std::vector<std::array<double, 3>> colors = { { 250.0, 10.0, 20.0 }, { 10.0, 240.0, 30.0 },
    { 40.0, 20.0, 230.0 }, { 220.0, 210.0, 10.0 }, { 15.0, 200.0, 190.0 }, { 90.0, 90.0, 90.0 } };
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  AddColors(cube->GetOutput(), colors);
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, cube->GetOutput());
  sampler->SetColorsToExact();
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  vtkDataArray* exact = geometry->GetPointData()->GetArray("ExactColor");
  CSLF_CHECK(exact != nullptr);
  if (!exact)
  {
    return;
  }
  // The faces have 58 texels along each side: they are divided to edges of 32, and no further.
  std::cout << "Cube: " << geometry->GetNumberOfPolys() << " triangles\n";
  CSLF_CHECK(geometry->GetNumberOfPolys() <= 6 * 64);
  int corners = 0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    double place[3];
    geometry->GetPoint(i, place);
    corners += std::abs(place[0]) > 0.49 && std::abs(place[1]) > 0.49 && std::abs(place[2]) > 0.49;
    CSLF_CHECK(exact->GetComponent(i, 0) == 1.0);
    double color[4];
    geometry->GetPointData()->GetArray("Color")->GetTuple(i, color);
    CSLF_CHECK(std::any_of(colors.begin(), colors.end(),
      [&](const std::array<double, 3>& own)
      {
        return std::abs(own[0] - color[0]) <= 1.0 && std::abs(own[1] - color[1]) <= 1.0 &&
          std::abs(own[2] - color[2]) <= 1.0;
      }));
  }
  CSLF_CHECK(corners == 24);
}

/// The error of the geometry's own colours, on the front, beside a function of the position, over
/// places that are evenly spread on a square of edge 1 in the plane z = 0.
template <typename Expected>
double FindError(vtkPolyData* geometry, const Expected& expected)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(geometry);
  locator->BuildLocator();
  vtkDataArray* colors = geometry->GetPointData()->GetArray("Color");
  constexpr int side = 200;
  double sum = 0.0;
  for (int i = 0; i < side * side; ++i)
  {
    double place[3] = { (i % side + 0.5) / side - 0.5, (i / side + 0.5) / side - 0.5, 0.0 };
    double nearest[3];
    double weights[3];
    double parametric[3];
    double distance = 0.0;
    vtkIdType cell = -1;
    int part = 0;
    locator->FindClosestPoint(place, nearest, cell, part, distance);
    geometry->GetCell(cell)->EvaluatePosition(place, nearest, part, parametric, distance, weights);
    double color = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      color += weights[k] * colors->GetComponent(geometry->GetCell(cell)->GetPointId(k), 0);
    }
    sum += std::pow(color - expected(place[0], place[1]), 2.0);
  }
  return std::sqrt(sum / (side * side));
}

/// A jump within a plane: triangles are small beside it, and only there.
void TestJump()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(3, 1);
  plane->Update();
  AddColors(plane->GetOutput(), { { 40.0, 40.0, 40.0 }, { 200.0, 200.0, 200.0 } });
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, plane->GetOutput());
  sampler->SetColorsToExact();
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  const double error =
    FindError(geometry, [](double x, double) { return std::abs(x) < 1.0 / 6.0 ? 200.0 : 40.0; });
  std::cout << "Jump: " << geometry->GetNumberOfPolys() << " triangles, error " << error << "\n";
  // Two jumps of 58 texels.
  CSLF_CHECK(geometry->GetNumberOfPolys() < 5000);
  CSLF_CHECK(error < 12.0);
  // The limit of triangles counts more.
  sampler->SetGeometryTriangles(100);
  sampler->Update(1);
  CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPolys() <= 100);
}

/// A sheet under a sky of one colour has one colour itself, and needs no more triangles.
void TestSky()
{
  vtkNew<vtkPlaneSource> floor;
  floor->Update();
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, floor->GetOutput());
  sampler->SetIntegratorToRadianceCaching();
  sampler->GetEnvironment()->SetModeToConstant();
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  const double error = FindError(geometry,
    [&](double, double)
    { return geometry->GetPointData()->GetArray("Color")->GetComponent(0, 0); });
  std::cout << "Sky: " << geometry->GetNumberOfPolys() << " triangles, error " << error << "\n";
  CSLF_CHECK(error < 1.0);
  CSLF_CHECK(geometry->GetNumberOfPolys() <= 64);
}

/// Waves of colour under the same sky are not smeared, though the light is only that of a preview.
void TestDetail()
{
  const auto wave = [](double x) { return 128.0 + 80.0 * std::sin(18.0 * x); };
  vtkNew<vtkPlaneSource> floor;
  floor->SetResolution(60, 1);
  floor->Update();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Own");
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < floor->GetOutput()->GetNumberOfPoints(); ++i)
  {
    double place[3];
    floor->GetOutput()->GetPoint(i, place);
    const double level = std::round(wave(place[0]));
    colors->InsertNextTuple3(level, level, level);
  }
  floor->GetOutput()->GetPointData()->SetScalars(colors);
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, floor->GetOutput());
  sampler->SetIntegratorToRadianceCaching();
  sampler->SetQualityToPreview();
  sampler->GetEnvironment()->SetModeToConstant();
  sampler->Update(1);
  const double error = FindError(sampler->GetGeometry(), [&](double x, double) { return wave(x); });
  std::cout << "Detail: " << sampler->GetGeometry()->GetNumberOfPolys() << " triangles, error "
            << error << "\n";
  CSLF_CHECK(error < 2.5);
}

/// The pixels at the outline of a lamp that are neither black nor white.
int CountGray(vtkCSLFSampler* sampler, vtkPolyData* geometry)
{
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(sampler->GetOutputPort());
  mapper->SetGeometryData(geometry);
  cslf::testing::View view(256);
  view.Add(mapper);
  view.GetCamera()->SetPosition(0.3, 0.2, 3.0);
  view.GetCamera()->Roll(20.0);
  const cslf::testing::Picture picture = view.Render();
  CSLF_CHECK(picture.GetMean() > 5.0);
  return static_cast<int>(std::count_if(picture.Colors.begin(), picture.Colors.end(),
    [](unsigned char level) { return level > 2 && level < 253; }));
}

/// Pixels that see a bit of a bright lamp before a black wall are white.
void TestLamp()
{
  vtkNew<vtkPlaneSource> lamp;
  lamp->Update();
  vtkCSLFMaterial::SetBaseColor(lamp->GetOutput(), 0.0, 0.0, 0.0);
  vtkCSLFMaterial::SetEmission(lamp->GetOutput(), 32.0, 32.0, 32.0);
  vtkNew<vtkPlaneSource> wall;
  wall->SetOrigin(-1.0, -1.0, -0.2);
  wall->SetPoint1(1.0, -1.0, -0.2);
  wall->SetPoint2(-1.0, 1.0, -0.2);
  wall->Update();
  vtkCSLFMaterial::SetBaseColor(wall->GetOutput(), 0.0, 0.0, 0.0);
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, lamp->GetOutput());
  scene->SetBlock(1, wall->GetOutput());
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputDataObject(scene);
  sampler->SetViewpoints(3);
  sampler->SetResolution(64);
  sampler->GetEnvironment()->SetModeToNone();
  sampler->Update();
  vtkPolyData* geometry = sampler->GetGeometry();
  vtkDataArray* exact = geometry->GetPointData()->GetArray("ExactColor");
  for (vtkIdType i = 0; exact && i < exact->GetNumberOfTuples(); ++i)
  {
    // Five doublings, or none.
    const bool isLamp = geometry->GetPoint(i)[2] > -0.1;
    CSLF_CHECK(exact->GetComponent(i, 0) == (isLamp ? 41.0 : 1.0));
  }
  const int bright = CountGray(sampler, geometry);
  vtkNew<vtkPolyData> white;
  white->DeepCopy(geometry);
  white->GetPointData()->GetArray("ExactColor")->Fill(1.0);
  const int gray = CountGray(sampler, white);
  std::cout << "Lamp: " << bright << " gray values, without its brightness " << gray << "\n";
  CSLF_CHECK(gray > 1000 && bright < gray / 4);
}

/// What looks different from elsewhere is not exact, though its light is stored.
void TestReflections()
{
  for (const double metallic : { 0.0, 1.0 })
  {
    vtkNew<vtkCubeSource> cube;
    cube->Update();
    vtkCSLFMaterial::SetMetallic(cube->GetOutput(), metallic);
    vtkCSLFMaterial::SetRoughness(cube->GetOutput(), 0.5);
    vtkCSLFMaterial::SetIndexOfRefraction(cube->GetOutput(), 1.5);
    vtkNew<vtkCSLFSampler> sampler;
    SetUp(sampler, cube->GetOutput());
    sampler->SetIntegratorToRadianceCaching();
    sampler->GetEnvironment()->SetModeToGradient();
    sampler->Update(1);
    CSLF_CHECK(sampler->GetGeometry()->GetNumberOfPolys() > 0);
    CSLF_CHECK(sampler->GetGeometry()->GetPointData()->GetArray("Color"));
    CSLF_CHECK(!sampler->GetGeometry()->GetPointData()->GetArray("ExactColor"));
  }
}
}

int TestCSLFSurfaceLight(int, char*[])
{
  TestReflections();
  TestCreases();
  TestJump();
  TestSky();
  TestDetail();
  TestLamp();
  return cslf::testing::Result();
}
