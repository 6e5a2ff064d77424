// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRadianceCache.h"

#include "cslfColor.h"
#include "cslfDiffuseEstimator.h"
#include "cslfLatticeBuilder.h"

#include <algorithm>
#include <utility>

namespace cslf
{
namespace
{
// Light from sources has the sharpest edges: every quarter of a brick is looked at.
constexpr int FirstLightLevel = 2;

// The paths of a point whose light is only seen by other points, hundreds of them at once.
constexpr int RoughSamples = 64;

// The fewest paths of a point that is seen itself.
constexpr int FirstLightSamples = 64;
constexpr int FirstGatherSamples = 256;

// The parts of the work, for the progress.
constexpr double LightShare = 0.2;
constexpr double RoughShare = 0.1;

/// The values of two lattices of the same bricks, added.
std::vector<glm::vec3> AddBricks(
  const SurfaceLattice& a, const SurfaceLattice& b, std::size_t index, std::uint32_t& level)
{
  const SurfaceLattice::Brick& brickA = a.GetBrick(index);
  const SurfaceLattice::Brick& brickB = b.GetBrick(index);
  const bool isConstantA = brickA.Level == SurfaceLattice::Constant;
  const bool isConstantB = brickB.Level == SurfaceLattice::Constant;
  level = isConstantA ? brickB.Level
    : isConstantB     ? brickA.Level
                      : std::max(brickA.Level, brickB.Level);
  if (level == SurfaceLattice::Constant)
  {
    return { a.GetInBrick(brickA, 0.0f, 0.0f) + b.GetInBrick(brickB, 0.0f, 0.0f) };
  }
  const int splits = 1 << level;
  std::vector<glm::vec3> values;
  for (int j = 0; j <= splits; ++j)
  {
    for (int i = 0; i <= splits - j; ++i)
    {
      const float u = static_cast<float>(i) / static_cast<float>(splits);
      const float v = static_cast<float>(j) / static_cast<float>(splits);
      values.push_back(a.GetInBrick(brickA, u, v) + b.GetInBrick(brickB, u, v));
    }
  }
  return values;
}

SurfaceLattice AddLattices(const SurfaceLattice& a, const SurfaceLattice& b)
{
  SurfaceLattice sum = a.MakeEmpty();
  for (std::size_t index = 0; index < sum.GetNumberOfBricks(); ++index)
  {
    std::uint32_t level = 0;
    const std::vector<glm::vec3> values = AddBricks(a, b, index, level);
    sum.SetBrick(index, level, values);
  }
  return sum;
}

/// Tells a part of the progress.
std::function<bool(double)> Within(
  const std::function<bool(double)>& goOn, double start, double end)
{
  return [goOn, start, end](double part) { return goOn(start + (end - start) * part); };
}
}

RadianceCache::RadianceCache(const Scene& scene, const CacheSettings& settings)
  : World(scene)
  , Settings(settings)
  , Paths(scene, settings.Paths, this)
{
}

bool RadianceCache::Build(const Progress& goOn)
{
  // Light that is sampled at its sources has sharp shadows, which need many points of few samples.
  if (!this->SampleLights(Within(goOn, 0.0, LightShare)))
  {
    return false;
  }
  // All other light, roughly, by whole paths.
  LatticeSettings lattice = this->GetLatticeSettings();
  lattice.LastLevel = 0;
  SurfaceLattice rough;
  if (!this->Gather(lattice, RoughSamples, RoughSamples, rough,
        Within(goOn, LightShare, LightShare + RoughShare)))
  {
    return false;
  }
  this->Second = std::move(rough);
  this->HasSecond = true;
  this->Complete = true;
  // And finely, by paths that end at what they see first.
  SurfaceLattice fine;
  if (!this->Gather(this->GetLatticeSettings(), FirstGatherSamples, this->Settings.Samples, fine,
        Within(goOn, LightShare + RoughShare, 1.0)))
  {
    return false;
  }
  this->Values = AddLattices(this->Values, fine);
  this->Second = SurfaceLattice();
  this->HasSecond = false;
  return true;
}

LatticeSettings RadianceCache::GetLatticeSettings() const
{
  LatticeSettings lattice;
  lattice.Spacing = static_cast<float>(this->Settings.Spacing);
  lattice.Tolerance = static_cast<float>(this->Settings.Tolerance);
  lattice.Display = [exposure = this->Settings.Exposure](
                      const glm::vec3& value, const glm::vec3& baseColor)
  { return glm::vec3(LinearToSRGB(exposure * glm::dvec3(value * baseColor))); };
  return lattice;
}

bool RadianceCache::SampleLights(const Progress& goOn)
{
  LatticeSettings lattice = this->GetLatticeSettings();
  lattice.FirstLevel = FirstLightLevel;
  DiffuseEstimator estimator(this->World, this->Paths,
    { FirstLightSamples, std::max(this->Settings.Samples, FirstLightSamples), lattice.Tolerance,
      this->Settings.Seed, lattice.Display });
  LatticeBuilder builder(this->World, lattice,
    [&](const Hit& place, std::uint64_t key) { return estimator.SampleLights(place, key); });
  const bool isLit = this->Settings.Paths.MaximumDepth > 0 && this->Paths.GetLight().CanSample();
  const bool done = !isLit || builder.Build(goOn);
  this->Values = std::move(builder.GetLattice());
  this->Estimates += builder.GetNumberOfEstimates();
  this->Rays += estimator.GetNumberOfRays();
  return done;
}

bool RadianceCache::Gather(const LatticeSettings& lattice, int firstSamples, int lastSamples,
  SurfaceLattice& values, const Progress& goOn)
{
  DiffuseEstimator estimator(this->World, this->Paths,
    { firstSamples, std::max(firstSamples, lastSamples), lattice.Tolerance, this->Settings.Seed,
      lattice.Display });
  LatticeBuilder builder(this->World, lattice,
    [&](const Hit& place, std::uint64_t key) { return estimator.Gather(place, key); });
  const bool isLit = this->Settings.Paths.MaximumDepth > 0;
  const bool done = !isLit || builder.Build(goOn);
  values = std::move(builder.GetLattice());
  this->Estimates += builder.GetNumberOfEstimates();
  this->Rays += estimator.GetNumberOfRays();
  return done;
}
}
