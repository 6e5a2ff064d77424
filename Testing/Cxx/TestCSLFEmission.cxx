// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Emission of points, cells and instances: its appearance, and its light on other surfaces.
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <functional>

namespace
{
using Color = std::array<double, 3>;

/// The unit square, in two halves, which reflects nothing.
vtkSmartPointer<vtkPolyData> MakeSquare(double z)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetXResolution(2);
  plane->SetCenter(0.0, 0.0, z);
  plane->Update();
  auto square = vtkSmartPointer<vtkPolyData>::New();
  square->ShallowCopy(plane->GetOutput());
  vtkCSLFMaterial::SetBaseColor(square, 0.0, 0.0, 0.0);
  return square;
}

/// Emission by the x of points, from -0.5 to 0.5.
void SetEmission(vtkPolyData* square, const std::function<double(double)>& red)
{
  vtkNew<vtkDoubleArray> emission;
  emission->SetName(vtkCSLFMaterial::EmissionName());
  emission->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < square->GetNumberOfPoints(); ++i)
  {
    emission->InsertNextTuple3(red(square->GetPoint(i)[0]), 0.25, 0.0);
  }
  square->GetPointData()->AddArray(emission);
}

/// The mean linear colour around a point of the plane z = 0, seen along -z from below a height.
Color Look(vtkDataObject* scene, double x, double height, int integrator, int depth)
{
  vtkNew<vtkCamera> camera;
  camera->SetPosition(x, 0.0, height);
  camera->SetFocalPoint(x, 0.0, 0.0);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.02);
  vtkNew<vtkCSLFViewTracer> tracer;
  tracer->SetInputDataObject(scene);
  tracer->SetCamera(camera);
  tracer->SetSize(8, 8);
  tracer->SetSamples(256);
  tracer->SetMaximumDepth(depth);
  tracer->SetIntegrator(integrator);
  tracer->SetColorTypeToFloat();
  tracer->GetEnvironment()->SetModeToNone();
  tracer->Update();
  Color mean = { 0.0, 0.0, 0.0 };
  for (int i = 0; i < 64; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      mean[c] += tracer->GetOutput()->GetPointData()->GetScalars()->GetComponent(i, c) / 64.0;
    }
  }
  return mean;
}

void TestSeen()
{
  const int paths = vtkCSLFViewTracer::PathTracing;
  auto square = MakeSquare(0.0);
  SetEmission(square, [](double x) { return x + 0.5; });
  CSLF_CHECK_NEAR(Look(square, 0.25, 1.0, paths, 0)[0], 0.75, 1e-3);
  CSLF_CHECK_NEAR(Look(square, -0.25, 1.0, paths, 0)[0], 0.25, 1e-3);
  CSLF_CHECK_NEAR(Look(square, -0.25, 1.0, paths, 0)[1], 0.25, 1e-6);

  // Points come before cells, and cells before the material.
  vtkNew<vtkDoubleArray> ofCells;
  ofCells->SetName(vtkCSLFMaterial::EmissionName());
  ofCells->SetNumberOfComponents(3);
  ofCells->InsertNextTuple3(2.0, 0.0, -1.0);
  ofCells->InsertNextTuple3(0.5, 1.0, 0.0);
  square->GetCellData()->AddArray(ofCells);
  vtkCSLFMaterial::SetEmission(square, 7.0, 7.0, 7.0);
  CSLF_CHECK_NEAR(Look(square, 0.25, 1.0, paths, 0)[0], 0.75, 1e-3);
  square->GetPointData()->RemoveArray(vtkCSLFMaterial::EmissionName());
  CSLF_CHECK_NEAR(Look(square, -0.25, 1.0, paths, 0)[0], 2.0, 1e-6);
  CSLF_CHECK_NEAR(Look(square, -0.25, 1.0, paths, 0)[2], 0.0, 1e-6);
  CSLF_CHECK_NEAR(Look(square, 0.25, 1.0, paths, 0)[1], 1.0, 1e-6);
  square->GetCellData()->RemoveArray(vtkCSLFMaterial::EmissionName());
  CSLF_CHECK_NEAR(Look(square, 0.25, 1.0, paths, 0)[2], 7.0, 1e-5);
}

void TestInstances()
{
  auto square = MakeSquare(0.0);
  vtkNew<vtkMatrix4x4> place;
  const double color[4] = { 0.0, 0.0, 0.0, 1.0 };
  const double first[3] = { 1.0, 0.0, 0.5 };
  const double second[3] = { 0.0, 3.0, 0.5 };
  vtkCSLFInstances::AddInstance(square, place, color, first);
  place->SetElement(0, 3, 2.0);
  vtkCSLFInstances::AddInstance(square, place, color, second);
  const int paths = vtkCSLFViewTracer::PathTracing;
  CSLF_CHECK_NEAR(Look(square, 0.0, 1.0, paths, 0)[0], 1.0, 1e-6);
  CSLF_CHECK_NEAR(Look(square, 2.0, 1.0, paths, 0)[1], 3.0, 1e-6);
  CSLF_CHECK_NEAR(Look(square, 2.0, 1.0, paths, 0)[2], 0.5, 1e-6);
}

/// The light on a white square at z = 0 from an emissive one at z = 1.
double Receive(const std::function<double(double)>& red, int integrator)
{
  auto receiver = MakeSquare(0.0);
  vtkCSLFMaterial::SetBaseColor(receiver, 1.0, 1.0, 1.0);
  auto lamp = MakeSquare(1.0);
  SetEmission(lamp, red);
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, receiver);
  scene->SetBlock(1, lamp);
  return Look(scene, 0.2, 0.9, integrator, 1)[0];
}

void TestLight()
{
  // Light is linear: two slopes make an even emission, which gives the form factor.
  for (const int integrator :
    { vtkCSLFViewTracer::PathTracing, vtkCSLFViewTracer::RadianceCaching })
  {
    const double rising = Receive([](double x) { return 0.5 + x; }, integrator);
    const double falling = Receive([](double x) { return 0.5 - x; }, integrator);
    const double even = Receive([](double) { return 1.0; }, integrator);
    CSLF_CHECK_NEAR(rising + falling, even, 0.01 * even);
    CSLF_CHECK(rising > 1.05 * falling);
    // Numerically: the integral of cos^2 / (pi r^2).
    double expected = 0.0;
    const int side = 200;
    for (int i = 0; i < side * side; ++i)
    {
      const double x = (i % side + 0.5) / side - 0.5;
      const double y = (i / side + 0.5) / side - 0.5;
      const double squared = 1.0 + (x - 0.2) * (x - 0.2) + y * y;
      expected += (0.5 + x) / (3.14159265358979 * squared * squared) / (side * side);
    }
    CSLF_CHECK_NEAR(rising, expected, 0.01 * expected);
  }
}
}

int TestCSLFEmission(int, char*[])
{
  TestSeen();
  TestInstances();
  TestLight();
  return cslf::testing::Result();
}
