// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cached light of bodies that reach into each other: what is hidden in a body must not darken
// what is seen, and what is hidden above a lamp must not brighten it.
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "cslfTestTransport.h"

#include <cmath>
#include <iostream>

namespace
{
/// A closed box. Its triangles share no vertices.
cslf::Mesh MakeBox(const glm::vec3& low, const glm::vec3& high, bool hasNormals)
{
  const glm::uvec3 triangles[] = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 },
    { 0, 5, 4 }, { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  cslf::Mesh mesh;
  mesh.Material = cslf::testing::MakeDiffuse(0.6f);
  for (const glm::uvec3& corners : triangles)
  {
    const auto first = static_cast<std::uint32_t>(mesh.Vertices.size());
    for (const std::uint32_t corner : { corners.x, corners.y, corners.z })
    {
      mesh.Vertices.push_back(
        glm::mix(low, high, glm::vec3(corner & 1u, (corner >> 1) & 1u, (corner >> 2) & 1u)));
    }
    mesh.Triangles.emplace_back(first, first + 1, first + 2);
    const glm::vec3 normal =
      glm::normalize(glm::cross(mesh.Vertices[first + 1] - mesh.Vertices[first],
        mesh.Vertices[first + 2] - mesh.Vertices[first]));
    if (hasNormals)
    {
      mesh.Normals.insert(mesh.Normals.end(), 3, normal);
    }
  }
  return mesh;
}

/// An opaque sphere.
cslf::Mesh MakeBall(const glm::vec3& center, float radius, float reflectance)
{
  cslf::Mesh mesh;
  mesh.Shape = cslf::Mesh::Shapes::Spheres;
  mesh.Material = cslf::testing::MakeDiffuse(reflectance);
  mesh.Vertices = { center };
  mesh.Radii = { radius };
  return mesh;
}

/// A post whose lower part is in a body, seen from all sides.
void TestPost(const cslf::Mesh& body, float spacing, int samples, bool hasNormals)
{
  const cslf::Scene scene(
    { body, MakeBox({ -0.1f, -0.1f, -0.8f }, { 0.1f, 0.1f, 0.6f }, hasNormals) },
    cslf::testing::MakeUniformLight(1.0f));
  cslf::CacheSettings settings;
  settings.Spacing = spacing;
  settings.Samples = samples;
  cslf::RadianceCache cache(scene, settings);
  CSLF_CHECK(cache.Build([](double) { return true; }));
  double squares = 0.0;
  int hits = 0;
  for (int i = 0; i < 60; ++i)
  {
    const float angle = 2.4f * i;
    const glm::vec3 from(2.0f * std::cos(angle), 2.0f * std::sin(angle), 1.0f);
    const cslf::Ray ray = cslf::testing::LookAt(from, { 0.0f, 0.0f, 0.1f + 0.005f * i });
    const cslf::Hit hit = scene.Intersect(ray);
    const bool isStored = hit.IsValid() && scene.GetMeshes()[hit.Mesh].CanHoldLattice();
    CSLF_CHECK(hit.IsValid() && cache.Covers(hit) == isStored);
    if (isStored)
    {
      const double truth = cslf::testing::Trace(scene, ray, {}, 1 << 12).Mean;
      squares += std::pow(0.6 * cache.Get(hit).x - truth, 2);
      ++hits;
    }
  }
  const double error = std::sqrt(squares / std::max(hits, 1));
  std::cout << error << ": spacing " << spacing << ", " << samples << " samples\n";
  CSLF_CHECK(hits > 0);
  CSLF_CHECK(error < 0.05);
}

/// A floor in a closed body that a lamp lights from within.
void TestLamp(const cslf::Mesh& body)
{
  const cslf::Mesh lamp = cslf::testing::MakeRectangle({ 0.0f, 0.0f, 0.8f }, { 0.0f, 0.3f, 0.0f },
    { 0.3f, 0.0f, 0.0f }, cslf::testing::MakeDiffuse(0.0f, 5.0f));
  const cslf::Mesh floor = cslf::testing::MakeRectangle({ 0.0f, 0.0f, 0.0f }, { 0.5f, 0.0f, 0.0f },
    { 0.0f, 0.5f, 0.0f }, cslf::testing::MakeDiffuse(0.6f));
  const cslf::Scene scene({ body, lamp, floor }, cslf::testing::MakeUniformLight(0.0f));
  cslf::CacheSettings settings;
  settings.Spacing = 0.1;
  settings.Samples = 512;
  cslf::RadianceCache cache(scene, settings);
  CSLF_CHECK(cache.Build([](double) { return true; }));
  for (const float x : { -0.4f, 0.1f, 0.3f })
  {
    const cslf::Ray ray = cslf::testing::LookAt({ 0.8f, 0.1f, 0.3f }, { x, -0.2f, 0.0f });
    const cslf::Hit hit = scene.Intersect(ray);
    CSLF_CHECK(hit.IsValid() && hit.Mesh == 2 && cache.Covers(hit));
    const double truth = cslf::testing::Trace(scene, ray, {}, 1 << 14).Mean;
    CSLF_CHECK(truth > 0.1);
    CSLF_CHECK_NEAR(0.6 * cache.Get(hit).x, truth, 0.03 * truth);
  }
}

/// A ceiling a little above a lamp, with a rim between them: beside the lamp, it gets only the
/// light of the floor.
void TestGap()
{
  constexpr float gap = 0.01f;
  const auto makeRectangle = cslf::testing::MakeRectangle;
  const cslf::SurfaceMaterial white = cslf::testing::MakeDiffuse(0.6f);
  const glm::vec3 x(0.2f, 0.0f, 0.0f);
  const glm::vec3 y(0.0f, 0.2f, 0.0f);
  const glm::vec3 z(0.0f, 0.0f, 0.5f * gap);
  const glm::vec3 middle(0.0f, 0.0f, 0.5f - 0.5f * gap);
  const cslf::Scene scene(
    { makeRectangle({ 0.0f, 0.0f, 0.5f }, 5.0f * y, 5.0f * x, white),
      makeRectangle({ 0.0f, 0.0f, -0.5f }, 5.0f * x, 5.0f * y, white),
      makeRectangle({ 0.0f, 0.0f, 0.5f - gap }, y, x, cslf::testing::MakeDiffuse(0.0f, 5.0f)),
      makeRectangle(middle + x, y, z, white), makeRectangle(middle - x, y, z, white),
      makeRectangle(middle + y, z, x, white), makeRectangle(middle - y, z, x, white) },
    cslf::testing::MakeUniformLight(0.0f));
  cslf::CacheSettings settings;
  settings.Spacing = 0.1;
  settings.Samples = 512;
  cslf::RadianceCache cache(scene, settings);
  CSLF_CHECK(cache.Build([](double) { return true; }));
  for (const float beside : { 0.201f, 0.21f, 0.25f, 0.3f })
  {
    const cslf::Ray ray = cslf::testing::LookAt({ 0.9f, 0.1f, 0.2f }, { beside, 0.03f, 0.5f });
    const cslf::Hit hit = scene.Intersect(ray);
    CSLF_CHECK(hit.IsValid() && hit.Mesh == 0 && cache.Covers(hit));
    const double truth = cslf::testing::Trace(scene, ray, {}, 1 << 14).Mean;
    std::cout << "beside a lamp: " << 0.6 * cache.Get(hit).x << " instead of " << truth << "\n";
    // The rim's own shade, closer to it than any point, is not resolved.
    CSLF_CHECK_NEAR(0.6 * cache.Get(hit).x, truth, beside < 0.21f ? 0.02 : 0.1 * truth);
  }
}

/// A pyramid that stands in a block, of whose triangles only one corner is outside, whichever it
/// is.
void TestTip(int turns)
{
  cslf::Mesh tip = MakeBox({ -1.0f, -1.0f, -1.0f }, { 1.0f, 1.0f, 0.0f }, false);
  const glm::vec3 corners[] = { { 0.0f, 0.0f, 0.3f }, { 0.3f, 0.0f, -0.6f },
    { -0.2f, 0.25f, -0.6f }, { -0.2f, -0.25f, -0.6f } };
  tip.Vertices.clear();
  tip.Triangles.clear();
  const int sides[][3] = { { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 1 }, { 1, 3, 2 } };
  for (const auto& side : sides)
  {
    const auto first = static_cast<std::uint32_t>(tip.Vertices.size());
    for (int i = 0; i < 3; ++i)
    {
      tip.Vertices.push_back(corners[side[(i + turns) % 3]]);
    }
    tip.Triangles.emplace_back(first, first + 1, first + 2);
  }
  const cslf::Scene scene({ MakeBox({ -1.0f, -1.0f, -1.0f }, { 1.0f, 1.0f, 0.0f }, false), tip },
    cslf::testing::MakeUniformLight(1.0f));
  cslf::CacheSettings settings;
  settings.Spacing = 1.0;
  settings.Samples = 512;
  cslf::RadianceCache cache(scene, settings);
  CSLF_CHECK(cache.Build([](double) { return true; }));
  for (const float angle : { 1.0f, 3.1f, 5.2f })
  {
    const cslf::Ray ray = cslf::testing::LookAt(
      { 2.0f * std::cos(angle), 2.0f * std::sin(angle), 0.5f }, { 0.0f, 0.0f, 0.15f });
    const cslf::Hit hit = scene.Intersect(ray);
    CSLF_CHECK(hit.IsValid() && hit.Mesh == 1 && cache.Covers(hit));
    CSLF_CHECK_NEAR(
      0.6 * cache.Get(hit).x, cslf::testing::Trace(scene, ray, {}, 1 << 12).Mean, 0.1);
  }
}
}

int TestCSLFRadianceCacheHidden(int, char*[])
{
  for (const int turns : { 0, 1, 2 })
  {
    TestTip(turns);
  }
  for (const bool hasNormals : { false, true })
  {
    const cslf::Mesh block = MakeBox({ -1.0f, -1.0f, -1.0f }, { 1.0f, 1.0f, 0.0f }, hasNormals);
    TestPost(block, 1.0f, 32, hasNormals);
    TestPost(block, 1.0f, 512, hasNormals);
    TestPost(block, 0.1f, 512, hasNormals);
    for (const float reflectance : { 0.6f, 0.0f })
    {
      TestPost(MakeBall({ 0.0f, 0.0f, -1.0f }, 1.0f, reflectance), 1.0f, 512, hasNormals);
    }
  }
  TestLamp(MakeBox({ -1.0f, -1.0f, -1.0f }, { 1.0f, 1.0f, 1.0f }, false));
  TestGap();
  TestLamp(MakeBall({ 0.0f, 0.0f, 0.0f }, 1.2f, 0.6f));
  return cslf::testing::Result();
}
