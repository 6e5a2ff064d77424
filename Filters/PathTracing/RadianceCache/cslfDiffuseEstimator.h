// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Estimates the light that points of a surface would reflect diffusely if they were white, up to a
 * given noise.
 */
#ifndef cslfDiffuseEstimator_h
#define cslfDiffuseEstimator_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Paths/cslfPathBatch.h"
#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "Quality/cslfDisplayCurve.h"
#include "cslfCacheShare.h"
#include "cslfDiffuseLookUp.h"
#include "cslfGatherDirections.h"
#include "cslfIncidentLight.h"
#include "cslfSurfaceEstimate.h"

#include <vtkSMPThreadLocal.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT DiffuseEstimator : public SurfaceEstimator
{
public:
  /// The quantity to estimate.
  enum class Light : std::uint32_t
  {
    Sampled, ///< light that is sampled at its sources
    Gathered ///< light found by cosine-distributed directions
  };

  struct Settings
  {
    Light Kind = Light::Gathered;
    int FirstSamples = 64;  ///< taken at every point; a power of two, at least 32
    int LastSamples = 1024; ///< taken if the noise requires it
    float Noise = 0.004f;   ///< the acceptable standard error of the mean over an area, in the
                            ///< units of `Display`
    float NoiseArea = 0.0f; ///< that area, in scene space
    int Depth = 1; ///< the number of reflections after which the point's light is seen, at least 1
    std::uint32_t Seed = 0;
    DisplayCurve Display;
    std::vector<GlossyLobe> Lobes; ///< of each mesh: the use of incident light
    CacheShare* Share = nullptr;   ///< the ranks that estimate together; null for this one alone

    /// Whether what a ray hits is the inside of a closed body without light, as in
    /// OpenSides::IsInside. Points that mostly see such hits are hidden. May be empty.
    std::function<bool(const Ray&, const Hit&)> IsInside;

    /// The width of gaps in scene space, into which nobody sees: points that see opaque surfaces
    /// nearer than that along their normal, and in most directions, are hidden, too.
    float Gap = 0.0f;
  };

  /// The paths end at the light of the cache, if there is one.
  DiffuseEstimator(
    const Scene& scene, const PathIntegrator& paths, const RadianceCache* cache, Settings settings)
    : World(scene)
    , Paths(paths)
    , Limits(std::move(settings))
    , Known(scene, this->Limits.Depth < paths.GetMaximumDepth() ? cache : nullptr)
    , Directions(this->Limits.FirstSamples / 2)
    , Batches(PathBatch(this->Limits.Depth, true))
  {
  }

  /// Doubles each half of a point's samples until both together are good enough, judged by the
  /// point and its neighbours.
  std::vector<SurfaceEstimate> Estimate(const Request& request) override;

  std::uint64_t GetNumberOfRays() const { return this->Rays; }

private:
  struct Receiver;
  struct Range;
  struct Progress;
  class Gathering;
  struct Work;

  /// What all ranks know of a point while its samples are taken.
  struct PointMeans
  {
    SampleMean Halves[2];
    bool IsHidden = false;
  };
  using Means = std::vector<PointMeans>;

  /// Takes samples of all points that need more, up to number `end` of each half. `goOn` gets the
  /// progress, in [0,1]. Returns false if it did.
  bool TakeSamples(const Request& request, int end, const std::function<bool(double)>& goOn,
    std::vector<Work>& works, Means& means);
  void TakeSamples(
    const SurfacePoint& point, int end, bool wantsIncident, Work& work, PointMeans& means);
  bool FindHidden(const Receiver& receiver, std::uint64_t hash, SurfaceEstimate& estimate);
  std::uint64_t SampleLights(const Range& range, Progress& progress) const;
  std::uint64_t LookAround(const Range& range, Progress& progress);
  /// Lets the halves decide after that many samples of each. Returns whether some need more.
  bool Decide(
    const Request& request, int samples, const Means& means, std::vector<Work>& works) const;
  bool IsEnough(const SurfacePoint& point, const HalfEstimate& pilot) const;

  const Scene& World;
  const PathIntegrator& Paths;
  Settings Limits;
  DiffuseLookUp Known; // what a ray sees after the reflections of the limits
  GatherDirections Directions;
  vtkSMPThreadLocal<PathBatch> Batches; // the paths of gathered light that is not known
  std::atomic<std::uint64_t> Rays{ 0 };
};
}

#endif
