// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light that one point of a surface would diffuse, were it white: estimated to a stated noise.
 */
#ifndef cslfDiffuseEstimator_h
#define cslfDiffuseEstimator_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/cslfDisplayCurve.h"
#include "PathTracing/cslfPathIntegrator.h"
#include "cslfDiffuseLookUp.h"
#include "cslfGatherDirections.h"
#include "cslfIncidentLight.h"
#include "cslfLatticeBuilder.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT DiffuseEstimator
{
public:
  struct Settings
  {
    int FirstSamples = 64;  ///< taken at every point; a power of two, at least 64
    int LastSamples = 1024; ///< taken where the noise demands it
    float Noise = 0.004f;   ///< the standard error that is good enough, in the units of `Display`
    int Depth = 1;          ///< the reflections after which the point's light is seen, at least 1
    std::uint32_t Seed = 0;
    DisplayCurve Display;
    std::vector<GlossyLobe> Lobes; ///< of each mesh: what incident light is looked at for
  };

  DiffuseEstimator(const Scene& scene, const PathIntegrator& paths, Settings settings)
    : World(scene)
    , Paths(paths)
    , Limits(std::move(settings))
    , Known(scene, this->Limits.Depth < paths.GetMaximumDepth() ? paths.GetCache() : nullptr)
    , Directions(this->Limits.FirstSamples)
  {
  }

  /// The light that is sampled at its sources.
  SurfaceEstimate SampleLights(const Hit& place, std::uint64_t key);

  /// The light that is found by looking around, in directions spread by the cosine.
  SurfaceEstimate Gather(const Hit& place, std::uint64_t key);

  std::uint64_t GetNumberOfRays() const { return this->Rays; }

private:
  struct Receiver;
  struct Samples;

  /// Takes samples, by `add(receiver, hash, begin, end, samples)`, until they suffice.
  template <typename Add>
  SurfaceEstimate Average(const Hit& place, std::uint64_t key, Add add);
  void LookAround(
    const Receiver& receiver, std::uint64_t hash, int begin, int end, Samples& samples) const;
  glm::vec3 Follow(const RayPacket& packet, int lane, float pdf, const glm::vec3& normal,
    const SampleStream& stream, std::uint64_t& rays) const;

  const Scene& World;
  const PathIntegrator& Paths;
  Settings Limits;
  DiffuseLookUp Known; // what a ray sees after the reflections of the limits
  GatherDirections Directions;
  std::atomic<std::uint64_t> Rays{ 0 };
};
}

#endif
