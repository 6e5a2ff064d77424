// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// A geometry that alone shows a field is drawn without viewpoints: balls as spheres, whatever their
// triangles; while the view moves with fewer triangles, and when it rests with all of them.
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfCube.h"
#include "cslfDescription.h"
#include "cslfMeshLevels.h"
#include "cslfTestColorMaps.h"
#include "cslfTestField.h"
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFMapper.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <thread>
#include <vector>

namespace
{
using cslf::testing::Picture;
using cslf::testing::View;

constexpr int Size = 200;
constexpr double HalfHeight = 2.0; // of the picture, in world coordinates

const cslf::Cube Box{ { 1.0, 2.0, -3.0 }, { 5.0, 3.0, 3.6 } };

struct Sphere
{
  std::array<double, 3> Center;
  double Radius;
};

/// Large ones, and a row of small ones, since a few balls are drawn as triangles.
std::vector<Sphere> ListSpheres()
{
  std::vector<Sphere> spheres = { { { 0.0, 2.2, -3.0 }, 0.9 }, { { 2.4, 1.7, -2.5 }, 0.6 },
    { { 1.2, 3.0, -4.2 }, 0.3 } };
  for (int i = 0; i < 40; ++i)
  {
    spheres.push_back({ { -1.0 + 0.1 * i, 0.8, -2.0 - 0.02 * i }, 0.04 });
  }
  return spheres;
}

const std::vector<Sphere> Spheres = ListSpheres();

vtkSmartPointer<vtkPolyData> MakeSphere(const Sphere& sphere, int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(sphere.Center[0], sphere.Center[1], sphere.Center[2]);
  source->SetRadius(sphere.Radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

/// Red grows along X over a sphere, green along Y, blue along Z.
std::array<double, 3> GetColor(const Sphere& sphere, const double* point)
{
  std::array<double, 3> color;
  for (int axis = 0; axis < 3; ++axis)
  {
    color[axis] = 128.0 + 100.0 * (point[axis] - sphere.Center[axis]) / sphere.Radius;
  }
  return color;
}

/// Spheres as a geometry that alone shows a field.
vtkSmartPointer<vtkPolyData> MakeGeometry(const std::vector<Sphere>& spheres, int resolution)
{
  vtkNew<vtkAppendPolyData> append;
  append->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Color");
  colors->SetNumberOfComponents(4);
  vtkNew<vtkUnsignedCharArray> exact;
  exact->SetName(cslf::ExactColorName);
  exact->SetNumberOfComponents(2);
  for (const Sphere& sphere : spheres)
  {
    const auto data = MakeSphere(sphere, resolution);
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      const auto color = GetColor(sphere, data->GetPoint(i));
      colors->InsertNextTuple4(
        std::round(color[0]), std::round(color[1]), std::round(color[2]), 255.0);
      exact->InsertNextTuple2(1.0, 1.0);
    }
    append->AddInputData(data);
  }
  append->Update();
  vtkSmartPointer<vtkPolyData> geometry = append->GetOutput();
  geometry->GetPointData()->Initialize();
  geometry->GetPointData()->AddArray(colors);
  geometry->GetPointData()->AddArray(exact);
  for (const char* name : { cslf::GeometryErrorName, cslf::GeometryLossName })
  {
    vtkNew<vtkDoubleArray> number;
    number->SetName(name);
    number->InsertNextValue(0.0);
    geometry->GetFieldData()->AddArray(number);
  }
  return geometry;
}

/// Tells that the spheres of a geometry are balls at several places.
void AddGroups(vtkPolyData* geometry, const std::vector<Sphere>& spheres, int resolution)
{
  std::vector<std::array<double, 4>> balls;
  for (const Sphere& sphere : spheres)
  {
    balls.push_back({ sphere.Center[0], sphere.Center[1], sphere.Center[2], sphere.Radius });
  }
  cslf::testing::AddBallGroup(geometry, balls, resolution);
}

vtkSmartPointer<vtkCSLFMapper> MakeMapper(vtkPolyData* geometry)
{
  static const auto field =
    cslf::testing::MakeTestField(cslf::Layout(2, 16), Box, VTK_UNSIGNED_CHAR, VTK_UNSIGNED_SHORT);
  auto mapper = vtkSmartPointer<vtkCSLFMapper>::New();
  mapper->SetInputData(field);
  mapper->SetGeometryData(geometry);
  return mapper;
}

/// Looks along -z.
void LookAlongZ(vtkCamera* camera, bool isParallel)
{
  camera->SetFocalPoint(Box.Center.x, Box.Center.y, Box.Center.z);
  camera->SetPosition(Box.Center.x, Box.Center.y, Box.Center.z + 8.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetParallelProjection(isParallel);
  camera->SetParallelScale(HalfHeight);
  camera->SetViewAngle(30.0);
  camera->SetClippingRange(2.0, 14.0);
}

/// Depths and colours of all pixels of a parallel projection are those of spheres.
void TestSpheres(vtkPolyData* geometry)
{
  View view(Size);
  LookAlongZ(view.GetCamera(), true);
  const auto mapper = MakeMapper(geometry);
  view.Add(mapper);
  const Picture picture = view.Render();
  int wrong = 0;
  int covered = 0;
  double worstDepth = 0.0;
  double worstColor = 0.0;
  for (int row = 0; row < Size; ++row)
  {
    for (int column = 0; column < Size; ++column)
    {
      const double x = Box.Center.x + HalfHeight * ((2.0 * column + 1.0) / Size - 1.0);
      const double y = Box.Center.y + HalfHeight * ((2.0 * row + 1.0) / Size - 1.0);
      const std::size_t pixel = static_cast<std::size_t>(row) * Size + column;
      double nearest = -1e30;
      std::array<double, 3> color{};
      bool isEdge = false;
      for (const Sphere& sphere : Spheres)
      {
        const double away = std::hypot(x - sphere.Center[0], y - sphere.Center[1]);
        isEdge = isEdge || std::abs(away - sphere.Radius) < 3.0 * HalfHeight / Size;
        if (away < sphere.Radius)
        {
          const double z =
            sphere.Center[2] + std::sqrt(sphere.Radius * sphere.Radius - away * away);
          const double point[3] = { x, y, z };
          color = z > nearest ? GetColor(sphere, point) : color;
          nearest = std::max(nearest, z);
        }
      }
      if (isEdge)
      {
        continue;
      }
      const bool isExpected = nearest > -1e30;
      covered += isExpected ? 1 : 0;
      wrong += isExpected != (picture.Depths[pixel] < 1.0) ? 1 : 0;
      if (isExpected && picture.Depths[pixel] < 1.0)
      {
        const double z = Box.Center.z + 8.0 - (2.0 + 12.0 * picture.Depths[pixel]);
        // The nearest of the rays of a pixel counts.
        worstDepth = std::max(worstDepth, std::abs(z - nearest));
        for (int i = 0; i < 3; ++i)
        {
          worstColor = std::max(worstColor, std::abs(picture.Colors[3 * pixel + i] - color[i]));
        }
      }
    }
  }
  std::cout << covered << " pixels show spheres, " << wrong << " wrongly; depths err by up to "
            << worstDepth << ", colours by up to " << worstColor << ".\n";
  CSLF_CHECK(covered > 5000);
  CSLF_CHECK(wrong == 0);
  CSLF_CHECK(worstDepth < 0.08);
  CSLF_CHECK(worstColor < 16.0);

  // A plane cuts the triangles.
  const int whole = picture.CountDrawn();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(Box.Center.x, Box.Center.y, Box.Center.z);
  plane->SetNormal(1.0, 0.0, 0.0);
  mapper->AddClippingPlane(plane);
  const int half = view.Render().CountDrawn();
  std::cout << whole << " pixels, " << half << " beyond the plane.\n";
  CSLF_CHECK(half > whole / 5 && half < whole / 2);
}

/// The perspective of balls is that of finely divided spheres, drawn by VTK.
void TestPerspective(vtkPolyData* geometry)
{
  View view(Size);
  LookAlongZ(view.GetCamera(), false);
  view.GetCamera()->Azimuth(25.0);
  view.GetCamera()->Elevation(20.0);
  view.GetCamera()->OrthogonalizeViewUp();
  const auto mapper = MakeMapper(geometry);
  mapper->SetPixelSamples(1);
  const auto actor = view.Add(mapper);
  const Picture balls = view.Render();
  view.Renderer->RemoveActor(actor);
  vtkNew<vtkAppendPolyData> append;
  for (const Sphere& sphere : Spheres)
  {
    append->AddInputData(MakeSphere(sphere, 200));
  }
  vtkNew<vtkPolyDataMapper> fine;
  fine->SetInputConnection(append->GetOutputPort());
  view.Add(fine);
  const Picture spheres = view.Render();
  const double same = cslf::testing::CompareDepths(balls, spheres, view.GetCamera(), 0.01);
  std::cout << balls.CountDrawn() << " and " << spheres.CountDrawn() << " pixels, " << same
            << " of them as deep.\n";
  CSLF_CHECK(std::abs(balls.CountDrawn() - spheres.CountDrawn()) < 40);
  CSLF_CHECK(same > 0.99);
}

/// Balls that are not where the field data says are drawn where their triangles are.
void TestStale()
{
  constexpr int Coarse = 12;
  std::vector<Sphere> moved = Spheres;
  for (Sphere& sphere : moved)
  {
    sphere.Center[0] += 0.2;
  }
  const auto geometry = MakeGeometry(Spheres, Coarse);
  View view(Size);
  LookAlongZ(view.GetCamera(), false);
  const auto actor = view.Add(MakeMapper(geometry));
  const Picture triangles = view.Render();
  view.Renderer->RemoveActor(actor);
  AddGroups(geometry, moved, Coarse);
  view.Add(MakeMapper(geometry));
  CSLF_CHECK(cslf::testing::ComparePictures(view.Render(), triangles) == 99.0);
}

/// Levels have about half of the triangles each, of the same points; closed parts come first.
void TestLevels()
{
  // Boxes with points of their own on each side, which cannot be reduced without joining them.
  vtkNew<vtkAppendPolyData> boxes;
  for (int i = 0; i < 2000; ++i)
  {
    vtkNew<vtkCubeSource> source;
    source->SetCenter(0.1 * (i % 40), 0.1 * (i / 40), 0.0);
    source->SetXLength(0.05);
    source->SetYLength(0.05);
    source->SetZLength(0.05);
    source->Update();
    boxes->AddInputData(source->GetOutput());
  }
  boxes->Update();
  for (const auto& data :
    { MakeSphere(Spheres.front(), 200), vtkSmartPointer<vtkPolyData>(boxes->GetOutput()) })
  {
    std::vector<glm::vec3> points;
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      const double* point = data->GetPoint(i);
      points.emplace_back(point[0], point[1], point[2]);
    }
    std::vector<std::uint32_t> corners;
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
    {
      vtkNew<vtkIdList> ids;
      data->GetCellPoints(cell, ids);
      for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i)
      {
        for (const vtkIdType corner : { vtkIdType(0), i - 1, i })
        {
          corners.push_back(static_cast<std::uint32_t>(ids->GetId(corner)));
        }
      }
    }
    cslf::MeshLevelMaker maker;
    const cslf::MeshLevels* levels = maker.Find(points, corners, corners.size());
    for (int i = 0; !levels && i < 1000; ++i)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      levels = maker.Find(points, corners, corners.size());
    }
    CSLF_CHECK(levels && !levels->Levels.empty());
    if (!levels)
    {
      continue;
    }
    std::size_t before = corners.size() / 3;
    for (const cslf::MeshLevel& level : levels->Levels)
    {
      std::cout << level.CountTriangles() << " of " << before << " triangles\n";
      CSLF_CHECK(level.ClosedEnd == level.End && level.End <= levels->Corners.size());
      CSLF_CHECK(4 * level.CountTriangles() <= 3 * before);
      before = level.CountTriangles();
    }
    CSLF_CHECK(std::all_of(levels->Corners.begin(), levels->Corners.end(),
      [&](std::uint32_t corner) { return corner < points.size(); }));
  }
}

/// However long and fast a view moved, its still picture is that of a view that did not, after a
/// first one with fewer triangles.
void TestRest()
{
  constexpr int Finely = 300;
  const std::vector<Sphere> one = { Spheres.front() };
  const auto geometry = MakeGeometry(one, Finely);
  View still(Size);
  LookAlongZ(still.GetCamera(), false);
  still.Add(MakeMapper(geometry));
  const Picture expected = still.Render();

  View view(Size);
  LookAlongZ(view.GetCamera(), false);
  const auto mapper = MakeMapper(geometry);
  mapper->StreamingOn();
  view.Add(mapper);
  view.Window->SetDesiredUpdateRate(100000.0);
  int drawn = 0;
  for (int i = 0; i < 60; ++i)
  {
    view.GetCamera()->Azimuth(6.0);
    drawn += view.Render().CountDrawn() > 0 ? 1 : 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  CSLF_CHECK(drawn == 60);
  view.Window->SetDesiredUpdateRate(0.0001);
  LookAlongZ(view.GetCamera(), false);
  Picture picture = view.Render();
  const double first = cslf::testing::ComparePictures(picture, expected);
  int pictures = 1;
  while (!mapper->IsComplete() && pictures < 20)
  {
    picture = view.Render();
    ++pictures;
  }
  const double last = cslf::testing::ComparePictures(picture, expected);
  std::cout << "The first picture has " << first << " dB, the one after " << pictures << " " << last
            << ".\n";
  CSLF_CHECK(mapper->IsComplete());
  CSLF_CHECK(first > 20.0 && first < 60.0);
  CSLF_CHECK(last > 60.0);
}
}

int TestCSLFMapperLevels(int, char*[])
{
  constexpr int Coarse = 12;
  const auto geometry = MakeGeometry(Spheres, Coarse);
  AddGroups(geometry, Spheres, Coarse);
  TestSpheres(geometry);
  TestPerspective(geometry);
  TestStale();
  TestLevels();
  TestRest();
  return cslf::testing::Result();
}
