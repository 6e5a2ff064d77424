// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Path tracing with next-event estimation and multiple importance sampling: the estimate of the
 * radiance along a ray. It is unbiased unless stored light replaces diffuse light and rough
 * reflections.
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
/// Light that was computed before, at which paths end, such as that of a RadianceCache. It is
/// diffusely reflected light, that of a white surface, unless a method says otherwise.
class VTKCSLF_EXPORT StoredLight
{
public:
  virtual ~StoredLight();

  /// Whether it is all light, or only light sampled at its sources.
  virtual bool IsComplete() const = 0;

  /// Whether the light of a surface is stored. For spheres, tubes and instances, see HasShape.
  virtual bool Covers(const Hit& hit) const = 0;

  /// The radiance of a covered surface point.
  virtual glm::vec3 Get(const Hit& hit) const = 0;

  /// Whether light is stored for a mesh of spheres, tubes or instances.
  virtual bool HasShape(std::uint32_t mesh) const = 0;

  /// The radiance of a point of such a shape. False if it is unknown.
  virtual bool GetShape(const Hit& hit, const SurfaceHit& surface, glm::vec3& light) const = 0;

  /// The radiance, with the surface's colour, along a ray from its hit on such a shape. False if
  /// its light is unknown, or is not all that determines the radiance.
  virtual bool LookUpShape(const Ray& ray, const Hit& hit, glm::vec3& radiance) const = 0;

  /// The radiance, with the surface's colour and reflections, along a ray from its hit on a covered
  /// rough surface. False if its displayed error may exceed this many tolerances.
  virtual bool LookUpRough(
    const Ray& ray, const Hit& hit, float tolerances, glm::vec3& radiance) const = 0;
};

struct PathSettings
{
  /// The largest number of reflections of a path: 0 gives emission only, 1 adds direct light.
  int MaximumDepth = 8;

  /// Which of the two estimators of light from extended lights are used. Either alone converges to
  /// the same picture, except for reflections in mirrors and light that light sampling cannot find.
  bool LightSampling = true;
  bool BSDFSampling = true;

  /// Whether rays to the eye that meet no surface see the environment behind volumes. Without
  /// volumes, such rays are not followed.
  bool ShowsEnvironment = false;
};

class VTKCSLF_EXPORT PathIntegrator
{
public:
  /// With stored light, which may be null or unfinished, paths end where it is all the rest.
  PathIntegrator(
    const Scene& scene, const PathSettings& settings, const StoredLight* stored = nullptr);

  /// Follows all paths of a batch to their ends. Adds the rays traced.
  void Follow(PathBatch& batch, std::uint64_t& rays) const;

  /// Whether stored light alone determines the light that leaves a hit in any direction.
  bool CanLookUp(const Hit& hit) const;

  /// That radiance.
  glm::vec3 LookUp(const Hit& hit) const;

  /// The radiance along a given ray from its first hit, which must be valid, if stored light
  /// alone determines it: for diffuse surfaces, and for rough ones whose lobes see nothing sharp,
  /// up to this many of its tolerances.
  bool LookUp(const Ray& ray, const Hit& hit, glm::vec3& radiance, float tolerances = 1.0f) const;

  const DirectLight& GetLight() const { return this->Light; }
  int GetMaximumDepth() const { return this->Settings.MaximumDepth; }

private:
  friend class PathStep;

  const Scene& World;
  PathSettings Settings;
  DirectLight Light;
  const StoredLight* Stored;
  std::vector<char> LookUps; // whether it covers a mesh completely; empty if it is not complete
};
}

#endif
