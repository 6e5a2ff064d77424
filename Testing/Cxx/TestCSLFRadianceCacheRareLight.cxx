// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// Radiance caching where few samples find light: the mean over a crop and over 32 seeds is that of
// path tracing, so neither the number of samples nor the positions of points are biased by values.
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfTestTransport.h"

#include <iostream>
#include <vector>

namespace
{
using cslf::testing::Estimate;
using cslf::testing::MakeDiffuse;
using cslf::testing::MakeRectangle;

constexpr int Seeds = 32;

/// The visible part of a floor at z = 0, seen from above.
struct Crop
{
  glm::vec2 Center{ 0.0f };
  float Size = 0.2f;
  int Side = 8; ///< of the grid of visible places

  int GetNumberOfPlaces() const { return this->Side * this->Side; }

  cslf::Ray GetRay(int index) const
  {
    const glm::vec2 cell = glm::vec2(index % this->Side, index / this->Side) + 0.5f;
    const glm::vec2 place =
      this->Center + this->Size * (cell / static_cast<float>(this->Side) - 0.5f);
    return { glm::vec3(place, 0.01f), glm::vec3(0.0f, 0.0f, -1.0f) };
  }
};

/// The result of path tracing.
Estimate TracePaths(const cslf::Scene& scene, const Crop& crop, int samples)
{
  Estimate mean;
  const int places = crop.GetNumberOfPlaces();
  for (int i = 0; i < places; ++i)
  {
    const Estimate estimate = cslf::testing::Trace(scene, crop.GetRay(i), {}, samples);
    mean.Mean += estimate.Mean / places;
    mean.Error += std::pow(estimate.Error / places, 2);
  }
  mean.Error = std::sqrt(mean.Error);
  return mean;
}

/// The values in the caches of many seeds.
Estimate Cache(const cslf::Scene& scene, const Crop& crop, const cslf::CacheSettings& settings)
{
  Estimate mean;
  double squares = 0.0;
  for (int seed = 0; seed < Seeds; ++seed)
  {
    cslf::CacheSettings own = settings;
    own.Seed = seed;
    cslf::RadianceCache cache(scene, own);
    CSLF_CHECK(cache.Build([](double) { return true; }));
    double sum = 0.0;
    for (int i = 0; i < crop.GetNumberOfPlaces(); ++i)
    {
      const cslf::Hit hit = scene.Intersect(crop.GetRay(i));
      CSLF_CHECK(cache.Covers(hit));
      sum += scene.GetBaseColor(hit).x * cache.Get(hit).x / crop.GetNumberOfPlaces();
    }
    mean.Mean += sum / Seeds;
    squares += sum * sum / Seeds;
  }
  mean.Error = std::sqrt(std::max(0.0, squares - mean.Mean * mean.Mean) / (Seeds - 1));
  return mean;
}

/// The mean of a crop must be that of path tracing within the noise over seeds plus the allowed
/// error of interpolation, and within 2 % in any case.
void Compare(const char* name, const cslf::Scene& scene, const Crop& crop,
  const cslf::CacheSettings& settings, int samples)
{
  const Estimate paths = TracePaths(scene, crop, samples);
  const Estimate cache = Cache(scene, crop, settings);
  std::cout << name << ": " << paths.Mean << " +- " << paths.Error << " by path tracing, "
            << cache.Mean << " +- " << cache.Error << " by radiance caching\n";
  CSLF_CHECK(paths.Error < 0.005 * paths.Mean);
  CSLF_CHECK_NEAR(
    cache.Mean, paths.Mean, 3.0 * std::hypot(cache.Error, paths.Error) + 0.002 * paths.Mean);
  CSLF_CHECK_NEAR(cache.Mean, paths.Mean, 0.02 * paths.Mean);
}

cslf::Mesh MakeFloor(float size = 0.3f)
{
  return MakeRectangle(
    glm::vec3(0.0f), { size, 0.0f, 0.0f }, { 0.0f, size, 0.0f }, MakeDiffuse(0.5f));
}

cslf::Mesh MakeSphere(const glm::vec3& center, float radius, const cslf::SurfaceMaterial& material)
{
  constexpr int rows = 24;
  constexpr int columns = 48;
  cslf::Mesh mesh;
  for (int j = 0; j <= rows; ++j)
  {
    for (int i = 0; i <= columns; ++i)
    {
      const float theta = cslf::Pi * static_cast<float>(j) / rows;
      const float phi = 2.0f * cslf::Pi * static_cast<float>(i % columns) / columns;
      const glm::vec3 normal(
        std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
      mesh.Vertices.push_back(center + radius * normal);
      mesh.Normals.push_back(normal);
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j)
  {
    for (std::uint32_t i = 0; i < columns; ++i)
    {
      const std::uint32_t first = j * (columns + 1) + i;
      const std::uint32_t next = first + columns + 1;
      if (j + 1 < rows)
      {
        mesh.Triangles.push_back({ first, next, next + 1 });
      }
      if (j > 0)
      {
        mesh.Triangles.push_back({ first, next + 1, first + 1 });
      }
    }
  }
  mesh.Material = material;
  return mesh;
}

cslf::SurfaceMaterial MakeGlass()
{
  cslf::SurfaceMaterial material(glm::vec3(1.0f), 0.0f, 0.0f, 1.5f, glm::vec3(0.0f));
  material.Transmission = 1.0f;
  return material;
}

/// A small lamp that lights a floor, sampled as a light or found by chance. It covers a hundredth
/// or a thousandth of the directions of the floor, weighted by the cosine.
void TestSmallLamp()
{
  for (const float part : { 0.01f, 0.001f })
  {
    for (const bool isSampled : { true, false })
    {
      const float side = std::sqrt(part * cslf::Pi);
      const cslf::Scene scene({ MakeFloor(0.15f),
                                MakeRectangle({ 0.0f, 0.0f, 1.0f }, { 0.5f * side, 0.0f, 0.0f },
                                  { 0.0f, 0.5f * side, 0.0f }, MakeDiffuse(0.0f, 1.0f / part)) },
        cslf::LightSet());
      cslf::CacheSettings settings;
      settings.Spacing = isSampled ? 0.01 : 0.0025;
      settings.Paths.LightSampling = isSampled;
      Compare(isSampled ? "small lamp, sampled" : "small lamp, found", scene, {}, settings, 1024);
    }
  }
}

/// A lamp in a box with a hole in its bottom.
void TestHole()
{
  std::vector<cslf::Mesh> meshes{ MakeFloor() };
  const cslf::SurfaceMaterial white = MakeDiffuse(0.7f);
  const glm::vec3 x(0.3f, 0.0f, 0.0f);
  const glm::vec3 y(0.0f, 0.3f, 0.0f);
  const glm::vec3 z(0.0f, 0.0f, 0.2f);
  meshes.push_back(MakeRectangle({ 0.0f, 0.0f, 0.9f }, x, y, white));
  meshes.push_back(MakeRectangle({ 0.3f, 0.0f, 0.7f }, y, z, white));
  meshes.push_back(MakeRectangle({ -0.3f, 0.0f, 0.7f }, y, z, white));
  meshes.push_back(MakeRectangle({ 0.0f, 0.3f, 0.7f }, x, z, white));
  meshes.push_back(MakeRectangle({ 0.0f, -0.3f, 0.7f }, x, z, white));
  constexpr float hole = 0.03f;
  const float half = 0.5f * (0.3f - hole);
  for (const float sign : { -1.0f, 1.0f })
  {
    meshes.push_back(
      MakeRectangle({ sign * (hole + half), 0.0f, 0.5f }, { half, 0.0f, 0.0f }, y, white));
    meshes.push_back(MakeRectangle(
      { 0.0f, sign * (hole + half), 0.5f }, { hole, 0.0f, 0.0f }, { 0.0f, half, 0.0f }, white));
  }
  meshes.push_back(MakeRectangle(
    { 0.0f, 0.0f, 0.85f }, { 0.2f, 0.0f, 0.0f }, { 0.0f, 0.2f, 0.0f }, MakeDiffuse(0.0f, 50.0f)));
  const cslf::Scene scene(std::move(meshes), cslf::LightSet());
  cslf::CacheSettings settings;
  settings.Spacing = 0.02;
  Compare("hole", scene, {}, settings, 4096);
}

/// Lamps above each other. The lower ones hide most of the upper ones, so most samples of an upper
/// lamp find nothing.
void TestHiddenLamps()
{
  std::vector<cslf::Mesh> meshes{ MakeFloor() };
  for (int k = 0; k < 12; ++k)
  {
    const float side = 0.02f + 0.005f * static_cast<float>(k);
    meshes.push_back(MakeRectangle({ 0.0f, 0.0f, 0.5f + 0.05f * static_cast<float>(k) },
      { side, 0.0f, 0.0f }, { 0.0f, side, 0.0f }, MakeDiffuse(0.0f, 40.0f)));
  }
  const cslf::Scene scene(std::move(meshes), cslf::LightSet());
  cslf::CacheSettings settings;
  settings.Spacing = 0.02;
  Compare("hidden lamps", scene, {}, settings, 4096);
}

/// Light that a glass ball focuses on the floor. Its peak, 0.05 wide, has a radiance of 1.5 times
/// the lamp's power: dimmer and brighter than white, and shown darker as floats.
void TestCaustic(float power, double displayRange)
{
  const cslf::Scene scene({ MakeFloor(), MakeSphere({ 0.0f, 0.0f, 0.3f }, 0.2f, MakeGlass()),
                            MakeRectangle({ 0.0f, 0.0f, 1.0f }, { 0.1f, 0.0f, 0.0f },
                              { 0.0f, 0.1f, 0.0f }, MakeDiffuse(0.0f, power)) },
    cslf::LightSet());
  cslf::CacheSettings settings;
  settings.Spacing = 0.01;
  settings.DisplayRange = displayRange;
  Compare("caustic", scene, { glm::vec2(0.0f), 0.4f, 32 }, settings, 1024);
}
}

int TestCSLFRadianceCacheRareLight(int, char*[])
{
  TestSmallLamp();
  TestHole();
  TestHiddenLamps();
  TestCaustic(4.0f, cslf::DisplayCurve::ByteRange);
  TestCaustic(40.0f, cslf::DisplayCurve::FloatRange);
  return cslf::testing::Result();
}
