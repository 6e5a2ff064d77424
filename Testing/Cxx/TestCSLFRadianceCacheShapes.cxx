// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cached light of spheres, tubes and instances: that of a gradient, which is known exactly;
// that of path tracing where shapes hide each other; and none where it is not stored.
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "PathTracing/Rays/cslfHitGeometry.h"
#include "cslfTestTransport.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <iostream>
#include <vector>

namespace
{
using cslf::testing::Dark;
using cslf::testing::LookAt;
using cslf::testing::MakeDiffuse;
using cslf::testing::White;

constexpr float Reflectance = 0.6f;

cslf::CacheSettings MakeSettings(float spacing)
{
  cslf::CacheSettings settings;
  settings.Spacing = spacing;
  settings.Samples = 1024;
  return settings;
}

cslf::Mesh MakeSphere(const glm::vec3& center, float radius)
{
  cslf::Mesh mesh;
  mesh.Shape = cslf::Mesh::Shapes::Spheres;
  mesh.Vertices = { center };
  mesh.Radii = { radius };
  mesh.Material = MakeDiffuse(Reflectance);
  return mesh;
}

cslf::Mesh MakeTube()
{
  cslf::Mesh mesh = MakeSphere({ -0.5f, -0.1f, 0.0f }, 0.15f);
  mesh.Shape = cslf::Mesh::Shapes::Tubes;
  mesh.Vertices.emplace_back(0.5f, 0.2f, 0.1f);
  mesh.Radii.push_back(0.05f);
  return mesh;
}

/// A cube with outward normals.
cslf::Mesh MakeCube()
{
  cslf::Mesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.Vertices.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
  }
  mesh.Triangles = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
    { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  mesh.Material = MakeDiffuse(Reflectance);
  return mesh;
}

/// A cube's copy: mirrored, and larger than itself along one axis.
cslf::Mesh MakeInstance()
{
  cslf::Mesh mesh = MakeCube();
  cslf::MeshInstance instance;
  instance.Linear = glm::mat3(-0.5f, 0.1f, 0.0f, 0.1f, 0.4f, 0.0f, 0.0f, 0.1f, 0.6f);
  instance.Offset = { 0.2f, -0.2f, -0.3f };
  mesh.Instances = { instance };
  return mesh;
}

/// Rays from all around to points near the middle.
std::vector<cslf::Ray> MakeRays(int count)
{
  std::vector<cslf::Ray> rays;
  for (int i = 0; i < count; ++i)
  {
    const float z = 2.0f * (i + 0.5f) / count - 1.0f;
    const float radius = std::sqrt(1.0f - z * z);
    const float angle = 2.4f * i;
    const glm::vec3 from = 2.0f * glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z);
    rays.push_back(LookAt(from, { 0.2f * std::sin(1.7f * i), 0.0f, 0.1f * std::cos(3.1f * i) }));
  }
  return rays;
}

/// The light of a gradient's radiance, linear in the height of the direction: the mean of its ends,
/// and two thirds of half their difference in proportion to the height of the normal.
void TestGradient(const cslf::Mesh& mesh, float spacing)
{
  cslf::LightSet lights;
  lights.Surroundings = cslf::Environment(glm::vec3(0.2f), White, cslf::EnvironmentAxes());
  const cslf::Scene scene({ mesh }, lights);
  cslf::RadianceCache cache(scene, MakeSettings(spacing));
  CSLF_CHECK(cache.Build([](double) { return true; }));
  CSLF_CHECK(cache.GetNumberOfValues() > 0);
  double sum = 0.0;
  double squares = 0.0;
  int hits = 0;
  for (const cslf::Ray& ray : MakeRays(1000))
  {
    const cslf::Hit hit = scene.Intersect(ray);
    glm::vec3 radiance(0.0f);
    if (hit.IsValid() && cache.LookUpShape(ray, hit, radiance))
    {
      const float height = scene.GetSurface(ray, hit).ShadingNormal.y;
      const float light = 0.5f * (White.x + 0.2f) + 0.5f * (White.x - 0.2f) * height * 2.0f / 3.0f;
      const double difference = radiance.x - Reflectance * light;
      sum += difference;
      squares += difference * difference;
      ++hits;
    }
  }
  CSLF_CHECK(hits > 20);
  CSLF_CHECK_NEAR(sum / hits, 0.0, 0.006);
  CSLF_CHECK_NEAR(std::sqrt(squares / hits), 0.0, 0.012);
}

/// A ball on a stick that ends within it: the hidden end must not darken what is seen.
void TestOcclusion()
{
  cslf::Mesh stick = MakeSphere({ 0.0f, 0.0f, 0.0f }, 0.08f);
  stick.Shape = cslf::Mesh::Shapes::Tubes;
  stick.Vertices.emplace_back(0.0f, 0.6f, 0.0f);
  stick.Radii.push_back(0.08f);
  const cslf::Scene scene({ MakeSphere(Dark, 0.2f), stick }, cslf::testing::MakeUniformLight(1.0f));
  cslf::RadianceCache cache(scene, MakeSettings(0.03f));
  CSLF_CHECK(cache.Build([](double) { return true; }));
  double squares = 0.0;
  int hits = 0;
  for (const cslf::Ray& ray : MakeRays(60))
  {
    const cslf::Hit hit = scene.Intersect(ray);
    glm::vec3 radiance(0.0f);
    if (hit.IsValid())
    {
      CSLF_CHECK(cache.LookUpShape(ray, hit, radiance));
      const cslf::testing::Estimate truth = cslf::testing::Trace(scene, ray, {}, 1 << 12);
      squares += std::pow(radiance.x - truth.Mean, 2);
      ++hits;
    }
  }
  CSLF_CHECK(hits > 20);
  CSLF_CHECK_NEAR(std::sqrt(squares / hits), 0.0, 0.015);
}

/// Points of a cloud, which reach into each other: their gaps must not darken what is seen.
void TestCrowd()
{
  cslf::Mesh crowd;
  crowd.Shape = cslf::Mesh::Shapes::Spheres;
  crowd.Material = MakeDiffuse(Reflectance);
  for (const cslf::Ray& ray : MakeRays(1000))
  {
    crowd.Vertices.push_back(0.2f * ray.Origin);
    crowd.Radii.push_back(0.03f);
  }
  const cslf::Scene scene({ crowd }, cslf::testing::MakeUniformLight(1.0f));
  for (const int samples : { 32, 512 })
  {
    cslf::CacheSettings settings = MakeSettings(0.02f);
    settings.Samples = samples;
    cslf::RadianceCache cache(scene, settings);
    CSLF_CHECK(cache.Build([](double) { return true; }));
    double difference = 0.0;
    double sum = 0.0;
    for (const cslf::Ray& ray : MakeRays(600))
    {
      const cslf::Hit hit = scene.Intersect(ray);
      glm::vec3 radiance(0.0f);
      if (hit.IsValid() && cache.LookUpShape(ray, hit, radiance))
      {
        const double truth = cslf::testing::Trace(scene, ray, {}, 1 << 9).Mean;
        difference += radiance.x - truth;
        sum += truth;
      }
    }
    std::cout << samples << " samples: " << 100.0 * difference / sum << " % brighter\n";
    CSLF_CHECK(sum > 100.0);
    CSLF_CHECK_NEAR(difference / sum, 0.0, 0.02);
  }
}

/// A ball within a half-transparent one, whose inside is no reason to leave out a sample.
void TestVeil()
{
  cslf::Mesh veil = MakeSphere(Dark, 0.6f);
  veil.Opacities = { 0.5f };
  veil.Colors = { glm::vec3(Reflectance) };
  veil.Coloring = cslf::Mesh::ColorsOf::Vertices;
  const cslf::Scene scene({ MakeSphere(Dark, 0.2f), veil }, cslf::testing::MakeUniformLight(1.0f));
  cslf::RadianceCache cache(scene, MakeSettings(0.2f));
  CSLF_CHECK(cache.Build([](double) { return true; }));
  const cslf::Ray ray{ { 0.1f, 0.1f, 0.4f }, { 0.0f, 0.0f, -1.0f } };
  const cslf::Hit hit = scene.Intersect(ray);
  glm::vec3 radiance(0.0f);
  CSLF_CHECK(hit.IsValid() && cache.LookUpShape(ray, hit, radiance));
  CSLF_CHECK_NEAR(radiance.x, cslf::testing::Trace(scene, ray, {}, 1 << 14).Mean, 0.02);
}

/// Light is not stored within closed bodies, and lights that are sampled are not part of it.
void TestWhatIsNotStored()
{
  const auto ask = [](const cslf::Scene& scene, const cslf::Ray& ray)
  {
    cslf::RadianceCache cache(scene, MakeSettings(0.05f));
    CSLF_CHECK(cache.Build([](double) { return true; }));
    const cslf::Hit hit = scene.Intersect(ray);
    CSLF_CHECK(hit.IsValid());
    glm::vec3 radiance(0.0f);
    return cache.LookUpShape(ray, hit, radiance);
  };
  const cslf::LightSet lights = cslf::testing::MakeUniformLight(1.0f);
  const cslf::Ray within{ { 0.0f, 0.0f, 0.0f }, { 0.0f, 0.0f, 1.0f } };
  const cslf::Ray outside{ { 0.0f, 0.0f, 2.0f }, { 0.0f, 0.0f, -1.0f } };
  const cslf::Scene cube({ MakeInstance() }, lights);
  CSLF_CHECK(!ask(cube, within));
  CSLF_CHECK(ask(cube, outside));
  const cslf::Scene ball({ MakeSphere(Dark, 0.4f) }, lights);
  CSLF_CHECK(!ask(ball, within));
  CSLF_CHECK(ask(ball, outside));
  cslf::Mesh lamp = MakeSphere({ 0.0f, 0.8f, 0.0f }, 0.1f);
  lamp.Material = MakeDiffuse(0.0f, 5.0f);
  const cslf::Scene lit({ MakeSphere(Dark, 0.4f), lamp }, lights);
  CSLF_CHECK(!ask(lit, outside));
}

/// Many small shapes share what is stored; a large one is divided.
void TestCells()
{
  cslf::Mesh dust = MakeSphere(Dark, 0.001f);
  for (int i = 1; i < 5000; ++i)
  {
    dust.Vertices.emplace_back(
      0.3f * std::sin(1.1f * i), 0.3f * std::sin(1.7f * i), 0.3f * std::sin(2.3f * i));
    dust.Radii.push_back(0.001f);
  }
  const cslf::Scene scene({ dust }, cslf::testing::MakeUniformLight(1.0f));
  const cslf::ShapeLayout shared(scene, 0.1f);
  CSLF_CHECK(shared.GetNumberOfCells() <= 512);
  const cslf::ShapeLayout single(scene, 0.0005f);
  CSLF_CHECK(single.GetNumberOfCells() == 5000);
  const cslf::Scene ball({ MakeSphere(Dark, 0.5f) }, cslf::testing::MakeUniformLight(1.0f));
  CSLF_CHECK(cslf::ShapeLayout(ball, 0.2f).GetNumberOfCells() == 1);
  CSLF_CHECK(cslf::ShapeLayout(ball, 0.025f).GetNumberOfCells() == 1000);
}
}

int TestCSLFRadianceCacheShapes(int, char*[])
{
  for (const float spacing : { 1.0f, 0.05f })
  {
    TestGradient(MakeSphere({ 0.05f, 0.0f, 0.0f }, 0.5f), spacing);
    TestGradient(MakeTube(), spacing);
    TestGradient(MakeInstance(), spacing);
    cslf::Mesh cone = MakeTube();
    cone.Radii = { 0.5f, 0.02f };
    TestGradient(cone, spacing);
    cone.Instances.resize(1);
    TestGradient(cone, spacing);
  }
  TestOcclusion();
  TestCrowd();
  TestVeil();
  TestWhatIsNotStored();
  TestCells();
  return cslf::testing::Result();
}
