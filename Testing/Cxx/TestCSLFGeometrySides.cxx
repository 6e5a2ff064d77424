// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The geometry of a field has colours for what no viewpoint sees: on both sides of sheets, not
// those of what is hidden, and on large triangles as many as shadows need. The lookup shows those
// of the side that is seen.
#include "cslfTestView.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFGeometryFilter.h"
#include "vtkCSLFMapper.h"
#include "vtkCSLFSampler.h"

#include <vtkActor.h>
#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkCubeSource.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkReverseSense.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iostream>

namespace
{
constexpr int Size = 64;

/// Direct light from above.
void SetUp(vtkCSLFSampler* sampler, vtkPolyData* scene)
{
  sampler->SetInputData(scene);
  sampler->SetIntegratorToPathTracing();
  sampler->GetEnvironment()->SetModeToGradient();
  sampler->SetViewpoints(5);
  sampler->SetResolution(64);
  sampler->SetSamples(64);
  sampler->SetMaximumDepth(1);
}

/// A square of that size in the middle, whose front looks up.
vtkSmartPointer<vtkPolyData> MakeSheet(double edge)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-0.5 * edge, 0.0, 0.5 * edge);
  source->SetPoint1(0.5 * edge, 0.0, 0.5 * edge);
  source->SetPoint2(-0.5 * edge, 0.0, -0.5 * edge);
  source->Update();
  return source->GetOutput();
}

/// The brightness of a side at a point.
double GetRed(vtkPolyData* geometry, const char* side, vtkIdType point)
{
  return geometry->GetPointData()->GetArray(side)->GetComponent(point, 0);
}

void TestSheet()
{
  // A floor in the background, which rays beside the sheet meet.
  vtkNew<vtkCubeSource> floor;
  floor->SetBounds(-0.95, 0.95, -0.95, -0.9, -0.95, 0.95);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputData(MakeSheet(1.8));
  both->AddInputConnection(floor->GetOutputPort());
  both->Update();
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, both->GetOutput());
  sampler->AutomaticCubeOff();
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  // The square has 58 texels along each side.
  CSLF_CHECK(geometry->GetNumberOfPolys() >= 8 && geometry->GetNumberOfPolys() < 300);
  CSLF_CHECK(geometry->GetPointData()->GetArray("BackColor"));
  if (!geometry->GetPointData()->GetArray("BackColor"))
  {
    return;
  }
  double range[2] = { 255.0, 0.0 }; // the darkest front and the brightest back
  int points = 0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    if (std::abs(geometry->GetPoint(i)[1]) > 0.01)
    {
      continue;
    }
    ++points;
    range[0] = std::min(range[0], GetRed(geometry, "Color", i));
    range[1] = std::max(range[1], GetRed(geometry, "BackColor", i));
  }
  std::cout << "front at least " << range[0] << ", back at most " << range[1] << "\n";
  CSLF_CHECK(points > 8 && range[0] > 180.0 && range[1] < 120.0);

  // The same from the field's depth. Its triangles may have their front on either side, and where
  // parts of the surface meet, some have no area and so no side.
  vtkNew<vtkCSLFGeometryFilter> filter;
  filter->SetInputConnection(sampler->GetOutputPort());
  filter->Update(1);
  geometry = filter->GetGeometry();
  CSLF_CHECK(geometry->GetPointData()->GetArray("BackColor"));
  if (!geometry->GetPointData()->GetArray("BackColor"))
  {
    return;
  }
  int right = 0;
  points = 0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    points += std::abs(geometry->GetPoint(i)[1]) < 0.1 ? 1 : 0;
    if (std::abs(geometry->GetPoint(i)[1]) > 0.1)
    {
      continue;
    }
    const double sides[2] = { GetRed(geometry, "Color", i), GetRed(geometry, "BackColor", i) };
    right += std::max(sides[0], sides[1]) > 180.0 && std::min(sides[0], sides[1]) < 120.0 ? 1 : 0;
  }
  std::cout << right << " of " << points << " right\n";
  CSLF_CHECK(right > 0.7 * points);
}

/// A closed box sticks in a sheet. Its inside is dark, which nobody sees.
void TestHidden()
{
  vtkNew<vtkCubeSource> box;
  box->SetBounds(-0.5, 0.5, -0.1, 0.4, -0.5, 0.5);
  vtkNew<vtkAppendPolyData> both;
  both->AddInputConnection(box->GetOutputPort());
  both->AddInputData(MakeSheet(4.0));
  both->Update();
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, both->GetOutput());
  sampler->Update(1);
  vtkPolyData* geometry = sampler->GetGeometry();
  int beneath = 0;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    double point[3];
    geometry->GetPoint(i, point);
    if (std::abs(point[1]) < 0.01 && std::abs(point[0]) < 0.4 && std::abs(point[2]) < 0.4)
    {
      ++beneath;
      CSLF_CHECK(GetRed(geometry, "Color", i) > 150.0);
    }
  }
  CSLF_CHECK(beneath > 0);

  // Nobody sees the back of closed surfaces.
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  SetUp(sampler, sphere->GetOutput());
  sampler->Update(1);
  CSLF_CHECK(sampler->GetGeometry()->GetPointData()->GetArray("Color"));
  CSLF_CHECK(!sampler->GetGeometry()->GetPointData()->GetArray("BackColor"));
}

/// The colour in the middle of a picture.
std::array<int, 2> GetRedAndGreen(const cslf::testing::Picture& picture)
{
  const std::size_t middle = 3 * (Size / 2 * Size + Size / 2);
  return { picture.Colors[middle], picture.Colors[middle + 1] };
}

/// Red on the front, green on the back.
void AddColors(vtkPolyData* geometry)
{
  for (const char* name : { "Color", "BackColor" })
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName(name);
    colors->SetNumberOfComponents(4);
    for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
    {
      const bool isFront = name[0] == 'C';
      colors->InsertNextTuple4(isFront ? 200.0 : 0.0, isFront ? 0.0 : 100.0, 0.0, 255.0);
    }
    geometry->GetPointData()->AddArray(colors);
  }
}

/// A sheet that the field does not show.
void TestLookup()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.1);
  sphere->Update();
  vtkNew<vtkCSLFSampler> sampler;
  SetUp(sampler, sphere->GetOutput());
  sampler->SetSamples(1);
  sampler->AutomaticCubeOff();
  vtkNew<vtkPlaneSource> source;
  source->SetCenter(0.0, 0.0, 0.6);
  source->Update();
  vtkPolyData* sheet = source->GetOutput();
  AddColors(sheet);
  vtkNew<vtkCSLFMapper> mapper;
  mapper->SetInputConnection(0, sampler->GetOutputPort());
  mapper->SetInputDataObject(1, sheet);
  cslf::testing::View view(Size);
  const auto actor = view.Add(mapper);
  const std::array<int, 2> front = { 200, 0 };
  const std::array<int, 2> back = { 0, 100 };
  view.GetCamera()->SetFocalPoint(0.0, 0.0, 0.0);
  for (const bool isMirrored : { false, true })
  {
    actor->SetScale(1.0, 1.0, isMirrored ? -1.0 : 1.0);
    view.GetCamera()->SetPosition(0.0, 0.0, 4.0);
    CSLF_CHECK(GetRedAndGreen(view.Render()) == (isMirrored ? back : front));
    view.GetCamera()->SetPosition(0.0, 0.0, -4.0);
    CSLF_CHECK(GetRedAndGreen(view.Render()) == (isMirrored ? front : back));
  }
  // Without others, the colours are those of both sides.
  actor->SetScale(1.0, 1.0, 1.0);
  vtkNew<vtkPolyData> plain;
  plain->ShallowCopy(sheet);
  plain->GetPointData()->RemoveArray("BackColor");
  mapper->SetInputDataObject(1, plain);
  CSLF_CHECK(GetRedAndGreen(view.Render()) == front);

  // A closed body whose triangles are clockwise as seen from outside shows their back.
  vtkNew<vtkCubeSource> box;
  box->SetCenter(0.0, 0.0, -0.6);
  box->SetXLength(0.5);
  box->SetYLength(0.5);
  box->SetZLength(0.5);
  vtkNew<vtkReverseSense> turn;
  turn->SetInputConnection(box->GetOutputPort());
  turn->Update();
  AddColors(turn->GetOutput());
  mapper->SetInputDataObject(1, turn->GetOutput());
  CSLF_CHECK(GetRedAndGreen(view.Render()) == back);
}
}

int TestCSLFGeometrySides(int, char*[])
{
  TestSheet();
  TestHidden();
  TestLookup();
  return cslf::testing::Result();
}
