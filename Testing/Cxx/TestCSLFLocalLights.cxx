// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Emissive surfaces sampled as lights: compares samples with their density, light with closed
// forms, and light sampling with rays that hit the lights by chance.
#include "PathTracing/Shapes/cslfTube.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfColor.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFLight.h"
#include "vtkCSLFMaterial.h"
#include "vtkCSLFViewTracer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTestErrorObserver.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;

cslf::Mesh MakeSphere(const glm::vec3& center, float radius, float emission)
{
  cslf::Mesh mesh;
  mesh.Shape = cslf::Mesh::Shapes::Spheres;
  mesh.Vertices = { center };
  mesh.Radii = { radius };
  mesh.Material = MakeDiffuse(0.5f, emission);
  return mesh;
}

cslf::Mesh MakeTube(
  const glm::vec3& start, const glm::vec3& end, float startRadius, float endRadius, float emission)
{
  cslf::Mesh mesh;
  mesh.Shape = cslf::Mesh::Shapes::Tubes;
  mesh.Vertices = { start, end };
  mesh.Radii = { startRadius, endRadius };
  mesh.Material = MakeDiffuse(0.5f, emission);
  return mesh;
}

/// The same for pieces that are short enough.
cslf::Mesh Divide(cslf::Mesh mesh)
{
  cslf::DivideLongTubes(mesh);
  CSLF_CHECK(mesh.Vertices.size() > 2);
  return mesh;
}

/// A mesh at another position, sheared and stretched.
cslf::Mesh Place(cslf::Mesh mesh, const glm::vec3& offset)
{
  cslf::MeshInstance instance;
  instance.Linear = { { 1.5f, 0.2f, 0.0f }, { 0.0f, 0.7f, 0.3f }, { -0.4f, 0.1f, -0.8f } };
  instance.Offset = offset;
  mesh.Instances = { instance };
  return mesh;
}

/// Lights of each shape, seen from below.
std::vector<cslf::Mesh> MakeLamps()
{
  std::vector<cslf::Mesh> lamps;
  lamps.push_back(
    MakeRectangle({ 0.1f, 0, 0.6f }, { 0.5f, 0, 0 }, { 0, 0.2f, 0.1f }, MakeDiffuse(0.5f, 2.0f)));
  lamps.push_back(MakeSphere({ 0.2f, 0.1f, 0.7f }, 0.3f, 2.0f));
  lamps.push_back(MakeSphere({ 0.0f, 0.0f, 0.7f }, 0.02f, 200.0f));
  lamps.push_back(MakeTube({ -0.6f, 0, 0.5f }, { 0.6f, 0.3f, 0.6f }, 0.1f, 0.1f, 2.0f));
  lamps.push_back(MakeTube({ -0.1f, 0, 0.4f }, { 0.3f, 0.3f, 0.9f }, 0.05f, 0.35f, 2.0f));
  lamps.push_back(MakeTube({ 0.1f, 0, 0.4f }, { 0.1f, 0, 0.9f }, 0.2f, 0.05f, 2.0f));
  lamps.push_back(MakeTube({ 0, 0.05f, 0.6f }, { 0.1f, 0, 0.6f }, 0.3f, 0.1f, 2.0f)); // a sphere
  lamps.push_back(MakeTube({ -1, 0.05f, 0.1f }, { 1, 0, 0.1f }, 0.02f, 0.02f, 2.0f)); // long, near
  lamps.push_back(Divide(MakeTube({ -1, 0.45f, 0.2f }, { 1, 0.4f, 0.3f }, 0.02f, 0.01f, 2.0f)));
  lamps.push_back(Place(MakeSphere({ 0, 0, 0 }, 0.3f, 2.0f), { 0, 0, 0.6f }));
  lamps.push_back(
    Place(MakeTube({ -0.2f, 0, 0 }, { 0.2f, 0.3f, 0 }, 0.2f, 0.1f, 2.0f), { 0, 0.1f, 0.6f }));
  lamps.push_back(
    Place(MakeRectangle({ 0, 0, 0 }, { 0.4f, 0, 0 }, { 0, 0.3f, 0 }, MakeDiffuse(0.5f, 2.0f)),
      { 0, 0, 0.6f }));
  return lamps;
}

/// A direction of the unit sphere, uniform, and the bin that it is in.
glm::vec3 MakeDirection(const glm::vec2& u)
{
  const float z = 2.0f * u.x - 1.0f;
  const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return { radius * std::cos(2.0f * cslf::Pi * u.y), radius * std::sin(2.0f * cslf::Pi * u.y), z };
}

constexpr int Rows = 20;
constexpr int Columns = 20;

int GetBin(const glm::vec3& direction)
{
  const float turn = std::atan2(direction.y, direction.x) / (2.0f * cslf::Pi) + 0.5f;
  const int row = std::clamp(static_cast<int>((0.5f + 0.5f * direction.z) * Rows), 0, Rows - 1);
  return row * Columns + std::clamp(static_cast<int>(turn * Columns), 0, Columns - 1);
}

/// Directions of samples have the right frequency everywhere on the sphere, and the density of a
/// sample is that of the ray which finds the same point.
void TestDensity(const cslf::Scene& scene, const cslf::LightReceiver& receiver, double least)
{
  const cslf::LocalLights& lights = scene.GetLocalLights();
  constexpr int samples = 1 << 16;
  constexpr int rays = 1 << 18;
  std::vector<double> found(Rows * Columns, 0.0);
  std::vector<double> expected(Rows * Columns, 0.0);
  std::vector<double> squares(Rows * Columns, 0.0);
  const std::uint64_t hash = cslf::SampleStream::HashTexel(3, 1, 4, 1);
  int taken = 0;
  int wrong = 0;
  for (std::uint32_t i = 0; i < samples; ++i)
  {
    const glm::vec2 u = cslf::SampleStream(hash, i).Get2D(cslf::Dimension::LocalLight);
    const cslf::LightSample sample = lights.Sample(receiver, u);
    if (!(sample.Pdf > 0.0f))
    {
      continue;
    }
    const cslf::Hit hit = scene.Intersect({ receiver.Position, sample.Direction });
    if (!hit.IsValid() || hit.Distance < 0.998f * sample.Distance)
    {
      continue; // hidden by another part
    }
    ++taken;
    const float pdf = lights.GetPdf(receiver, sample.Direction, hit);
    wrong += std::abs(pdf / sample.Pdf - 1.0f) < 0.01f ? 0 : 1;
    found[GetBin(sample.Direction)] += 1.0 / samples;
  }
  CSLF_CHECK(taken > least * samples);
  CSLF_CHECK(wrong < 0.04 * taken); // at silhouettes, where the density grows without bound

  int hits = 0;
  for (std::uint32_t i = 0; i < rays; ++i)
  {
    const glm::vec3 direction =
      MakeDirection(cslf::SampleStream(hash, i).Get2D(cslf::Dimension::Direction));
    const cslf::Hit hit = scene.Intersect({ receiver.Position, direction });
    if (hit.IsValid())
    {
      const double part = lights.GetPdf(receiver, direction, hit) * 4.0 * cslf::Pi / rays;
      expected[GetBin(direction)] += part;
      squares[GetBin(direction)] += part * part;
      ++hits;
    }
  }
  double sum = 0.0;
  double sumVariance = 0.0;
  for (double part : expected)
  {
    sum += part;
  }
  for (int bin = 0; bin < Rows * Columns; ++bin)
  {
    const double variance = std::max(expected[bin], found[bin]) / samples + squares[bin];
    const double edge = 5.0 * sum / hits; // a few rays more or less at the edge of a bin
    CSLF_CHECK_NEAR(found[bin], expected[bin], 5.0 * std::sqrt(variance) + edge);
    sumVariance += variance;
  }
  CSLF_CHECK_NEAR(sum, double(taken) / samples, 5.0 * std::sqrt(sumVariance));
}

void TestDensities()
{
  for (cslf::Mesh& lamp : MakeLamps())
  {
    const bool isSmall = lamp.Radii.size() == 1 && lamp.Radii[0] < 0.1f;
    std::vector<cslf::Mesh> meshes;
    meshes.push_back(std::move(lamp));
    const cslf::Scene scene(std::move(meshes), {});
    for (const glm::vec3& from :
      { glm::vec3(0.1f, 0.05f, 0.0f), glm::vec3(-0.9f, 0.3f, 0.5f), glm::vec3(0.1f, 0.02f, 1.4f) })
    {
      if (!isSmall)
      {
        TestDensity(scene, { from, glm::vec3(0.0f) }, 0.7);
      }
    }
  }
  // Many at once, and only those above the horizon.
  const cslf::Scene all(MakeLamps(), {});
  TestDensity(all, { { 0, 0, -0.9f }, glm::vec3(0.0f) }, 0.1);
  TestDensity(all, { { 0.9f, 0, 0.3f }, glm::normalize(glm::vec3(-1, 0, 0.9f)) }, 0.1);
}

void TestEstimatorsAgree()
{
  for (cslf::Mesh& lamp : MakeLamps())
  {
    std::vector<cslf::Mesh> meshes;
    const bool isSmall = lamp.Radii.size() == 1 && lamp.Radii[0] < 0.1f;
    meshes.push_back(std::move(lamp));
    meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, MakeDiffuse(0.7f)));
    const cslf::Scene scene(std::move(meshes), {});
    cslf::PathSettings settings;
    settings.MaximumDepth = 2;
    const cslf::Ray ray = LookAt({ -1.5f, 0.2f, 0.05f }, { 0.1f, 0.15f, 0 });
    const auto [both, surface] = CheckEstimators(scene, ray, settings, isSmall ? 1 << 19 : 1 << 17);
    CSLF_CHECK(both.Mean > 0.0 && both.Error < 0.02 * both.Mean);
  }
}
/// A plane below a small emissive sphere, by both integrators: the irradiance of a sphere that is
/// completely above the horizon is that of a disc of its radius that faces the point.
void TestSphereAbovePlane()
{
  constexpr double radius = 0.02;
  constexpr double radiance = 1000.0;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1, -1, 0);
  plane->SetPoint1(1, -1, 0);
  plane->SetPoint2(-1, 1, 0);
  plane->Update();
  vtkNew<vtkPolyData> lamp;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  const vtkIdType point = points->InsertNextPoint(0, 0, 1);
  cells->InsertNextCell(1, &point);
  lamp->SetPoints(points);
  lamp->SetVerts(cells);
  vtkCSLFMaterial::SetPointRadius(lamp, radius);
  vtkCSLFMaterial::SetEmission(lamp, radiance, radiance, radiance);
  vtkNew<vtkMultiBlockDataSet> scene;
  scene->SetBlock(0, plane->GetOutput());
  scene->SetBlock(1, lamp);
  vtkNew<vtkCamera> camera;
  camera->SetPosition(0, 0, 5);
  camera->ParallelProjectionOn();
  constexpr int size = 16;
  for (const bool cached : { false, true })
  {
    vtkNew<vtkCSLFViewTracer> tracer;
    tracer->SetInputData(scene);
    tracer->SetCamera(camera);
    tracer->SetSize(size, size);
    tracer->SetSamples(64);
    tracer->GetEnvironment()->SetModeToNone();
    tracer->SetColorTypeToFloat();
    cached ? tracer->SetIntegratorToRadianceCaching() : tracer->SetIntegratorToPathTracing();
    tracer->Update();
    vtkDataArray* colors = tracer->GetOutput()->GetPointData()->GetScalars();
    const double reflectance = cslf::SRGBToLinear(0.8);
    double sum = 0.0;
    double squares = 0.0;
    int count = 0;
    for (int i = 0; i < size * size; ++i)
    {
      const double x = 2.0 * (i % size + 0.5) / size - 1.0;
      const double y = 2.0 * (i / size + 0.5) / size - 1.0;
      if (std::hypot(x, y) > 0.2) // beside the lamp
      {
        const double distance2 = 1.0 + x * x + y * y;
        const double cosine = 1.0 / std::sqrt(distance2);
        const double expected = reflectance * radiance * radius * radius / distance2 * cosine;
        const double error = colors->GetComponent(i, 0) / expected - 1.0;
        sum += error;
        squares += error * error;
        ++count;
      }
    }
    CSLF_CHECK_NEAR(sum / count, 0.0, cached ? 0.01 : 0.002);
    CSLF_CHECK(std::sqrt(squares / count) < (cached ? 0.015 : 0.005));
  }
}

/// Only lights with invalid values are left out.
void TestInvalidLights()
{
  const double nan = vtkMath::Nan();
  const double intensity[3] = { 0.1, 0.1, 0.1 };
  const double down[3] = { 0, 0, -1 };
  const double place[3] = { 0, 0, 0.5 };
  const double nowhere[3] = { 0, nan, 0.5 };
  const double constant[4] = { 1, 0, 0, 1 };
  const double negative[4] = { 1, -1, 0, 1 };
  for (const bool spots : { false, true })
  {
    double colors[2];
    for (const bool broken : { false, true })
    {
      vtkNew<vtkPlaneSource> plane;
      plane->Update();
      vtkPolyData* data = plane->GetOutput();
      const auto add = [&](const double position[3], const double* attenuation)
      {
        spots ? vtkCSLFLight::AddSpotLight(data, position, down, intensity, 60.0, 0.0, attenuation)
              : vtkCSLFLight::AddPointLight(data, position, intensity, attenuation);
      };
      if (broken)
      {
        add(nowhere, constant);
        add(place, negative);
      }
      add(place, constant);
      vtkNew<vtkCamera> camera;
      camera->SetPosition(0, 0, 5);
      vtkNew<vtkCSLFViewTracer> tracer;
      tracer->SetInputData(data);
      tracer->SetCamera(camera);
      tracer->SetSize(1, 1);
      tracer->SetSamples(16);
      tracer->SetMaximumDepth(1);
      tracer->GetEnvironment()->SetModeToNone();
      tracer->SetIntegratorToPathTracing();
      tracer->SetColorTypeToFloat();
      vtkNew<vtkTest::ErrorObserver> messages;
      tracer->AddObserver(vtkCommand::WarningEvent, messages);
      tracer->Update();
      colors[broken] = tracer->GetOutput()->GetPointData()->GetScalars()->GetComponent(0, 0);
      CSLF_CHECK(broken == (messages->GetWarningMessage().find("2 light(s)") != std::string::npos));
    }
    CSLF_CHECK(colors[0] > 0.0);
    CSLF_CHECK_NEAR(colors[1], colors[0], 1e-6);
  }
}
}

int TestCSLFLocalLights(int, char*[])
{
  TestInvalidLights();
  TestDensities();
  TestEstimatorsAgree();
  TestSphereAbovePlane();
  return cslf::testing::Result();
}
