// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Polygons that touch or cross themselves are filled by the even-odd rule, and others are
// triangulated as by VTK. What cannot be filled is counted.
#include "Pipeline/cslfTriangleList.h"
#include "cslfTesting.h"
#include "vtkCSLFSceneImporter.h"
#include "vtkCSLFViewTracer.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTestErrorObserver.h>
#include <vtkTriangleFilter.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{
using Corners = std::vector<glm::dvec3>;

/// Data of one polygon with all corners, or with these of them.
vtkSmartPointer<vtkPolyData> MakePolygon(
  const Corners& corners, const std::vector<vtkIdType>& order = std::vector<vtkIdType>())
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<vtkIdType> cell;
  for (const glm::dvec3& corner : corners)
  {
    cell.push_back(points->InsertNextPoint(corner.x, corner.y, corner.z));
  }
  if (!order.empty())
  {
    cell = order;
  }
  vtkNew<vtkCellArray> polygons;
  polygons->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polygons);
  return data;
}

/// Calls `visit` with the corners of each triangle.
template <typename Visit>
void ForEachTriangle(vtkPolyData* triangles, Visit visit)
{
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < triangles->GetNumberOfPolys(); ++i)
  {
    triangles->GetPolys()->GetCellAtId(i, ids);
    glm::dvec3 corners[3];
    for (int k = 0; k < 3; ++k)
    {
      triangles->GetPoint(ids->GetId(k), &corners[k].x);
    }
    visit(corners);
  }
}

double GetArea(vtkPolyData* triangles)
{
  double area = 0.0;
  ForEachTriangle(triangles,
    [&area](const glm::dvec3* t)
    { area += 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0])); });
  return area;
}

/// The number of triangles over a place of the plane z = 0.
int CountOver(vtkPolyData* triangles, const glm::dvec2& place)
{
  int count = 0;
  ForEachTriangle(triangles,
    [&](const glm::dvec3* t)
    {
      int left = 0;
      int right = 0;
      for (int k = 0; k < 3; ++k)
      {
        const glm::dvec2 begin(t[k]);
        const glm::dvec2 side = glm::dvec2(t[(k + 1) % 3]) - begin;
        const double cross = side.x * (place.y - begin.y) - side.y * (place.x - begin.x);
        left += cross > 0.0 ? 1 : 0;
        right += cross < 0.0 ? 1 : 0;
      }
      count += left == 3 || right == 3 ? 1 : 0;
    });
  return count;
}

/// Whether a place of the plane z = 0 belongs to a polygon, by the even-odd rule.
bool IsInside(const Corners& corners, const glm::dvec2& place)
{
  bool inside = false;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const glm::dvec3& a = corners[i];
    const glm::dvec3& b = corners[(i + 1) % corners.size()];
    if ((a.y > place.y) != (b.y > place.y) &&
      place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y))
    {
      inside = !inside;
    }
  }
  return inside;
}

double GetDistance(const Corners& corners, const glm::dvec2& place)
{
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const glm::dvec2 a(corners[i]);
    const glm::dvec2 side = glm::dvec2(corners[(i + 1) % corners.size()]) - a;
    const double length = glm::dot(side, side);
    const double t = length > 0.0 ? glm::dot(place - a, side) / length : 0.0;
    least = std::min(least, glm::length(a + std::clamp(t, 0.0, 1.0) * side - place));
  }
  return least;
}

void TestFills()
{
  struct Case
  {
    const char* Name;
    Corners Outline;
    double Area;
  };
  const double angle = 0.8 * vtkMath::Pi();
  Corners star;
  for (int i = 0; i < 5; ++i)
  {
    star.emplace_back(std::cos(angle * i), std::sin(angle * i), 0.0);
  }
  // The tips, without the pentagon between them.
  const double inner = std::cos(0.4 * vtkMath::Pi()) / std::cos(0.2 * vtkMath::Pi());
  const double tips = 5.0 *
    (inner * std::sin(0.2 * vtkMath::Pi()) - inner * inner * 0.5 * std::sin(0.4 * vtkMath::Pi()));
  const std::vector<Case> cases = {
    { "hole, outline the other way",
      { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 0, 0, 0 }, { 1, 1, 0 }, { 1, 3, 0 },
        { 3, 3, 0 }, { 3, 1, 0 }, { 1, 1, 0 } },
      12.0 },
    { "hole, outline the same way",
      { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 0, 0, 0 }, { 1, 1, 0 }, { 3, 1, 0 },
        { 3, 3, 0 }, { 1, 3, 0 }, { 1, 1, 0 } },
      12.0 },
    { "bow tie", { { 0, 0, 0 }, { 2, 2, 0 }, { 2, 0, 0 }, { 0, 2, 0 } }, 2.0 },
    { "pixel", { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, { 2, 2, 0 } }, 2.0 },
    { "bow tie of different wings", { { 0, 0, 0 }, { 3, 3, 0 }, { 3, 0, 0 }, { 0, 1, 0 } },
      0.375 + 3.375 },
    { "bow tie that is not flat", { { 0, 0, 0 }, { 2, 2, 0.01 }, { 2, 0, 0 }, { 0, 2, 0.01 } },
      2.0 },
    { "star", star, tips },
    { "doubled corners",
      { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 2, 2, 0 }, { 0, 2, 0 } }, 4.0 },
    { "spike", { { 0, 0, 0 }, { 2, 0, 0 }, { 4, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 } },
      4.0 },
    { "spike to the inside",
      { { 0, 0, 0 }, { 2, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 } }, 4.0 },
    { "two squares at a corner",
      { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 2, 1, 0 }, { 2, 2, 0 }, { 1, 2, 0 }, { 1, 1, 0 },
        { 0, 1, 0 } },
      2.0 },
    { "collinear corners",
      { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 2, 2, 0 }, { 1, 2, 0 }, { 0, 2, 0 } },
      4.0 },
    { "outline that runs twice",
      { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 },
        { 0, 1, 0 } },
      3.0 },
    { "arrow", { { 0, 0, 0 }, { 2, 0, 0 }, { 0.5, 0.5, 0 }, { 0, 2, 0 } }, 1.0 },
    { "comb",
      { { 0, 0, 0 }, { 5, 0, 0 }, { 5, 2, 0 }, { 4, 2, 0 }, { 4, 1, 0 }, { 3, 1, 0 }, { 3, 2, 0 },
        { 2, 2, 0 }, { 2, 1, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 0, 2, 0 } },
      8.0 },
    { "fan of more than a turn",
      { { 0.693687652, 0.288243626, 0 }, { 0.160247155, 0.77854394, 0 },
        { 0.855441197, 0.67008781, 0 }, { 0.0845946634, 0.708750356, 0 },
        { 0.202693224, 0.970861243, 0 } },
      0.0 },
  };
  struct Space
  {
    double Size;
    glm::dvec3 Place;
  };
  for (const Case& test : cases)
  {
    for (const Space& space : { Space{ 1.0, glm::dvec3(0.0) }, Space{ 1e-12, glm::dvec3(0.0) },
           Space{ 1e12, glm::dvec3(0.0) }, Space{ 0.001, glm::dvec3(5432109.0, 512345.0, 99.0) } })
    {
      Corners outline;
      for (const glm::dvec3& corner : test.Outline)
      {
        outline.push_back(space.Place + space.Size * corner);
      }
      const cslf::Triangulation filled = cslf::TriangulatePolygons(MakePolygon(outline));
      const double area = GetArea(filled.Triangles) / space.Size / space.Size;
      if (test.Area > 0.0 && !(std::abs(area - test.Area) < 1e-4 * test.Area))
      {
        std::cerr << test.Name << ", size " << space.Size << ": " << area << "\n";
        CSLF_CHECK(false);
      }
      CSLF_CHECK(area > 0.0 && filled.WithoutArea == 0 && filled.Tangled == 0);
    }
  }
}

/// Corners at random, and on a grid, where many touch.
void TestRandom()
{
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> random(0.0, 1.0);
  int probes = 0;
  int wrong = 0;
  for (int i = 0; i < 1500; ++i)
  {
    const int count = 4 + static_cast<int>(random(generator) * 8.0);
    Corners outline;
    for (int k = 0; k < count; ++k)
    {
      glm::dvec3 corner(random(generator), random(generator), 0.0);
      outline.push_back(i % 2 == 0 ? corner : glm::floor(4.0 * corner) / 3.0);
    }
    const vtkSmartPointer<vtkPolyData> triangles = cslf::Triangulate(MakePolygon(outline));
    for (int k = 0; k < 20; ++k)
    {
      const glm::dvec2 place(random(generator), random(generator));
      if (GetDistance(outline, place) > 1e-4)
      {
        ++probes;
        wrong += CountOver(triangles, place) != (IsInside(outline, place) ? 1 : 0) ? 1 : 0;
      }
    }
  }
  CSLF_CHECK(probes > 25000);
  CSLF_CHECK(wrong == 0);
}

/// Values at the place where edges cross, and those of the cell.
void TestValues()
{
  const vtkSmartPointer<vtkPolyData> tie =
    MakePolygon({ { 0, 0, 0 }, { 3, 3, 0 }, { 3, 0, 0 }, { 0, 1, 0 } });
  tie->GetPolys()->InsertNextCell({ 0, 2, 1 });
  vtkNew<vtkFloatArray> heights;
  heights->SetName("Heights");
  for (float height : { 0.0f, 4.0f, 0.0f, 8.0f })
  {
    heights->InsertNextValue(height);
  }
  tie->GetPointData()->SetScalars(heights);
  vtkNew<vtkIntArray> numbers;
  numbers->SetName("Numbers");
  numbers->InsertNextValue(17);
  numbers->InsertNextValue(4);
  tie->GetCellData()->SetScalars(numbers);
  const vtkSmartPointer<vtkPolyData> filled = cslf::Triangulate(tie);
  CSLF_CHECK(filled->GetNumberOfPoints() == 5 && tie->GetNumberOfPoints() == 4);
  CSLF_CHECK(filled->GetNumberOfPolys() == 3);
  // The edges cross at a quarter of both, from the first corner and from the last.
  double place[3];
  filled->GetPoint(4, place);
  CSLF_CHECK_NEAR(place[0], 0.75, 1e-6);
  CSLF_CHECK_NEAR(place[1], 0.75, 1e-6);
  CSLF_CHECK_NEAR(filled->GetPointData()->GetScalars()->GetTuple1(4), 0.5 * (1.0 + 6.0), 1e-5);
  CSLF_CHECK(filled->GetPointData()->GetScalars()->GetNumberOfTuples() == 5);
  CSLF_CHECK(heights->GetNumberOfTuples() == 4);
  vtkDataArray* cells = filled->GetCellData()->GetScalars();
  CSLF_CHECK(cells->GetNumberOfTuples() == 3 && filled->GetCellData()->GetNumberOfArrays() == 1);
  CSLF_CHECK(cells->GetTuple1(0) == 4 && cells->GetTuple1(1) == 17 && cells->GetTuple1(2) == 17);
}

/// Triangles face as the polygon does.
void TestFacing()
{
  Corners hole = { { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 0, 0, 0 }, { 1, 1, 0 },
    { 1, 3, 0 }, { 3, 3, 0 }, { 3, 1, 0 }, { 1, 1, 0 } };
  for (const double up : { 1.0, -1.0 })
  {
    ForEachTriangle(cslf::Triangulate(MakePolygon(hole)),
      [up](const glm::dvec3* t) { CSLF_CHECK(up * glm::cross(t[1] - t[0], t[2] - t[0]).z > 0.0); });
    std::reverse(hole.begin(), hole.end());
  }
  // Bow ties, whose parts face both ways: the first corners decide, not which part is larger.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.1, 0.1);
  for (int i = 0; i < 50; ++i)
  {
    const double middle = 0.5 + shift(random);
    const vtkSmartPointer<vtkPolyData> tie =
      MakePolygon({ { 0, 0, 0 }, { 1, shift(random), 0 }, { 0, 1, 0 }, { 1, middle + 0.5, 0 } });
    CSLF_CHECK(GetArea(cslf::Triangulate(tie)) > 0.1);
    ForEachTriangle(cslf::Triangulate(tie),
      [](const glm::dvec3* t) { CSLF_CHECK(glm::cross(t[1] - t[0], t[2] - t[0]).z > 0.0); });
  }
}

/// Polygons that VTK triangulates keep its triangles.
void TestSame()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(9, 7);
  plane->Update();
  vtkNew<vtkRegularPolygonSource> disk;
  disk->SetNumberOfSides(60);
  disk->Update();
  const vtkSmartPointer<vtkPolyData> arrow =
    MakePolygon({ { 0, 0, 0 }, { 2, 0, 0 }, { 0.5, 0.5, 0.1 }, { 0.2, 1.2, 0 }, { 0, 2, 0 } });
  const vtkSmartPointer<vtkPolyData> folded =
    MakePolygon({ { 0, 0, 0 }, { 1, 0, 0.9 }, { 1, 1, 0 }, { 0, 1, 0.9 } });
  for (vtkPolyData* data : { plane->GetOutput(), disk->GetOutput(), arrow.Get(), folded.Get() })
  {
    vtkNew<vtkTriangleFilter> filter;
    filter->SetInputData(data);
    filter->PassLinesOff();
    filter->Update();
    const vtkSmartPointer<vtkPolyData> ours = cslf::Triangulate(data);
    vtkPolyData* theirs = filter->GetOutput();
    CSLF_CHECK(ours->GetNumberOfPolys() == theirs->GetNumberOfPolys());
    vtkNew<vtkIdList> ids[2];
    for (vtkIdType i = 0; i < theirs->GetNumberOfPolys(); ++i)
    {
      ours->GetPolys()->GetCellAtId(i, ids[0]);
      theirs->GetPolys()->GetCellAtId(i, ids[1]);
      for (int k = 0; k < 3; ++k)
      {
        CSLF_CHECK(ids[0]->GetId(k) == ids[1]->GetId(k));
      }
    }
  }
}

/// What cannot be filled, and large polygons.
void TestLimits()
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CSLF_CHECK(
    cslf::TriangulatePolygons(MakePolygon({ { 0, 0, 0 }, { 1, nan, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }))
      .NotFinite == 1);
  for (const Corners& flat : { Corners{ { 0, 0, 0 }, { 1, 1, 0 }, { 2, 2, 0 }, { 3, 3, 0 } },
         Corners(7, glm::dvec3(1, 2, 3)), Corners(10000, glm::dvec3(1, 2, 3)),
         Corners{ { 0, 0, 0 }, { 1, 0, 0 } } })
  {
    const cslf::Triangulation none = cslf::TriangulatePolygons(MakePolygon(flat));
    CSLF_CHECK(none.WithoutArea == 1 && none.Triangles->GetNumberOfPolys() == 0);
  }
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> random(0.0, 1.0);
  Corners tangle;
  Corners circle;
  for (int i = 0; i < 100000; ++i)
  {
    tangle.emplace_back(random(generator), random(generator), 0.0);
    const double angle = 2.0 * vtkMath::Pi() * i / 100000.0;
    circle.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  CSLF_CHECK(cslf::TriangulatePolygons(MakePolygon(tangle)).Tangled == 1);
  const vtkSmartPointer<vtkPolyData> disk = cslf::Triangulate(MakePolygon(circle));
  CSLF_CHECK(disk->GetNumberOfPolys() == 99998);
  CSLF_CHECK_NEAR(GetArea(disk), vtkMath::Pi(), 1e-6);
}

/// A picture of a square with a hole, and the warning about polygons without an area.
void TestPicture()
{
  const vtkSmartPointer<vtkPolyData> hole =
    MakePolygon({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, { -0.5, -0.5, 0 },
                  { 0.5, -0.5, 0 }, { 0.5, 0.5, 0 }, { -0.5, 0.5, 0 } },
      { 0, 1, 2, 3, 0, 4, 5, 6, 7, 4 });
  hole->GetPolys()->InsertNextCell({ 0, 4, 6, 2 });
  vtkNew<vtkCSLFViewTracer> tracer;
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 5);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(2.0);
  tracer->SetCamera(camera);
  tracer->SetSize(40, 40);
  tracer->SetSamples(16);
  tracer->SetColorTypeToFloat();
  vtkNew<vtkTest::ErrorObserver> messages;
  tracer->AddObserver(vtkCommand::WarningEvent, messages);
  tracer->SetInputDataObject(hole);
  tracer->Update();
  vtkDataArray* colors = tracer->GetOutput()->GetPointData()->GetScalars();
  double area = 0.0;
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    area += 0.01 * colors->GetComponent(i, 3);
  }
  CSLF_CHECK_NEAR(area, 3.0, 1e-6);
  CSLF_CHECK(colors->GetComponent(20 * 40 + 20, 3) == 0.0);
  CSLF_CHECK(messages->GetWarningMessage().find("left out: 1 polygon(s) without an area.") !=
    std::string::npos);
}

/// A clipping plane of a mapper cuts the filled polygon, and a warning names what it leaves out.
void TestClipped()
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const vtkSmartPointer<vtkPolyData> hole =
    MakePolygon({ { 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 }, { 0, 4, 0 }, { 0, 0, 0 }, { 1, 1, 0 },
                  { 1, 3, 0 }, { 3, 3, 0 }, { 3, 1, 0 }, { 1, 1, 0 }, { 4, nan, 0 } },
      { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9 });
  hole->GetPolys()->InsertNextCell({ 0, 5, 7, 2 });
  hole->GetPolys()->InsertNextCell({ 0, 1, 2, 10 });
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(2, 0, 0);
  plane->SetNormal(1, 0, 0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(hole);
  mapper->AddClippingPlane(plane);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkCSLFSceneImporter> importer;
  importer->SetRenderer(renderer);
  vtkNew<vtkTest::ErrorObserver> messages;
  importer->AddObserver(vtkCommand::WarningEvent, messages);
  importer->Update();
  for (const char* what : { cslf::PolygonsWithoutArea, cslf::NotFinitePolygons })
  {
    CSLF_CHECK(messages->GetWarningMessage().find(std::string("1 ") + what) != std::string::npos);
  }
  auto* block = vtkPolyData::SafeDownCast(importer->GetOutput()->GetBlock(0));
  CSLF_CHECK_NEAR(GetArea(cslf::Triangulate(block)), 6.0, 1e-6);
}
}

int TestCSLFPolygons(int, char*[])
{
  TestFills();
  TestRandom();
  TestValues();
  TestFacing();
  TestSame();
  TestLimits();
  TestPicture();
  TestClipped();
  return cslf::testing::Result();
}
