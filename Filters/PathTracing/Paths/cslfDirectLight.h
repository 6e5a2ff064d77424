// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Direct light at a surface point, estimated in two ways: by samples of its sources and by
 * directions that the BSDF samples (multiple importance sampling, Veach and Guibas, SIGGRAPH 1995).
 */
#ifndef cslfDirectLight_h
#define cslfDirectLight_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Scene/cslfScene.h"

namespace cslf
{
struct LightLanes;
struct ScatterLanes;
struct StreamLanes;
struct Vec3Lanes;

class VTKCSLF_EXPORT DirectLight
{
public:
  /// Either estimator alone gives the same light, except for reflections in mirrors and light that
  /// light sampling cannot find.
  DirectLight(const Scene& scene, bool lightSampling, bool bsdfSampling)
    : World(scene)
    , LightSampling(lightSampling)
    , BSDFSampling(bsdfSampling)
  {
  }

  /// The light of a ray that leaves the scene, if its direction was sampled with density `pdf`,
  /// which is infinite for a given ray.
  glm::vec3 GetEnvironment(const glm::vec3& direction, float pdf) const;

  /// The emission at a ray's first hit. The normal is that of the LightReceiver where the ray
  /// starts. It is ignored if the density is infinite.
  glm::vec3 GetEmission(const Ray& ray, const glm::vec3& normal, const Hit& hit,
    const SurfaceHit& surface, float pdf) const;

  /// Adds the light of sampled sources that the points reflect to the radiance, with the random
  /// numbers of one vertex of their paths. Returns the number of rays traced.
  std::uint64_t Sample(const ScatterLanes& points, const StreamLanes& streams, std::uint32_t vertex,
    Vec3Lanes& radiance) const;

  /// Whether Sample can return light.
  bool CanSample() const;

private:
  /// Whether to sample one of the lights at a finite distance, and its sample.
  bool CanSampleOne() const;
  LightSample SampleOne(const LightReceiver& receiver, const glm::vec2& u) const;

  std::uint64_t Arrive(
    const ScatterLanes& points, const LightLanes& light, Vec3Lanes& radiance) const;

  const Scene& World;
  bool LightSampling;
  bool BSDFSampling;
};
}

#endif
