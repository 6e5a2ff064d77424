// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Small balls, sticks and instances stay one mesh at many places in the geometry and in its file:
// they are where they belong, have their colours, and what is damaged or moved is not taken for
// them.
#include "Coding/Geometry/cslfGeometryCodec.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfCube.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFSampler.h"

#include <vtkCellArray.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

namespace
{
const cslf::Cube Box{ { 3.0, -2.0, 1.0 }, { 8.0, 4.0, 8.0 } };
constexpr int Resolution = 64;
int Count = 16; // along each side of a layer
constexpr double Spacing = 0.34;
constexpr double BallRadius = 0.12;
constexpr double StickRadius = 0.04;
constexpr double HalfEdge = 0.1;

/// The points of a grid in a layer of the cube.
std::array<double, 3> GetPlace(int i, int layer)
{
  return { Box.Center.x + Spacing * (i % Count - 0.5 * (Count - 1)), Box.Center.y + layer - 1.0,
    Box.Center.z + Spacing * (i / Count - 0.5 * (Count - 1)) };
}

void AddRadius(const char* name, double radius, vtkPolyData* data)
{
  vtkNew<vtkFloatArray> radii;
  radii->SetName(name);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    radii->InsertNextValue(static_cast<float>(radius));
  }
  data->GetPointData()->AddArray(radii);
}

/// Red and green that vary from body to body.
void AddColors(vtkPolyData* data, int each)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const auto body = static_cast<int>(i) / each;
    colors->InsertNextTuple3(100.0 + 8.0 * (body % Count), 200.0 - 8.0 * (body / Count), 128.0);
  }
  data->GetPointData()->SetScalars(colors);
}

vtkSmartPointer<vtkPolyData> MakeBalls()
{
  auto balls = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> vertices;
  for (int i = 0; i < Count * Count; ++i)
  {
    vertices->InsertNextCell({ points->InsertNextPoint(GetPlace(i, 0).data()) });
  }
  balls->SetPoints(points);
  balls->SetVerts(vertices);
  AddRadius("CSLF:PointRadius", BallRadius, balls);
  AddColors(balls, 1);
  return balls;
}

vtkSmartPointer<vtkPolyData> MakeSticks()
{
  auto sticks = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> lines;
  for (int i = 0; i < Count * Count; ++i)
  {
    std::array<double, 3> place = GetPlace(i, 1);
    const vtkIdType first = points->InsertNextPoint(place.data());
    place[0] += 0.2;
    place[1] += 0.02 * (i % Count);
    lines->InsertNextCell({ first, points->InsertNextPoint(place.data()) });
  }
  sticks->SetPoints(points);
  sticks->SetLines(lines);
  AddRadius("CSLF:LineRadius", StickRadius, sticks);
  AddColors(sticks, 2);
  return sticks;
}

/// Cubes, every other one mirrored.
vtkSmartPointer<vtkPolyData> MakeCubes()
{
  vtkNew<vtkCubeSource> source;
  source->SetXLength(2.0 * HalfEdge);
  source->SetYLength(HalfEdge);
  source->SetZLength(2.0 * HalfEdge);
  source->Update();
  vtkSmartPointer<vtkPolyData> cubes = source->GetOutput();
  vtkNew<vtkDoubleArray> matrices;
  matrices->SetName("CSLF:InstanceMatrix");
  matrices->SetNumberOfComponents(16);
  for (int i = 0; i < Count * Count; ++i)
  {
    const std::array<double, 3> place = GetPlace(i, 2);
    vtkNew<vtkTransform> transform;
    transform->Translate(place.data());
    transform->RotateY(10.0 * i);
    transform->Scale(1.0, 1.0, i % 2 == 0 ? 1.0 : -1.0);
    matrices->InsertNextTuple(transform->GetMatrix()->GetData());
  }
  cubes->GetFieldData()->AddArray(matrices);
  return cubes;
}

vtkSmartPointer<vtkPolyData> SampleScene(vtkMultiBlockDataSet* scene, int triangles)
{
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(scene);
  sampler->AutomaticCubeOff();
  sampler->SetCubeCenter(Box.Center.x, Box.Center.y, Box.Center.z);
  sampler->SetCubeEdges(Box.Edges.x, Box.Edges.y, Box.Edges.z);
  sampler->SetViewpoints(2);
  sampler->SetResolution(Resolution);
  sampler->SetGeometryTriangles(triangles);
  sampler->SetMaximumDepth(1);
  sampler->Update(1);
  auto geometry = vtkSmartPointer<vtkPolyData>::New();
  geometry->ShallowCopy(sampler->GetGeometry());
  return geometry;
}

vtkSmartPointer<vtkPolyData> Sample(int triangles)
{
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, MakeBalls());
  scene->SetBlock(1, MakeSticks());
  scene->SetBlock(2, MakeCubes());
  return SampleScene(scene, triangles);
}

vtkDataArray* GetGroups(vtkPolyData* geometry)
{
  return geometry->GetFieldData()->GetArray(cslf::GeometryGroupsName);
}

/// All points of balls, sticks and cubes lie near their surfaces, and triangles face outward.
void CheckPlaces(vtkPolyData* geometry)
{
  double worst = 0.0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    double point[3];
    geometry->GetPoint(i, point);
    double nearest = 1.0;
    for (int body = 0; body < Count * Count; ++body)
    {
      const std::array<double, 3> place = GetPlace(body, 0);
      const double away = std::hypot(point[0] - place[0], point[1] - place[1], point[2] - place[2]);
      nearest = std::min(nearest, std::abs(away - BallRadius));
      if (std::abs(point[1] - Box.Center.y) < 0.5)
      {
        nearest = 0.0; // sticks and their ends: see the loss
      }
      const std::array<double, 3> middle = GetPlace(body, 2);
      const double x = point[0] - middle[0];
      const double z = point[2] - middle[2];
      if (std::abs(std::abs(point[1] - middle[1]) - 0.5 * HalfEdge) < 0.002)
      {
        nearest = std::min(nearest, std::abs(std::hypot(x, z) - std::sqrt(2.0) * HalfEdge));
      }
    }
    worst = std::max(worst, nearest);
  }
  std::cout << "Points lie up to " << worst << " from where they should.\n";
  CSLF_CHECK(worst < 0.02);
}

/// Of more tiny balls than the limit allows, larger ones stand for all: together they are as wide.
void TestThinning()
{
  constexpr int points = 6000;
  constexpr double radius = 0.01;
  constexpr int triangles = 1000;
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> places;
  vtkNew<vtkCellArray> vertices;
  for (int i = 0; i < points; ++i)
  {
    const double x = std::fmod(0.618034 * i, 1.0) - 0.5;
    const double z = (i + 0.5) / points - 0.5;
    vertices->InsertNextCell({ places->InsertNextPoint(
      Box.Center.x + 6.0 * x, Box.Center.y + 0.1 * x, Box.Center.z + 6.0 * z) });
  }
  cloud->SetPoints(places);
  cloud->SetVerts(vertices);
  AddRadius("CSLF:PointRadius", radius, cloud);
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, cloud);
  const auto geometry = SampleScene(scene, triangles);
  CSLF_CHECK(GetGroups(geometry) && GetGroups(geometry)->GetComponent(0, 3) == 1.0);
  CSLF_CHECK(geometry->GetNumberOfPolys() <= 5 * triangles);
  CSLF_CHECK(geometry->GetNumberOfPolys() > 4 * triangles);
  vtkDataArray* placements = geometry->GetFieldData()->GetArray(cslf::GeometryPlacementsName);
  double sum = 0.0;
  for (vtkIdType i = 0; placements && i < placements->GetNumberOfTuples(); ++i)
  {
    sum += std::pow(placements->GetComponent(i, 0) / radius, 2.0);
  }
  CSLF_CHECK(placements);
  std::cout << geometry->GetNumberOfPolys() << " triangles of balls stand for " << points
            << ", and are as wide as " << sum << ".\n";
  CSLF_CHECK(std::abs(sum - points) < 0.05 * points);
}

double FindColorError(vtkPolyData* geometry, vtkPolyData* other)
{
  vtkDataArray* a = geometry->GetPointData()->GetArray("Color");
  vtkDataArray* b = other->GetPointData()->GetArray("Color");
  CSLF_CHECK(a && b && a->GetNumberOfTuples() == b->GetNumberOfTuples());
  double sum = 0.0;
  for (vtkIdType i = 0; i < a->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      sum += std::pow(a->GetComponent(i, c) - b->GetComponent(i, c), 2.0);
    }
    CSLF_CHECK(b->GetComponent(i, 3) == 255.0);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(a->GetNumberOfTuples())));
}

void TestCodec(vtkPolyData* geometry)
{
  std::string error;
  const std::vector<unsigned char> bytes = cslf::EncodeGeometry(geometry, Box, Resolution, error);
  CSLF_CHECK(!bytes.empty() && error.empty());
  const auto decoded = cslf::DecodeGeometry(bytes, Box, error);
  CSLF_CHECK(decoded && GetGroups(decoded));
  CSLF_CHECK(decoded->GetNumberOfPoints() == geometry->GetNumberOfPoints());
  CSLF_CHECK(decoded->GetNumberOfPolys() == geometry->GetNumberOfPolys());
  CheckPlaces(decoded);
  double worst = 0.0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    double a[3];
    double b[3];
    geometry->GetPoint(i, a);
    decoded->GetPoint(i, b);
    worst = std::max(worst, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  const double colorError = FindColorError(geometry, decoded);
  std::cout << geometry->GetNumberOfPoints() << " points take " << bytes.size()
            << " bytes, move by up to " << worst << ", and their colours by " << colorError
            << ".\n";
  // A step is a 64th of a texel.
  CSLF_CHECK(worst < 3.0 * 8.0 / (64.0 * Resolution));
  CSLF_CHECK(colorError < 2.5);

  // Files of files do not get worse.
  const auto again = cslf::EncodeGeometry(decoded, Box, Resolution, error);
  const auto twice = cslf::DecodeGeometry(again, Box, error);
  CSLF_CHECK(twice && GetGroups(twice));
  CSLF_CHECK(FindColorError(geometry, twice) < 3.0);

  // What was moved without its arrays is stored as triangles.
  vtkNew<vtkTransform> shift;
  shift->Translate(0.01, 0.0, 0.0);
  vtkNew<vtkTransformPolyDataFilter> mover;
  mover->SetInputData(geometry);
  mover->SetTransform(shift);
  mover->Update();
  const auto more = cslf::EncodeGeometry(mover->GetOutput(), Box, Resolution, error);
  const auto plain = cslf::DecodeGeometry(more, Box, error);
  CSLF_CHECK(bytes.size() < more.size());
  CSLF_CHECK(plain && !GetGroups(plain));
  CSLF_CHECK(plain->GetNumberOfPolys() == geometry->GetNumberOfPolys());

  // Damaged bytes are refused, or make a geometry whose triangles have points.
  int refused = 0;
  for (std::size_t place = 0; place < std::min<std::size_t>(bytes.size(), 2000); ++place)
  {
    for (const int change : { 1, 5, 128 })
    {
      std::vector<unsigned char> damaged = bytes;
      damaged[place] = static_cast<unsigned char>(damaged[place] + change);
      const auto found = cslf::DecodeGeometry(damaged, Box, error);
      refused += found ? 0 : 1;
      CSLF_CHECK(!found || cslf::DescribeGeometryError(found, Box).empty());
    }
  }
  std::cout << refused << " of 6000 damaged ones are refused.\n";
  CSLF_CHECK(refused > 3000);
}
}

int TestCSLFGeometryBodies(int, char*[])
{
  const auto geometry = Sample(200000);
  vtkDataArray* groups = GetGroups(geometry);
  CSLF_CHECK(groups && groups->GetNumberOfTuples() >= 3);
  double points = 0.0;
  double triangles = 0.0;
  for (vtkIdType i = 0; i < groups->GetNumberOfTuples(); ++i)
  {
    points += groups->GetComponent(i, 0) * groups->GetComponent(i, 2);
    triangles += groups->GetComponent(i, 1) * groups->GetComponent(i, 2);
  }
  CSLF_CHECK(points == static_cast<double>(geometry->GetNumberOfPoints()));
  CSLF_CHECK(triangles == static_cast<double>(geometry->GetNumberOfPolys()));
  CSLF_CHECK(cslf::GetGeometryLoss(geometry).value_or(1.0) < 0.002);
  CheckPlaces(geometry);
  TestCodec(geometry);

  // Bodies may have five times as many triangles as other surfaces, and not more.
  const auto coarse = Sample(200);
  CSLF_CHECK(!GetGroups(coarse) && coarse->GetNumberOfPolys() <= 200);

  TestThinning();

  // A few bodies are smaller as triangles.
  Count = 6;
  const auto few = Sample(200000);
  CSLF_CHECK(GetGroups(few));
  std::string error;
  const auto decoded =
    cslf::DecodeGeometry(cslf::EncodeGeometry(few, Box, Resolution, error), Box, error);
  CSLF_CHECK(decoded && !GetGroups(decoded));
  CSLF_CHECK(decoded && decoded->GetNumberOfPolys() == few->GetNumberOfPolys());
  return cslf::testing::Result();
}
