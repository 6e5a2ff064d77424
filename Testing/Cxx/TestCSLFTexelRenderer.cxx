// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Texels that take fewer samples where few are enough: their means have no bias, even if samples
// rarely find light or a surface, and their noise is the requested one.
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "cslfTestTransport.h"
#include "cslfTexelPicture.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <vector>

namespace
{
using cslf::testing::MakeDiffuse;
using cslf::testing::MakeRectangle;
using cslf::testing::TexelPicture;

constexpr int Seeds = 32;

/// Compares the mean of a picture over many seeds, with a noise target, with that of all samples.
void CheckMean(const char* name, TexelPicture picture, cslf::RenderSettings settings, int component)
{
  double means[2] = {};
  double squares[2] = {};
  std::uint64_t rays[2] = {};
  const double target = settings.NoiseTarget;
  for (int seed = 0; seed < Seeds; ++seed)
  {
    for (int i = 0; i < 2; ++i)
    {
      settings.NoiseTarget = i == 0 ? 0.0 : target;
      settings.Seed = static_cast<std::uint32_t>(2 * seed + i);
      std::uint64_t traced = 0;
      const double mean = picture.GetMean(settings, &traced)[component];
      means[i] += mean / Seeds;
      squares[i] += mean * mean / Seeds;
      rays[i] += traced;
    }
  }
  double variance = 0.0;
  for (int i = 0; i < 2; ++i)
  {
    variance += std::max(0.0, squares[i] - means[i] * means[i]) / (Seeds - 1);
  }
  const double error = std::sqrt(variance);
  std::cout << name << ": " << means[1] << " for " << means[0] << " +- " << error << ", rays "
            << static_cast<double>(rays[1]) / static_cast<double>(rays[0]) << "\n";
  CSLF_CHECK(error < 0.05 * means[0]);
  CSLF_CHECK_NEAR(means[1], means[0], 3.5 * error);
  CSLF_CHECK(rays[1] < rays[0]);
}

/// A room lit through a small hole.
std::vector<cslf::Mesh> MakeDarkRoom(double hole)
{
  const auto h = static_cast<float>(hole);
  const float side = 0.5f * (1.0f - h);
  const float middle = 0.5f * (1.0f + h);
  const cslf::SurfaceMaterial walls = MakeDiffuse(0.5f);
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, walls));
  for (const float sign : { -1.0f, 1.0f })
  {
    meshes.push_back(MakeRectangle({ sign, 0, 1 }, { 0, 1, 0 }, { 0, 0, 1 }, walls));
    meshes.push_back(MakeRectangle({ 0, sign, 1 }, { 1, 0, 0 }, { 0, 0, 1 }, walls));
    meshes.push_back(MakeRectangle({ sign * middle, 0, 2 }, { side, 0, 0 }, { 0, 1, 0 }, walls));
    meshes.push_back(MakeRectangle({ 0, sign * middle, 2 }, { h, 0, 0 }, { 0, side, 0 }, walls));
  }
  return meshes;
}

/// Thin emissive objects, with nothing behind them.
std::vector<cslf::Mesh> MakeWires(float width, float length)
{
  std::vector<cslf::Mesh> meshes;
  for (int i = 0; i < 12; ++i)
  {
    const float angle = 0.3f + 0.5f * static_cast<float>(i);
    const glm::vec3 along(std::cos(angle), std::sin(angle), 0.0f);
    const glm::vec3 across(-along.y, along.x, 0.0f);
    const glm::vec3 center(-0.7f + 0.12f * static_cast<float>(i), 0.5f * std::sin(5.0f * i), 0.0f);
    meshes.push_back(
      MakeRectangle(center, length * along, width * across, MakeDiffuse(0.0f, 1.0f)));
  }
  return meshes;
}

void TestRareLight()
{
  cslf::RenderSettings settings;
  settings.Samples = 64;
  settings.NoiseTarget = 0.02;
  const cslf::Scene room(MakeDarkRoom(0.07), cslf::testing::MakeUniformLight(4.0f));
  CheckMean("light through a hole", TexelPicture(room, 48, 1.9), settings, 1);

  // The same behind bars, with texels of one surface.
  std::vector<cslf::Mesh> behindBars = MakeDarkRoom(0.07);
  for (int i = 0; i < 12; ++i)
  {
    behindBars.push_back(MakeRectangle({ -0.97f + 0.17f * static_cast<float>(i), 0, 0.3f },
      { 0.03f, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(0.5f)));
  }
  const cslf::Scene barred(behindBars, cslf::testing::MakeUniformLight(4.0f));
  settings.SurfaceTexels = true;
  CheckMean("light behind bars", TexelPicture(barred, 48, 1.9), settings, 1);
  settings.SurfaceTexels = false;

  // A mirror that shows many small lamps behind the camera.
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle(
    { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { glm::vec3(1.0f), 1.0f, 0.0f, 1.0f, glm::vec3(0) }));
  for (int i = 0; i < 24; ++i)
  {
    meshes.push_back(MakeRectangle({ 0.9f * std::sin(7.0f * i), 0.9f * std::cos(12.0f * i), 2.0f },
      { 0.006f, 0, 0 }, { 0, 0.006f, 0 }, MakeDiffuse(0.0f, 10.0f)));
  }
  const cslf::Scene mirror(meshes, cslf::LightSet());
  CheckMean("lamps in a mirror", TexelPicture(mirror, 64, 1.0), settings, 1);
}

void TestThinThings()
{
  cslf::RenderSettings settings;
  settings.Samples = 64;
  settings.NoiseTarget = 0.02;
  const cslf::LightSet dark;
  const cslf::Scene wires(MakeWires(0.002f, 0.3f), dark);
  CheckMean("coverage of wires", TexelPicture(wires, 48, 1.0), settings, 3);
  const cslf::Scene specks(MakeWires(0.008f, 0.008f), dark);
  CheckMean("coverage of specks", TexelPicture(specks, 96, 1.0), settings, 3);

  // In front of a wall whose light is cached.
  std::vector<cslf::Mesh> meshes = MakeWires(0.002f, 0.3f);
  for (cslf::Mesh& mesh : meshes)
  {
    mesh.Material = MakeDiffuse(0.8f);
    std::for_each(mesh.Vertices.begin(), mesh.Vertices.end(), [](glm::vec3& p) { p.z = 0.1f; });
  }
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, MakeDiffuse(0.0f)));
  const cslf::Scene scene(meshes, cslf::testing::MakeUniformLight(1.0f));
  cslf::CacheSettings cacheSettings;
  cacheSettings.Spacing = 0.1;
  cacheSettings.Samples = 64;
  cslf::RadianceCache cache(scene, cacheSettings);
  CSLF_CHECK(cache.Build([](double) { return true; }));
  settings.Cache = &cache;
  CheckMean("wires over a wall", TexelPicture(scene, 48, 1.0), settings, 1);

  // The surface at a texel's centre does not depend on the number of samples.
  settings.SurfaceTexels = true;
  TexelPicture picture(scene, 48, 1.0);
  const std::vector<float> few = picture.Render(settings);
  settings.NoiseTarget = 0.0;
  const std::vector<float> all = picture.Render(settings);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    CSLF_CHECK_NEAR(few[i], all[i], 1e-6);
  }
}

/// Bars in front of a wall, all of which glow: a texel's colour is that of the surface at its
/// centre, which takes few samples, whatever the others see.
void TestSurfaceTexels()
{
  constexpr int size = 64;
  std::vector<cslf::Mesh> meshes;
  meshes.push_back(MakeRectangle({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, MakeDiffuse(0.0f, 0.2f)));
  for (int i = 0; i < 12; ++i)
  {
    meshes.push_back(MakeRectangle({ -0.97f + 0.17f * static_cast<float>(i), 0, 0.5f },
      { 0.05f, 0, 0 }, { 0, 2, 0 }, MakeDiffuse(0.0f, 0.8f)));
  }
  const cslf::Scene scene(meshes, cslf::LightSet());
  cslf::RenderSettings settings;
  settings.Samples = 64;
  settings.NoiseTarget = 0.004;
  std::uint64_t rays[2] = {};
  std::vector<float> colors;
  for (const bool areSurfaces : { false, true })
  {
    settings.SurfaceTexels = areSurfaces;
    colors = TexelPicture(scene, size, 1.0).Render(settings, &rays[areSurfaces ? 1 : 0]);
  }
  std::cout << "rays for surfaces, in those for means: "
            << static_cast<double>(rays[1]) / static_cast<double>(rays[0]) << "\n";
  CSLF_CHECK(rays[1] < rays[0] / 4);
  for (int i = 0; i < size * size; ++i)
  {
    const float x = 2.0f * (static_cast<float>(i % size) + 0.5f) / size - 1.0f;
    const float place = std::fmod(x + 0.97f + 0.085f, 0.17f) - 0.085f;
    CSLF_CHECK_NEAR(colors[4 * i + 1], std::abs(place) < 0.05f ? 0.8f : 0.2f, 1e-6);
    CSLF_CHECK_NEAR(colors[4 * i + 3], 1.0f, 1e-6);
  }
}
}

int TestCSLFTexelRenderer(int, char*[])
{
  TestSurfaceTexels();
  TestRareLight();
  TestThinThings();
  return cslf::testing::Result();
}
