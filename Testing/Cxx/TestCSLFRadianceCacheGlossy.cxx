// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Reflections of rough surfaces are looked up if the cache is accurate enough, and traced
// otherwise. The insides of closed bodies are left out of the cache, and still look right.
#include "PathTracing/Materials/cslfGGX.h"
#include "PathTracing/RadianceCache/cslfIncidentLight.h"
#include "PathTracing/RadianceCache/cslfOpenSides.h"
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "cslfIntegratorComparison.h"
#include "cslfTestTransport.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFMaterial.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>

namespace
{
using cslf::testing::IntegratorComparison;

constexpr vtkTypeUInt64 Pixels = 32 * 32;
constexpr vtkTypeUInt64 Samples = 64; // of the cached picture

cslf::SurfaceMaterial MakeGlossy(float roughness)
{
  return { glm::vec3(0.5f), 0.0f, roughness, 1.5f, glm::vec3(0.0f) };
}

/// A quadratic radiance is recovered from samples, and the moments give a lobe's mean of it.
void TestIncidentLight()
{
  const glm::vec3 normal = glm::normalize(glm::vec3(0.3f, -0.5f, 0.7f));
  const cslf::Frame frame(normal);
  const auto getRadiance = [](const glm::vec3& local)
  {
    return glm::vec3(1.0f + 0.5f * local.x - 0.3f * local.y,
      0.4f + 0.3f * local.x * local.x - 0.2f * local.x * local.y, 2.0f);
  };
  const cslf::GlossyLobe lobe(MakeGlossy(0.5f));
  CSLF_CHECK(lobe.IsKnown() && lobe.GetSize() > 0.0f && lobe.GetSize() < 1.0f);
  CSLF_CHECK(!cslf::GlossyLobe().IsKnown());
  cslf::IncidentFit fit;
  constexpr int count = 1024;
  for (int i = 0; i < count; ++i)
  {
    const cslf::SampleStream stream(3, static_cast<std::uint32_t>(i));
    const glm::vec3 local = cslf::SampleCosineHemisphere(stream.Get2D(cslf::Dimension::Direction));
    fit.Add({ local.x, local.y }, getRadiance(local));
  }
  const cslf::IncidentLight light = fit.Solve(frame, lobe.GetSize());
  CSLF_CHECK(light.IsKnown() && light.Error < 0.05f);

  const cslf::GGX facets(cslf::SurfaceMaterial::ToAlpha(0.5f));
  for (const float cosine : { 1.0f, 0.8f, 0.4f })
  {
    const glm::vec3 outgoing(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
    glm::dvec3 sum(0.0);
    double total = 0.0;
    for (int i = 0; i < 1 << 14; ++i)
    {
      const cslf::SampleStream stream(5, static_cast<std::uint32_t>(i));
      const glm::vec3 incident = facets.Sample(outgoing, stream.Get2D(cslf::Dimension::Direction));
      if (incident.z > 0.0f)
      {
        const float half = glm::dot(outgoing, glm::normalize(outgoing + incident));
        const double weight = cslf::DielectricFresnel(half, 1.5f) *
          facets.MaskingShadowing(outgoing, incident) / facets.Masking(outgoing);
        sum += weight * glm::dvec3(getRadiance(incident));
        total += weight;
      }
    }
    const glm::vec3 mean = light.Get(lobe.GetMoments(normal, frame.ToWorld(outgoing)));
    for (int c = 0; c < 3; ++c)
    {
      CSLF_CHECK_NEAR(mean[c], sum[c] / total, 0.02);
    }
  }

  // The error shows that points disagree.
  cslf::IncidentLight brighter = light;
  brighter.Terms[0] += glm::vec3(1.0f);
  CSLF_CHECK_NEAR(cslf::Average({ light, light }, { light, brighter }, normal).Error, 0.5, 0.05);
}

vtkSmartPointer<vtkMultiBlockDataSet> MakeStillLife(double metallic)
{
  vtkNew<vtkPlaneSource> floor;
  floor->SetOrigin(-1.0, -0.5, 1.0);
  floor->SetPoint1(1.0, -0.5, 1.0);
  floor->SetPoint2(-1.0, -0.5, -1.0);
  floor->Update();
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(32);
  sphere->SetPhiResolution(16);
  sphere->Update();
  auto scene = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  scene->SetBlock(0, floor->GetOutput());
  scene->SetBlock(1, sphere->GetOutput());
  for (vtkPolyData* block : { floor->GetOutput(), sphere->GetOutput() })
  {
    vtkCSLFMaterial::SetIndexOfRefraction(block, 1.5);
    vtkCSLFMaterial::SetRoughness(block, 0.4);
    vtkCSLFMaterial::SetMetallic(block, metallic);
  }
  return scene;
}

/// A glossy floor and sphere, which hardly need rays beyond the first, and metal ones, which do.
void TestFloorAndSphere()
{
  for (const double metallic : { 0.0, 1.0 })
  {
    IntegratorComparison comparison(MakeStillLife(metallic), 1.2, 0.9, 2.0);
    for (vtkCSLFViewTracer* tracer : { comparison.Reference.Get(), comparison.Cached.Get() })
    {
      tracer->GetEnvironment()->SetModeToGradient();
      tracer->GetEnvironment()->SetBottomColor(0.2, 0.3, 0.4);
    }
    CSLF_CHECK(comparison.GetPSNR() > 38.0);
    const vtkTypeUInt64 rays = comparison.Cached->GetNumberOfRays();
    CSLF_CHECK(
      metallic > 0.0 ? rays > Samples * Pixels * 11 / 10 : rays < Samples * Pixels * 11 / 10);
  }
}

/// A closed body stores nothing inside, unless there is light.
void TestClosedBodies()
{
  cslf::Mesh box;
  for (int i = 0; i < 8; ++i)
  {
    box.Vertices.emplace_back(i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f);
  }
  box.Triangles = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
    { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  box.Material = cslf::testing::MakeDiffuse(0.5f);
  for (const bool lit : { false, true })
  {
    std::vector<cslf::Mesh> meshes{ box };
    if (lit)
    {
      meshes.push_back(cslf::testing::MakeRectangle(glm::vec3(0.0f), { 0.1f, 0.0f, 0.0f },
        { 0.0f, 0.1f, 0.0f }, cslf::testing::MakeDiffuse(0.5f, 1.0f)));
    }
    const cslf::Scene scene(std::move(meshes), cslf::testing::MakeUniformLight(1.0f));
    const cslf::OpenSides sides(scene, cslf::PathIntegrator(scene, {}), 0, 0.01f);
    for (std::uint32_t i = 0; i < 12; ++i)
    {
      CSLF_CHECK(sides.Has(scene.GetTriangleIndex(0, i), false));
      CSLF_CHECK(sides.Has(scene.GetTriangleIndex(0, i), true) == lit);
    }
    cslf::CacheSettings settings;
    settings.Spacing = 0.1;
    settings.Samples = 64;
    cslf::RadianceCache cache(scene, settings);
    CSLF_CHECK(cache.Build([](double) { return true; }));
    cslf::Hit hit =
      scene.Intersect(cslf::testing::LookAt({ 0.3f, 2.0f, 0.2f }, { 0.3f, 0.0f, 0.2f }));
    CSLF_CHECK(hit.IsValid() && cache.Covers(hit));
    CSLF_CHECK_NEAR(cache.Get(hit).x, 1.0, 0.01);
    hit.Back = true;
    CSLF_CHECK(cache.Covers(hit) == lit);
  }
}

/// Seen through a small hole, surfaces that the cache leaves out are traced.
void TestHole()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(48);
  sphere->SetPhiResolution(24);
  sphere->Update();
  vtkNew<vtkCellArray> left;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < sphere->GetOutput()->GetNumberOfCells(); ++i)
  {
    sphere->GetOutput()->GetCellPoints(i, corners);
    double point[3];
    sphere->GetOutput()->GetPoint(corners->GetId(0), point);
    if (point[2] < 0.495)
    {
      left->InsertNextCell(corners);
    }
  }
  CSLF_CHECK(left->GetNumberOfCells() < sphere->GetOutput()->GetNumberOfCells());
  sphere->GetOutput()->SetPolys(left);
  IntegratorComparison comparison(sphere->GetOutput(), 0.0, 0.0, 0.7);
  // Light that comes through the hole is noisy.
  comparison.Reference->SetSamples(1024);
  comparison.Cached->SetSamples(256);
  CSLF_CHECK(comparison.GetPSNR() > 35.0);
}
}

int TestCSLFRadianceCacheGlossy(int, char*[])
{
  TestIncidentLight();
  TestFloorAndSphere();
  TestClosedBodies();
  TestHole();
  return cslf::testing::Result();
}
