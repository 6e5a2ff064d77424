// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Vertices as spheres, lines as tubes, and instances of all.
#include "cslfColor.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFSampler.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTestErrorObserver.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace
{
/// A view tracer that looks down at [-2,2] x [-2,2] with 40 x 40 pixels.
struct Viewer
{
  vtkNew<vtkCSLFViewTracer> Tracer;
  vtkNew<vtkCamera> Camera;
  vtkNew<vtkTest::ErrorObserver> Messages;

  Viewer()
  {
    this->Camera->SetPosition(0, 0, 5);
    this->Camera->ParallelProjectionOn();
    this->Camera->SetParallelScale(2.0);
    this->Tracer->SetCamera(this->Camera);
    this->Tracer->SetSize(40, 40);
    this->Tracer->SetSamples(64);
    this->Tracer->SetColorTypeToFloat();
    this->Tracer->AddObserver(vtkCommand::WarningEvent, this->Messages);
  }

  void Look(vtkDataObject* data)
  {
    this->Tracer->SetInputDataObject(data);
    this->Tracer->Update();
  }

  vtkDataArray* GetColors() { return this->Tracer->GetOutput()->GetPointData()->GetScalars(); }

  void GetColor(double x, double y, double color[4])
  {
    const int column = static_cast<int>((x + 2.0) * 10.0);
    const int row = static_cast<int>((y + 2.0) * 10.0);
    this->GetColors()->GetTuple(row * 40 + column, color);
  }

  double GetColor(double x, double y, int component)
  {
    double color[4];
    this->GetColor(x, y, color);
    return color[component];
  }

  /// The covered area.
  double GetArea()
  {
    double sum = 0.0;
    for (vtkIdType i = 0; i < this->GetColors()->GetNumberOfTuples(); ++i)
    {
      sum += this->GetColors()->GetComponent(i, 3);
    }
    return sum * 0.01;
  }
};

vtkSmartPointer<vtkPolyData> MakePoints(const std::vector<std::vector<double>>& places, bool line)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  auto data = vtkSmartPointer<vtkPolyData>::New();
  if (line)
  {
    cells->InsertNextCell(static_cast<int>(places.size()));
  }
  for (const std::vector<double>& place : places)
  {
    const vtkIdType id = points->InsertNextPoint(place[0], place[1], place[2]);
    if (!line)
    {
      cells->InsertNextCell(1);
    }
    cells->InsertCellPoint(id);
  }
  data->SetPoints(points);
  line ? data->SetLines(cells) : data->SetVerts(cells);
  return data;
}

void SetRadii(vtkPolyData* data, const char* name, const std::vector<float>& values)
{
  vtkNew<vtkFloatArray> radii;
  radii->SetName(name);
  for (float value : values)
  {
    radii->InsertNextValue(value);
  }
  data->GetPointData()->AddArray(radii);
}

void TestSpheres()
{
  // Two spheres, one red, one green; a directional light from the eye shows the cosine.
  auto data = MakePoints({ { -1, 0, 0 }, { 1, 0, 0 } }, false);
  vtkCSLFMaterial::SetPointRadius(data, 0.5);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->InsertNextTuple3(255, 0, 0);
  colors->InsertNextTuple3(0, 255, 0);
  data->GetPointData()->SetScalars(colors);
  const double direction[3] = { 0, 0, -1 };
  const double irradiance[3] = { vtkMath::Pi(), vtkMath::Pi(), vtkMath::Pi() };
  vtkCSLFLight::AddDirectionalLight(data, direction, irradiance);
  Viewer viewer;
  viewer.Tracer->GetEnvironment()->SetModeToNone();
  viewer.Tracer->SetMaximumDepth(1);
  viewer.Look(data);
  CSLF_CHECK_NEAR(viewer.GetArea(), 2.0 * vtkMath::Pi() * 0.25, 0.02);
  CSLF_CHECK(viewer.GetColor(0.0, 0.0, 3) == 0.0);
  CSLF_CHECK_NEAR(viewer.GetColor(-1.05, 0.05, 0), 1.0, 0.02);
  CSLF_CHECK(viewer.GetColor(-1.05, 0.05, 1) == 0.0);
  CSLF_CHECK_NEAR(viewer.GetColor(1.25, 0.05, 1), std::sqrt(1.0 - 0.25 - 0.01), 0.02);
  CSLF_CHECK(!viewer.Messages->GetWarning());

  // Radii of points; the default, a small part of the scene's size; an invalid one.
  SetRadii(data, vtkCSLFMaterial::PointRadiusName(), { 0.25f, 0.75f });
  data->Modified();
  viewer.Look(data);
  CSLF_CHECK_NEAR(viewer.GetArea(), vtkMath::Pi() * (0.0625 + 0.5625), 0.02);
  auto plain = MakePoints(
    { { -1, 0, 0 }, { 1, 0, 0 }, { std::numeric_limits<double>::quiet_NaN(), 0, 0 } }, false);
  vtkNew<vtkCSLFSampler> sampler;
  sampler->SetInputData(plain);
  sampler->SetViewpoints(2);
  sampler->SetResolution(2);
  sampler->SetSamples(1);
  vtkNew<vtkTest::ErrorObserver> messages;
  sampler->AddObserver(vtkCommand::WarningEvent, messages);
  sampler->Update();
  CSLF_CHECK(messages->GetWarningMessage().find("1 line(s) or vertex") != std::string::npos);
  // The cube contains the spheres: 2 long, with a radius of 0.02 of that.
  const std::string description =
    vtkStringArray::SafeDownCast(sampler->GetOutput()->GetFieldData()->GetAbstractArray(0))
      ->GetValue(0);
  CSLF_CHECK(description.find("-1.04,") != std::string::npos);
}

/// Points on a grid of 20 x 20, each as often as given.
std::vector<std::vector<double>> MakeGrid(double step, int repetitions)
{
  std::vector<std::vector<double>> places;
  for (int i = 0; i < 400 * repetitions; ++i)
  {
    const int point = i / repetitions;
    places.push_back({ step * (point % 20 - 9.5), step * (point / 20 - 9.5), 0.0 });
  }
  return places;
}

/// Points without a radius get half of the distance between neighbours.
void TestSpacing()
{
  const double disks = 400.0 * vtkMath::Pi() * 0.0025;
  Viewer viewer;
  viewer.Look(MakePoints(MakeGrid(0.1, 1), false));
  CSLF_CHECK_NEAR(viewer.GetArea(), disks, 0.03);
  viewer.Look(MakePoints(MakeGrid(0.1, 3), false));
  CSLF_CHECK_NEAR(viewer.GetArea(), disks, 0.03);

  // A block for each point, beside a denser cloud, which has a radius of its own.
  vtkNew<vtkMultiBlockDataSet> blocks;
  unsigned int count = 0;
  for (const std::vector<double>& place : MakeGrid(0.1, 1))
  {
    blocks->SetBlock(count++, MakePoints({ place }, false));
  }
  viewer.Look(blocks);
  CSLF_CHECK_NEAR(viewer.GetArea(), disks, 0.03);
  const auto dense = MakePoints(MakeGrid(0.02, 1), false);
  for (vtkIdType i = 0; i < dense->GetNumberOfPoints(); ++i)
  {
    double place[3];
    dense->GetPoint(i, place);
    dense->GetPoints()->SetPoint(i, place[0] + 1.5, place[1], place[2]);
  }
  blocks->SetBlock(count++, dense);
  viewer.Look(blocks);
  CSLF_CHECK_NEAR(viewer.GetArea(), disks * 1.04, 0.03);

  // Points at random, of this density, cover about two thirds.
  std::vector<std::vector<double>> places;
  vtkMath::RandomSeed(3);
  for (int i = 0; i < 1000; ++i)
  {
    places.push_back({ vtkMath::Random(-1.5, 1.5), vtkMath::Random(-1.5, 1.5), 0.0 });
  }
  viewer.Look(MakePoints(places, false));
  CSLF_CHECK_NEAR(viewer.GetArea(), 9.0 * 0.66, 0.5);

  // One place.
  viewer.Look(MakePoints({ { 0, 0, 0 } }, false));
  CSLF_CHECK_NEAR(viewer.GetArea(), vtkMath::Pi(), 0.02);
  viewer.Look(MakePoints({ { 0, 0, 0 }, { 0, 0, 0 } }, false));
  CSLF_CHECK_NEAR(viewer.GetArea(), vtkMath::Pi(), 0.02);
}

void TestTubes()
{
  // A line of two parts with a corner, round at its ends; colours run along it.
  auto data = MakePoints({ { -1, -1, 0 }, { -1, 1, 0 }, { 1, 1, 0 } }, true);
  vtkCSLFMaterial::SetLineRadius(data, 0.25);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->InsertNextTuple3(0, 0, 0);
  colors->InsertNextTuple3(255, 255, 255);
  colors->InsertNextTuple3(255, 0, 0);
  data->GetPointData()->SetScalars(colors);
  Viewer viewer;
  viewer.Look(data);
  const double corner = 0.0625 * (1.0 - vtkMath::Pi() / 4.0);
  const double area = 2.0 * 2.0 * 0.5 + vtkMath::Pi() * 0.0625 - corner;
  CSLF_CHECK_NEAR(viewer.GetArea(), area, 0.03);
  CSLF_CHECK(viewer.GetColor(0, 0, 3) == 0.0);
  CSLF_CHECK(viewer.GetColor(-0.95, -1.15, 3) == 1.0);
  CSLF_CHECK_NEAR(viewer.GetColor(-0.95, -0.05, 0), 0.475, 0.03);
  CSLF_CHECK_NEAR(viewer.GetColor(0.05, 1.05, 1), 0.475, 0.03);
  CSLF_CHECK_NEAR(viewer.GetColor(0.05, 1.05, 0), 1.0, 0.02);

  // The colour of the cell; a radius that grows: two tangents to two circles.
  data->GetPointData()->SetScalars(nullptr);
  auto cone = MakePoints({ { -1, 0, 0 }, { 1, 0, 0 } }, true);
  SetRadii(cone, vtkCSLFMaterial::LineRadiusName(), { 0.2f, 0.7f });
  vtkNew<vtkUnsignedCharArray> cell;
  cell->SetNumberOfComponents(3);
  cell->InsertNextTuple3(0, 0, 255);
  cone->GetCellData()->SetScalars(cell);
  viewer.Look(cone);
  const double sine = 0.5 / 2.0;
  const double angle = std::asin(sine);
  const double tangent = 2.0 * std::sqrt(1.0 - sine * sine);
  const double expected = tangent * (0.2 + 0.7) + 0.49 * (0.5 * vtkMath::Pi() + angle) +
    0.04 * (0.5 * vtkMath::Pi() - angle);
  CSLF_CHECK_NEAR(viewer.GetArea(), expected, 0.03);
  CSLF_CHECK_NEAR(viewer.GetColor(0.05, 0.05, 2), 1.0, 0.02);
  CSLF_CHECK(viewer.GetColor(0.05, 0.05, 0) == 0.0);
}

/// A tube that ends in a point: two tangents from the point to the circle at the other end.
void TestPointedTubes()
{
  Viewer viewer;
  for (const bool reversed : { false, true })
  {
    auto cone = MakePoints({ { -1, 0, 0 }, { 1, 0, 0 } }, true);
    auto line = MakePoints({ { -1, 1.5, 0 }, { 1, 1.5, 0 } }, true);
    SetRadii(
      cone, vtkCSLFMaterial::LineRadiusName(), { reversed ? 0.5f : 0.0f, reversed ? 0.0f : 0.5f });
    SetRadii(line, vtkCSLFMaterial::LineRadiusName(), { 0.0f, 0.0f });
    vtkCSLFInstances::AddInstance(line, vtkNew<vtkMatrix4x4>());
    vtkNew<vtkMultiBlockDataSet> blocks;
    blocks->SetBlock(0, cone);
    blocks->SetBlock(1, line);
    viewer.Messages->Clear();
    viewer.Look(blocks);
    const double angle = std::asin(0.5 / 2.0);
    CSLF_CHECK_NEAR(
      viewer.GetArea(), 0.5 * 2.0 * std::cos(angle) + 0.25 * (0.5 * vtkMath::Pi() + angle), 0.03);
    CSLF_CHECK(viewer.Messages->GetWarningMessage().find("1 sphere(s) or part(s) of lines") !=
      std::string::npos);
  }
}

vtkSmartPointer<vtkMatrix4x4> MakeMatrix(
  double x, double y, double angle, double scaleX, double scaleY)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(x, y, 0.0);
  transform->RotateZ(angle);
  transform->Scale(scaleX, scaleY, 1.0);
  return transform->GetMatrix();
}

void TestInstances()
{
  vtkNew<vtkPlaneSource> plane; // of side 1
  plane->Update();
  vtkPolyData* data = plane->GetOutput();
  const double red[4] = { 1, 0, 0, 1 };
  const double green[4] = { 0, 1, 0, 0.5 };
  vtkCSLFInstances::AddInstance(data, MakeMatrix(-1, -1, 0, 1, 1), red);
  vtkCSLFInstances::AddInstance(data, MakeMatrix(1, 1, 45, 1, 1), green);
  vtkCSLFInstances::AddInstance(data, MakeMatrix(1, -1, 0, -1, 1), red); // mirrored
  vtkCSLFInstances::AddInstance(data, MakeMatrix(0, 0, 0, 0, 1), red);   // flat
  Viewer viewer;
  viewer.Look(data);
  CSLF_CHECK_NEAR(viewer.GetArea(), 2.5, 0.06);
  CSLF_CHECK_NEAR(viewer.GetColor(-1.05, -1.05, 0), 1.0, 1e-3);
  CSLF_CHECK_NEAR(viewer.GetColor(1.05, -1.05, 0), 1.0, 1e-3);
  CSLF_CHECK(viewer.GetColor(0.05, 0.05, 3) == 0.0);
  const double alpha = viewer.GetColor(1.05, 1.55, 3);
  CSLF_CHECK(alpha > 0.2 && alpha < 0.8); // the square reaches this point only if it is rotated
  CSLF_CHECK_NEAR(viewer.GetColor(1.05, 1.55, 1), alpha, 1e-3);
  CSLF_CHECK(!viewer.Messages->GetWarning());

  // One matrix with NaN.
  vtkCSLFInstances::AddInstance(data, MakeMatrix(vtkMath::Nan(), 0, 0, 1, 1), red);
  viewer.Look(data);
  CSLF_CHECK_NEAR(viewer.GetArea(), 2.5, 0.06);
  CSLF_CHECK(viewer.Messages->GetWarningMessage().find("1 instance(s)") != std::string::npos);
  viewer.Messages->Clear();

  // A sphere as an ellipse.
  auto sphere = MakePoints({ { 5, 5, 0 } }, false);
  vtkCSLFMaterial::SetPointRadius(sphere, 0.5);
  auto matrix = MakeMatrix(0, 0, 30, 3, 1);
  double offset[4] = { 5, 5, 0, 0 };
  matrix->MultiplyPoint(offset, offset);
  matrix->SetElement(0, 3, -offset[0]);
  matrix->SetElement(1, 3, -offset[1]);
  vtkCSLFInstances::AddInstance(sphere, matrix);
  const double direction[3] = { 0, 0, -1 };
  const double irradiance[3] = { vtkMath::Pi(), vtkMath::Pi(), vtkMath::Pi() };
  vtkCSLFLight::AddDirectionalLight(sphere, direction, irradiance);
  vtkCSLFMaterial::SetBaseColor(sphere, 1, 1, 1);
  viewer.Tracer->GetEnvironment()->SetModeToNone();
  viewer.Tracer->SetMaximumDepth(1);
  viewer.Look(sphere);
  CSLF_CHECK_NEAR(viewer.GetArea(), vtkMath::Pi() * 0.5 * 1.5, 0.03);
  // At half of the long axis, the normal of the ellipsoid: (x / 9, y, z) in its own axes.
  const double z = std::sqrt(0.25 - 0.25 * 0.25);
  CSLF_CHECK_NEAR(viewer.GetColor(0.75 * std::cos(vtkMath::Pi() / 6.0), 0.375, 0),
    z / std::hypot(0.75 / 9.0, z), 0.02);

  // Arrays that do not match.
  vtkNew<vtkPolyData> broken;
  broken->ShallowCopy(data);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(vtkCSLFInstances::InstanceColor());
  colors->SetNumberOfComponents(3);
  colors->InsertNextTuple3(1, 2, 3);
  broken->SetFieldData(vtkNew<vtkFieldData>());
  broken->GetFieldData()->ShallowCopy(data->GetFieldData());
  broken->GetFieldData()->AddArray(colors);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, broken);
  blocks->SetBlock(1, sphere);
  viewer.Look(blocks);
  CSLF_CHECK(
    viewer.Messages->GetWarningMessage().find("1 block(s)' instances") != std::string::npos);
}

void TestInstancesOfLamps()
{
  // Instances of an emissive surface give the same light as its copies.
  const auto trace = [](bool instances)
  {
    vtkNew<vtkMultiBlockDataSet> scene;
    vtkNew<vtkPlaneSource> floor;
    floor->SetOrigin(-3, -3, -1);
    floor->SetPoint1(3, -3, -1);
    floor->SetPoint2(-3, 3, -1);
    floor->Update();
    scene->SetBlock(0, floor->GetOutput());
    for (int i = 0; i < 2; ++i)
    {
      vtkNew<vtkPlaneSource> lamp;
      lamp->Update();
      vtkNew<vtkPolyData> data;
      data->ShallowCopy(lamp->GetOutput());
      vtkCSLFMaterial::SetEmission(data, 2, 2, 2);
      const double x = i == 0 ? -1.2 : 1.4;
      if (instances && i == 0)
      {
        vtkCSLFInstances::AddInstance(data, MakeMatrix(x, 0, 0, 1, 0.5));
        vtkCSLFInstances::AddInstance(data, MakeMatrix(1.4, 0, 0, 1, 0.5));
        scene->SetBlock(1, data);
      }
      else if (!instances)
      {
        lamp->SetOrigin(x - 0.5, -0.25, 0);
        lamp->SetPoint1(x + 0.5, -0.25, 0);
        lamp->SetPoint2(x - 0.5, 0.25, 0);
        lamp->Update();
        data->CopyStructure(lamp->GetOutput());
        scene->SetBlock(1 + i, data);
      }
    }
    Viewer viewer;
    viewer.Tracer->GetEnvironment()->SetModeToNone();
    viewer.Tracer->SetMaximumDepth(1);
    viewer.Tracer->SetSamples(256);
    viewer.Look(scene);
    double sum = 0.0;
    for (double x : { -0.05, 0.05, 0.15 })
    {
      sum += viewer.GetColor(x, 0.95, 0) / 3.0;
    }
    return sum;
  };
  const double copies = trace(false);
  CSLF_CHECK(copies > 0.01);
  CSLF_CHECK_NEAR(trace(true) / copies, 1.0, 0.02);
}

/// Partly opaque instances, tubes, spheres and a texture, all at once.
vtkSmartPointer<vtkMultiBlockDataSet> MakeMixedScene()
{
  auto scene = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  vtkNew<vtkPlaneSource> plane;
  plane->Update();
  vtkPolyData* data = plane->GetOutput();
  vtkCSLFMaterial::SetOpacity(data, 0.4);
  for (double x : { -1.0, 0.0, 0.7 })
  {
    vtkCSLFInstances::AddInstance(data, MakeMatrix(x, 0.3 * x, 40.0 * x, 1.0, 1.5));
  }
  scene->SetBlock(0, data);
  auto line = MakePoints({ { -1, -1, -1 }, { 1, 1, 1 }, { 1, -1, 0.5 } }, true);
  vtkCSLFMaterial::SetLineRadius(line, 0.2);
  vtkCSLFMaterial::SetOpacity(line, 0.7);
  scene->SetBlock(1, line);
  auto points = MakePoints({ { 0.5, 0, 0.8 }, { -0.5, 0, 0.8 } }, false);
  vtkCSLFMaterial::SetPointRadius(points, 0.3);
  vtkCSLFMaterial::SetEmission(points, 1, 2, 3);
  scene->SetBlock(2, points);
  vtkNew<vtkPlaneSource> sheet;
  sheet->SetCenter(0, 0, -0.5);
  sheet->Update();
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int i = 0; i < 16; ++i)
  {
    pixels[i] = static_cast<unsigned char>(16 * i + 15);
  }
  vtkCSLFMaterial::SetTexture(sheet->GetOutput(), vtkCSLFMaterial::BaseColorTexture, image);
  vtkCSLFMaterial::SetTransmission(sheet->GetOutput(), 0.5);
  vtkCSLFMaterial::SetIndexOfRefraction(sheet->GetOutput(), 1.4);
  vtkCSLFMaterial::SetRoughness(sheet->GetOutput(), 0.5);
  scene->SetBlock(3, sheet->GetOutput());
  return scene;
}

void TestSlabsAndThreads()
{
  // The same bytes for any way of pulling the field.
  vtkNew<vtkCSLFSampler> whole;
  vtkNew<vtkCSLFSampler> parts;
  for (vtkCSLFSampler* sampler : { whole.Get(), parts.Get() })
  {
    sampler->SetInputDataObject(MakeMixedScene());
    sampler->SetViewpoints(2);
    sampler->SetResolution(12);
    sampler->SetSamples(4);
  }
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 2 }, [&whole]() { whole->Update(); });
  int extent[6];
  whole->GetOutput()->GetExtent(extent);
  const int last = extent[5];
  int different = 0;
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1 },
    [&]()
    {
      for (int first = 0; first <= last; first += 5)
      {
        extent[4] = first;
        extent[5] = std::min(first + 4, last);
        CSLF_CHECK(parts->UpdateExtent(extent) == 1);
        for (const char* name : { "Color", "Depth" })
        {
          vtkDataArray* all = whole->GetOutput()->GetPointData()->GetArray(name);
          vtkDataArray* part = parts->GetOutput()->GetPointData()->GetArray(name);
          const vtkIdType offset = vtkIdType(first) * 60 * 12;
          for (vtkIdType i = 0; i < part->GetNumberOfTuples(); ++i)
          {
            for (int c = 0; c < part->GetNumberOfComponents(); ++c)
            {
              different += part->GetComponent(i, c) != all->GetComponent(offset + i, c) ? 1 : 0;
            }
          }
        }
      }
    });
  CSLF_CHECK(different == 0);
}
}

int TestCSLFShapes(int, char*[])
{
  TestSpheres();
  TestSpacing();
  TestTubes();
  TestPointedTubes();
  TestInstances();
  TestInstancesOfLamps();
  TestSlabsAndThreads();
  return cslf::testing::Result();
}
