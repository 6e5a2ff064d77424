// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Small scenes for tests of light transport, and estimates of the light along one ray.
 */
#ifndef cslfTestTransport_h
#define cslfTestTransport_h

#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "cslfTesting.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslf
{
namespace testing
{
inline const glm::vec3 Dark(0.0f);
inline const glm::vec3 White(1.0f);

inline SurfaceMaterial MakeDiffuse(float reflectance, float emission = 0.0f)
{
  return { glm::vec3(reflectance), 0.0f, 1.0f, 1.0f, glm::vec3(emission) };
}

inline Mesh MakeRectangle(
  const glm::vec3& center, const glm::vec3& u, const glm::vec3& v, const SurfaceMaterial& material)
{
  Mesh mesh;
  mesh.Vertices = { center - u - v, center + u - v, center + u + v, center - u + v };
  mesh.Triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  mesh.Material = material;
  return mesh;
}

inline LightSet MakeUniformLight(float radiance)
{
  LightSet lights;
  lights.Surroundings = Environment(glm::vec3(radiance), glm::vec3(radiance), EnvironmentAxes());
  return lights;
}

struct Estimate
{
  double Mean = 0.0;
  double Error = 0.0; // standard error
};

/// The first component of the radiance against a direction.
inline Estimate Trace(const Scene& scene, const Ray& ray, const PathSettings& settings, int samples)
{
  const PathIntegrator integrator(scene, settings);
  const Hit hit = scene.Intersect(ray);
  CSLF_CHECK(hit.IsValid());
  Estimate estimate;
  constexpr int groups = 16; // independent sequences
  double squares = 0.0;
  std::uint64_t rays = 0;
  for (int group = 0; group < groups && hit.IsValid(); ++group)
  {
    const std::uint64_t hash = SampleStream::HashTexel(1, group, 0, 0);
    double mean = 0.0;
    for (int i = 0; i < samples / groups;)
    {
      PathBatch batch;
      for (; i < samples / groups && batch.GetSize() < PathBatch::Capacity; ++i)
      {
        batch.Add({ ray, hash, static_cast<std::uint32_t>(i) }, hit);
      }
      integrator.Follow(batch, rays);
      for (int path = 0; path < batch.GetSize(); ++path)
      {
        mean += batch.GetRadiance(path).x;
      }
    }
    mean /= samples / groups;
    estimate.Mean += mean / groups;
    squares += mean * mean / groups;
  }
  estimate.Error = std::sqrt(std::max(0.0, squares - estimate.Mean * estimate.Mean) / (groups - 1));
  return estimate;
}

/// The radiance of one path from a known first hit, followed alone. Adds the rays traced.
inline glm::vec3 FollowAlone(const PathIntegrator& integrator, const PathBatch::Start& start,
  const Hit& hit, std::uint64_t& rays)
{
  PathBatch batch;
  batch.Add(start, hit);
  integrator.Follow(batch, rays);
  return batch.GetRadiance(0);
}

inline Ray LookAt(const glm::vec3& from, const glm::vec3& at)
{
  return { from, glm::normalize(at - from) };
}

/// Checks that light sampling alone and BSDF sampling alone, the latter with its own number of
/// samples, agree with both together. Returns the estimates of both, and of BSDF sampling.
inline std::pair<Estimate, Estimate> CheckEstimators(
  const Scene& scene, const Ray& ray, PathSettings settings, int surfaceSamples)
{
  const Estimate both = Trace(scene, ray, settings, 1 << 15);
  settings.BSDFSampling = false;
  const Estimate light = Trace(scene, ray, settings, 1 << 16);
  settings.BSDFSampling = true;
  settings.LightSampling = false;
  const Estimate surface = Trace(scene, ray, settings, surfaceSamples);
  CSLF_CHECK_NEAR(light.Mean, both.Mean, 4.0 * (light.Error + both.Error));
  CSLF_CHECK_NEAR(surface.Mean, both.Mean, 4.0 * (surface.Error + both.Error));
  return { both, surface };
}
}
}

#endif
