// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Paths that are followed together find the same as each path alone.
#include "PathTracing/Paths/cslfPathBatch.h"
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;

cslf::SurfaceMaterial MakeGlass(float roughness)
{
  cslf::SurfaceMaterial glass(glm::vec3(0.9f, 1.0f, 0.8f), 0.0f, roughness, 1.5f, Dark);
  glass.Transmission = 1.0f;
  return glass;
}

/// A mesh for each kind of surface except one: the floor of a given material, a coloured wall, a
/// shaded bump, a lamp, a sphere, a tube, an instance and a sheet.
std::vector<cslf::Mesh> MakeRoom(const cslf::SurfaceMaterial& floor)
{
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, floor));
  meshes.push_back(MakeRectangle({ 1, 0, 0.5f }, { 0, 1, 0 }, { 0, 0, 0.5f }, MakeDiffuse(0.6f)));
  meshes.back().Colors = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 } };
  meshes.back().Coloring = cslf::Mesh::ColorsOf::Vertices;
  meshes.push_back(
    MakeRectangle({ -1, 0, 0.5f }, { 0, 1, 0 }, { 0, 0, 0.5f }, MakeDiffuse(0.6f, 0.2f)));
  meshes.back().Colors = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 } };
  meshes.back().Emissions = { { 0.1f, 0, 0 }, { 0, 0.5f, 0 }, { 0, 0, 0.2f }, { 0.5f, 0, 0 } };
  meshes.back().Coloring = cslf::Mesh::ColorsOf::Vertices;
  meshes.back().EmissionsOf = cslf::Mesh::ColorsOf::Vertices;
  meshes.back().DisplayedWhite = { 0.5f, 1.0f, 2.0f };
  meshes.push_back(
    MakeRectangle({ -0.4f, 0.3f, 0.1f }, { 0.2f, 0, 0 }, { 0, 0.2f, 0 }, MakeDiffuse(0.8f)));
  meshes.back().Normals = { { -1, -1, 2 }, { 1, -1, 2 }, { 1, 1, 2 }, { -1, 1, 2 } };
  meshes.push_back(
    MakeRectangle({ 0, 0, 0.9f }, { 0.3f, 0, 0 }, { 0, 0.3f, 0 }, MakeDiffuse(0.2f, 2.0f)));
  cslf::Mesh sphere;
  sphere.Shape = cslf::Mesh::Shapes::Spheres;
  sphere.Vertices = { { 0.4f, 0.4f, 0.2f } };
  sphere.Radii = { 0.2f };
  sphere.Material = MakeDiffuse(0.7f, 0.3f);
  meshes.push_back(sphere);
  cslf::Mesh tube;
  tube.Shape = cslf::Mesh::Shapes::Tubes;
  tube.Vertices = { { -0.7f, -0.6f, 0.1f }, { 0.2f, -0.7f, 0.4f } };
  tube.Radii = { 0.1f, 0.05f };
  tube.Material = cslf::SurfaceMaterial(glm::vec3(0.5f), 0.0f, 0.5f, 1.5f, glm::vec3(0.5f));
  meshes.push_back(tube);
  meshes.push_back(
    MakeRectangle({ 0, 0, 0 }, { 0.2f, 0, 0 }, { 0, 0.1f, 0.1f }, MakeDiffuse(0.5f)));
  cslf::MeshInstance instance;
  instance.Offset = { 0.5f, -0.2f, 0.3f };
  meshes.back().Instances = { instance };
  meshes.push_back(
    MakeRectangle({ -0.3f, 0, 0.6f }, { 0.3f, 0, 0 }, { 0, 0.3f, 0 }, MakeDiffuse(0.5f)));
  return meshes;
}

cslf::LightSet MakeLights(bool image)
{
  cslf::LightSet lights;
  if (image)
  {
    cslf::EnvironmentImage pixels{ 16, 8, std::vector<glm::vec3>(128, glm::vec3(0.2f)) };
    pixels.Pixels[37] = glm::vec3(20.0f);
    lights.Surroundings = { pixels, 1.0f, cslf::EnvironmentAxes() };
  }
  else
  {
    lights.Surroundings = { glm::vec3(0.1f), glm::vec3(1.0f, 0.9f, 0.8f), cslf::EnvironmentAxes() };
    lights.Directional.push_back({ glm::normalize(glm::vec3(1, 2, -4)), glm::vec3(0.5f) });
    lights.Points.push_back({ { -0.8f, 0.8f, 0.8f }, glm::vec3(0.2f) });
  }
  return lights;
}

/// First rays from above to all of the floor.
std::vector<cslf::PathBatch::Start> MakeStarts()
{
  std::vector<cslf::PathBatch::Start> starts;
  constexpr int side = 30;
  for (int i = 0; i < side * side; ++i)
  {
    const float x = -0.95f + 1.9f * static_cast<float>(i % side) / side;
    const float y = -0.95f + 1.9f * static_cast<float>(i / side) / side;
    cslf::PathBatch::Start start;
    start.First = LookAt({ -0.5f, -0.3f, 1.5f }, { x, y, 0.0f });
    start.Hash = cslf::SampleStream::HashTexel(5, 0, i % 50, 0);
    start.Index = static_cast<std::uint32_t>(i / 50);
    starts.push_back(start);
  }
  return starts;
}

/// Compares a batch with paths on their own. If a decision depends on the last bit of a number, a
/// path may go another way; few do.
void Compare(const cslf::Scene& scene, const cslf::PathSettings& settings, bool seen,
  const cslf::RadianceCache* cache = nullptr, double allowed = 0.02)
{
  const cslf::PathIntegrator integrator(scene, settings, cache);
  const std::vector<cslf::PathBatch::Start> starts = MakeStarts();
  cslf::PathBatch batch;
  for (const cslf::PathBatch::Start& start : starts)
  {
    if (seen)
    {
      batch.Add(start, scene.Intersect(start.First));
    }
    else
    {
      batch.Add(start);
    }
  }
  std::uint64_t rays = 0;
  integrator.Follow(batch, rays);
  std::uint64_t expectedRays = seen ? 0 : starts.size();
  int different = 0;
  glm::dvec3 sum(0.0);
  for (int path = 0; path < batch.GetSize(); ++path)
  {
    const cslf::PathBatch::Start& start = starts[path];
    const cslf::Hit hit = scene.Intersect(start.First);
    CSLF_CHECK(batch.GetSeen(path).Mesh == hit.Mesh);
    const glm::vec3 expected = FollowAlone(integrator, start, hit, expectedRays);
    const glm::vec3 found = batch.GetRadiance(path);
    const float scale = 1.0f + std::max({ expected.x, expected.y, expected.z });
    different += glm::distance(found, expected) > 2e-3f * scale ? 1 : 0;
    sum += glm::dvec3(expected);
  }
  CSLF_CHECK(sum.x > 0.05 * static_cast<double>(starts.size()));
  CSLF_CHECK(different <= allowed * batch.GetSize());
  const auto traced = static_cast<double>(rays);
  CSLF_CHECK_NEAR(traced / static_cast<double>(expectedRays), 1.0, 0.01);
}

void TestMaterials()
{
  const cslf::SurfaceMaterial materials[] = { MakeDiffuse(0.7f), MakeDiffuse(0.5f, 0.3f),
    { glm::vec3(0.9f, 0.7f, 0.5f), 1.0f, 0.4f, 1.0f, Dark },
    { glm::vec3(0.9f), 1.0f, 0.0f, 1.0f, Dark }, { glm::vec3(0.5f), 0.0f, 0.5f, 1.5f, Dark },
    { glm::vec3(0.5f), 0.5f, 0.3f, 1.5f, Dark }, MakeGlass(0.0f), MakeGlass(0.4f) };
  for (const cslf::SurfaceMaterial& material : materials)
  {
    for (bool image : { false, true })
    {
      const cslf::Scene scene(MakeRoom(material), MakeLights(image));
      Compare(scene, {}, image);
    }
  }
}

void TestEstimators()
{
  const cslf::Scene scene(MakeRoom(MakeDiffuse(0.7f)), MakeLights(true));
  for (int mode = 0; mode < 4; ++mode)
  {
    cslf::PathSettings settings;
    settings.MaximumDepth = 1 + mode;
    settings.LightSampling = mode != 1;
    settings.BSDFSampling = mode != 2;
    Compare(scene, settings, true);
  }
}

/// Paths that end at look-ups, of diffuse and of rough surfaces, beside some that continue.
void TestCache()
{
  const cslf::SurfaceMaterial rough(glm::vec3(0.5f), 0.0f, 0.6f, 1.5f, Dark);
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, rough));
  meshes.push_back(MakeRectangle({ 1, 0, 0.5f }, { 0, 1, 0 }, { 0, 0, 0.5f }, rough));
  meshes.push_back(MakeRectangle({ 0, 1, 0.5f }, { 1, 0, 0 }, { 0, 0, 0.5f }, MakeDiffuse(0.6f)));
  meshes.push_back(MakeRectangle(
    { -1, 0, 0.5f }, { 0, 1, 0 }, { 0, 0, 0.5f }, { glm::vec3(0.9f), 1.0f, 0.2f, 1.0f, Dark }));
  cslf::LightSet lights;
  lights.Surroundings = { glm::vec3(0.1f), glm::vec3(1.0f), cslf::EnvironmentAxes() };
  const cslf::Scene scene(meshes, lights);
  cslf::CacheSettings settings;
  settings.Spacing = 0.1;
  settings.Samples = 256;
  cslf::RadianceCache cache(scene, settings);
  CSLF_CHECK(cache.Build([](double) { return true; }));
  Compare(scene, {}, true, &cache);
  Compare(scene, {}, false, &cache);
}

/// Whether a path passes a veil depends on the last bits of a ray.
void TestVeil()
{
  std::vector<cslf::Mesh> meshes = MakeRoom(MakeDiffuse(0.7f));
  meshes.back().Material.Opacity = 0.4f;
  Compare(cslf::Scene(meshes, MakeLights(true)), {}, true, nullptr, 0.05);
}

void TestSizes()
{
  // Batches with no path, one path, and too few to fill a packet. Earlier contents of a batch do
  // not matter.
  const cslf::Scene scene(MakeRoom(MakeDiffuse(0.7f)), MakeLights(false));
  const cslf::PathIntegrator integrator(scene, {});
  const std::vector<cslf::PathBatch::Start> starts = MakeStarts();
  cslf::PathBatch batch;
  std::uint64_t rays = 0;
  integrator.Follow(batch, rays);
  CSLF_CHECK(rays == 0);
  for (int size : { 33, 1, 16, 17 })
  {
    batch.Clear();
    for (int i = 0; i < size; ++i)
    {
      batch.Add(starts[i], scene.Intersect(starts[i].First));
    }
    integrator.Follow(batch, rays);
    for (int i = 0; i < size; ++i)
    {
      const glm::vec3 expected = FollowAlone(integrator, starts[i], batch.GetSeen(i), rays);
      CSLF_CHECK(glm::distance(batch.GetRadiance(i), expected) < 2e-3f);
    }
  }
}
}

int TestCSLFPathBatch(int, char*[])
{
  TestMaterials();
  TestEstimators();
  TestCache();
  TestVeil();
  TestSizes();
  return cslf::testing::Result();
}
