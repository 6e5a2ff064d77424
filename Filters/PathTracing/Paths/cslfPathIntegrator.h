// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Path tracing with next-event estimation and multiple importance sampling: the estimate of the
 * radiance along a ray. It is unbiased unless a cache replaces diffuse light and rough reflections.
 */
#ifndef cslfPathIntegrator_h
#define cslfPathIntegrator_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfDirectLight.h"
#include "cslfPathBatch.h"

#include <cstdint>
#include <vector>

namespace cslf
{
class RadianceCache;

struct PathSettings
{
  /// The largest number of reflections of a path: 0 gives emission only, 1 adds direct light.
  int MaximumDepth = 8;

  /// Which of the two estimators of light from extended lights are used. Either alone converges to
  /// the same picture, except for reflections in mirrors and light that light sampling cannot find.
  bool LightSampling = true;
  bool BSDFSampling = true;
};

class VTKCSLF_EXPORT PathIntegrator
{
public:
  /// With a cache, which may be null or unfinished, paths end where the cache knows the rest.
  PathIntegrator(
    const Scene& scene, const PathSettings& settings, const RadianceCache* cache = nullptr);

  /// Follows all paths of a batch to their ends. Adds the rays traced.
  void Follow(PathBatch& batch, std::uint64_t& rays) const;

  /// Whether the cache alone determines the light that leaves a hit in any direction.
  bool CanLookUp(const Hit& hit) const;

  /// That radiance.
  glm::vec3 LookUp(const Hit& hit) const;

  /// The radiance along a given ray from its first hit, which must be valid, if the cache alone
  /// determines it: for diffuse surfaces, and for rough ones whose lobes see nothing sharp, up to
  /// this many of the cache's tolerances.
  bool LookUp(const Ray& ray, const Hit& hit, glm::vec3& radiance, float tolerances = 1.0f) const;

  const DirectLight& GetLight() const { return this->Light; }
  const RadianceCache* GetCache() const { return this->Cache; }
  int GetMaximumDepth() const { return this->Settings.MaximumDepth; }

private:
  friend class PathStep;

  bool LookUpRough(const Ray& ray, const Hit& hit, float tolerances, glm::vec3& radiance) const;

  const Scene& World;
  PathSettings Settings;
  DirectLight Light;
  const RadianceCache* Cache;
  std::vector<char>
    LookUps; // whether the cache covers a mesh completely; empty if the cache is not complete
};
}

#endif
