// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light that points of a surface would diffuse, were they white: estimated to a stated noise.
 */
#ifndef cslfDiffuseEstimator_h
#define cslfDiffuseEstimator_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/cslfDisplayCurve.h"
#include "PathTracing/cslfPathIntegrator.h"
#include "cslfCacheShare.h"
#include "cslfDiffuseLookUp.h"
#include "cslfGatherDirections.h"
#include "cslfHalfSamples.h"
#include "cslfIncidentLight.h"
#include "cslfSurfaceEstimate.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT DiffuseEstimator : public SurfaceEstimator
{
public:
  /// What is estimated.
  enum class Light : std::uint32_t
  {
    Sampled, ///< light that is sampled at its sources
    Gathered ///< light that is found by looking around, in directions spread by the cosine
  };

  struct Settings
  {
    Light Kind = Light::Gathered;
    int FirstSamples = 64;  ///< taken at every point; a power of two, at least 32
    int LastSamples = 1024; ///< taken where the noise demands it
    float Noise = 0.004f;   ///< the standard error that is good enough, in the units of `Display`
    int Depth = 1;          ///< the reflections after which the point's light is seen, at least 1
    std::uint32_t Seed = 0;
    DisplayCurve Display;
    std::vector<GlossyLobe> Lobes; ///< of each mesh: what incident light is looked at for
    CacheShare* Share = nullptr;   ///< the ranks that estimate together; null for this one alone
  };

  DiffuseEstimator(const Scene& scene, const PathIntegrator& paths, Settings settings)
    : World(scene)
    , Paths(paths)
    , Limits(std::move(settings))
    , Known(scene, this->Limits.Depth < paths.GetMaximumDepth() ? paths.GetCache() : nullptr)
    , Directions(this->Limits.FirstSamples / 2)
  {
  }

  /// Each half of a point's samples is doubled until, as far as it and its neighbours tell, both
  /// together are good enough.
  std::vector<SurfaceEstimate> Estimate(const Request& request) override;

  std::uint64_t GetNumberOfRays() const { return this->Rays; }

private:
  struct Receiver;
  struct Batch;
  struct Progress;
  struct Work;
  using Means = std::vector<std::array<SampleMean, 2>>; // of the halves of all points

  /// Takes samples of all points that want more, up to number `end` of each half.
  void TakeSamples(const Request& request, int end, std::vector<Work>& works, Means& means);
  void TakeSamples(const SurfacePoint& point, int end, bool wantsIncident, Work& work,
    std::array<SampleMean, 2>& means);
  std::uint64_t SampleLights(const Batch& batch, Progress& progress) const;
  std::uint64_t LookAround(const Batch& batch, Progress& progress) const;
  glm::vec3 Follow(const RayPacket& packet, int lane, float pdf, const glm::vec3& normal,
    const SampleStream& stream, std::uint64_t& rays) const;
  /// Lets the halves decide after so many samples of each. Whether some want more.
  bool Decide(
    const Request& request, int samples, const Means& means, std::vector<Work>& works) const;
  bool IsEnough(const SurfacePoint& point, const HalfEstimate& pilot) const;

  const Scene& World;
  const PathIntegrator& Paths;
  Settings Limits;
  DiffuseLookUp Known; // what a ray sees after the reflections of the limits
  GatherDirections Directions;
  std::atomic<std::uint64_t> Rays{ 0 };
};
}

#endif
