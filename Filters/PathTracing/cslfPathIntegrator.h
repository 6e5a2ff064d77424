// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Path tracing with next-event estimation and multiple importance sampling: the unbiased estimate
 * of the radiance along a ray.
 */
#ifndef cslfPathIntegrator_h
#define cslfPathIntegrator_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfSampleStream.h"
#include "cslfScene.h"

namespace cslf
{
class BSDF;
struct Frame;

struct PathSettings
{
  /// The reflections of the longest path: 0 sees emission only, 1 adds direct light.
  int MaximumDepth = 8;

  /// Which of the two estimators of light from extended lights are used. Either alone converges to
  /// the same picture, a mirror's reflections and what no light sampling knows apart.
  bool LightSampling = true;
  bool BSDFSampling = true;
};

class VTKCSLF_EXPORT PathIntegrator
{
public:
  PathIntegrator(const Scene& scene, const PathSettings& settings)
    : World(scene)
    , Settings(settings)
  {
  }

  /// The radiance that comes from a ray's first hit, which must be valid.
  glm::vec3 GetRadiance(Ray ray, Hit hit, SampleStream stream) const;

private:
  struct Vertex;

  glm::vec3 EnvironmentLight(const glm::vec3& direction, float pdf) const;
  glm::vec3 EmittedLight(
    const Ray& ray, const Hit& hit, const SurfaceHit& surface, float pdf) const;
  glm::vec3 DirectLight(const Vertex& vertex, const SampleStream& stream) const;
  glm::vec3 Arrive(const Vertex& vertex, const LightSample& light) const;

  const Scene& World;
  PathSettings Settings;
};
}

#endif
