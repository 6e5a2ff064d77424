// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The distance at which rays leave surfaces: small enough that they hit a sheet close above, and
// large enough that a surface does not shadow itself.
#include "PathTracing/Materials/cslfLobe.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfTestTransport.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <iostream>
#include <random>
#include <utility>
#include <vector>

namespace
{
using namespace cslf::testing;

/// Light passes each of two sheets that are a millionth of the scene apart, at all positions and
/// orientations.
void TestSheets()
{
  const float gap = 2e-6f; // the scene's diameter is 2
  for (const glm::vec3& center :
    { glm::vec3(0.0f), glm::vec3(0, 0, 0.3f), glm::vec3(-0.2f, 0.1f, -0.5f) })
  {
    for (const glm::vec3& tilt : { glm::vec3(0, 0, 1), glm::vec3(0.3f, -0.2f, 1.0f) })
    {
      const cslf::Frame frame(glm::normalize(tilt));
      cslf::SurfaceMaterial upper = MakeDiffuse(0.0f);
      upper.Opacity = 0.5f;
      std::vector<cslf::Mesh> meshes;
      meshes.push_back(MakeRectangle(center, 0.5f * frame.X, 0.5f * frame.Y, MakeDiffuse(0.8f)));
      meshes.push_back(
        MakeRectangle(center + gap * frame.Z, 0.5f * frame.X, 0.5f * frame.Y, upper));
      cslf::LightSet lights;
      lights.Directional.push_back({ -frame.Z, glm::vec3(cslf::Pi) });
      const cslf::Scene scene(std::move(meshes), lights);
      cslf::PathSettings settings;
      settings.MaximumDepth = 1;
      const cslf::PathIntegrator integrator(scene, settings);
      // The probability of passing the upper sheet depends on the ray, so many rays are needed.
      cslf::PathBatch batch;
      std::uint64_t rays = 0;
      for (int i = 0; i < cslf::PathBatch::Capacity; ++i)
      {
        const float x = 0.4f * (static_cast<float>(i % 64) / 32.0f - 1.0f);
        const float y = 0.4f * (static_cast<float>(i / 64) / 32.0f - 1.0f);
        cslf::PathBatch::Start start;
        start.First =
          LookAt(center + 0.9f * frame.Z + 0.1f * frame.X, center + x * frame.X + y * frame.Y);
        start.Hash = cslf::SampleStream::HashTexel(1, 0, i, 0);
        batch.Add(start);
      }
      integrator.Follow(batch, rays);
      double mean = 0.0;
      for (int i = 0; i < batch.GetSize(); ++i)
      {
        mean += batch.GetRadiance(i).x / batch.GetSize();
      }
      CSLF_CHECK_NEAR(mean, 0.8 * 0.25, 0.01);
    }
  }
}

/// Triangles of all sizes and shapes, seen from near and from afar.
class Furnace
{
public:
  /// Adds what paths find that end at a triangle in a uniform sky. `reach` is how far from the
  /// scene's center it may be, and `distance` how far away the eyes are.
  void Look(float size, float thickness, bool isInstance, float reach, float distance)
  {
    // In a scene of this size, so that the rounding of Embree's triangle is that of large
    // coordinates.
    cslf::Mesh mesh;
    const glm::vec3 place = this->GetVector() * reach;
    const glm::vec3 along = glm::normalize(this->GetVector()) * size;
    const glm::vec3 across =
      thickness * size * glm::normalize(glm::cross(along, this->GetVector()));
    const glm::vec3 local = isInstance ? glm::vec3(0.0f) : place;
    const float middle = this->Get(-0.5f, 1.5f);
    mesh.Vertices = { local, local + along, local + middle * along + across };
    mesh.Triangles = { { 0, 1, 2 } };
    mesh.Material = MakeDiffuse(1.0f);
    if (isInstance)
    {
      cslf::MeshInstance instance;
      instance.Offset = place;
      mesh.Instances = { instance };
    }
    const cslf::Scene scene({ mesh }, MakeUniformLight(1.0f));
    cslf::PathSettings settings;
    settings.MaximumDepth = 1;
    const cslf::PathIntegrator integrator(scene, settings);
    const glm::vec3 target = place + 0.3f * along + 0.3f * middle * along + 0.3f * across;
    cslf::PathBatch batch;
    for (int i = 0; i < 512; ++i)
    {
      cslf::PathBatch::Start start;
      start.First = LookAt(distance * glm::normalize(this->GetVector()), target);
      start.Hash = cslf::SampleStream::HashTexel(1, 0, i, 0);
      const cslf::Hit hit = scene.Intersect(start.First);
      if (hit.IsValid())
      {
        batch.Add(start, hit);
      }
    }
    std::uint64_t rays = 0;
    integrator.Follow(batch, rays);
    for (int path = 0; path < batch.GetSize(); ++path)
    {
      this->Shadowed += batch.GetRadiance(path).x > 0.5f ? 0 : 1;
      ++this->Tested;
    }
  }

  int Tested = 0;
  int Shadowed = 0;

private:
  float Get(float lower, float upper)
  {
    return lower + (upper - lower) * static_cast<float>(this->Engine() >> 8) * 0x1p-24f;
  }
  glm::vec3 GetVector() { return { this->Get(-1, 1), this->Get(-1, 1), this->Get(-1, 1) }; }

  std::mt19937 Engine{ 7 };
};

/// Triangles in a uniform sky look like the sky: no ray that leaves a triangle hits it again.
void TestFurnace()
{
  for (const auto& [reach, distance] : { std::pair(0.5f, 1.0f), std::pair(0.0f, 3.0f) })
  {
    Furnace furnace;
    for (const bool isInstance : { false, true })
    {
      for (const float size : { 1e-4f, 1e-2f, 0.3f, 1.0f })
      {
        for (const float thickness : { 3e-3f, 1e-2f, 1.0f })
        {
          for (int i = 0; i < 10; ++i)
          {
            furnace.Look(size, thickness, isInstance, reach, distance);
          }
        }
      }
    }
    CSLF_CHECK(furnace.Tested > 50000);
    CSLF_CHECK(furnace.Shadowed <= furnace.Tested / 50000);
    std::cout << furnace.Shadowed << " of " << furnace.Tested << " shadowed\n";
  }
}
}

int TestCSLFSelfIntersection(int, char*[])
{
  TestSheets();
  TestFurnace();
  return cslf::testing::Result();
}
