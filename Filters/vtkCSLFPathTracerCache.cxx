// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The radiance cache of vtkCSLFPathTracer: when it is made, and how accurate it is.
#include "vtkCSLFPathTracer.h"

#include "Options/cslfOption.h"
#include "Options/cslfOptionTable.h"
#include "PathTracing/RadianceCache/cslfCacheKeeper.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfRequests.h"
#include "cslfJSON.h"
#include "cslfSeconds.h"
#include "vtkCSLFPathTracerInternals.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>

namespace options = cslf::options;

namespace
{
///@{
/// The progress of rendering when the cache is filled, and when it is checked. What takes longest
/// depends on the scene.
constexpr double CacheProgress = 0.45;
constexpr double CheckProgress = 0.5;
///@}

/// A scene whose mapped surfaces are grey while this object exists.
class NeutralScene
{
public:
  NeutralScene(cslf::Scene& scene, bool isNeutral)
    : World(scene)
  {
    this->World.SetNeutral(isNeutral);
  }
  ~NeutralScene() { this->World.SetNeutral(false); }
  NeutralScene(const NeutralScene&) = delete;
  NeutralScene& operator=(const NeutralScene&) = delete;

private:
  cslf::Scene& World;
};
}

double vtkCSLFPathTracer::GetAutomaticCacheSpacing(int size, int quality)
{
  const int known = options::Quality.Clamp(quality);
  return cslf::QualityPresets[known].CacheSpacing * 0.3 / std::max(size, 1);
}

void vtkCSLFPathTracer::SetCacheProbeSeconds(double seconds)
{
  seconds =
    cslf::Clamp(this, "CacheProbeSeconds", seconds, 0.0, VTK_DOUBLE_MAX, this->CacheProbeSeconds);
  if (this->CacheProbeSeconds != seconds)
  {
    this->CacheProbeSeconds = seconds;
    this->Internals->IsProbe = false;
    this->Modified();
  }
}

std::string vtkCSLFPathTracer::MakeCacheKey(double spacing, double displayRange)
{
  // Excludes parameters of the texels that do not affect the cache.
  nlohmann::json key = nlohmann::json::parse(this->DescribeSampling());
  for (const char* name : { options::Quality.Key, options::Samples.Key, options::NoiseTarget.Key,
         options::ShowEnvironment.Key })
  {
    key.erase(name);
  }
  key["cache"].erase("check");
  key["cache"].erase("used_spacing");
  key["cache"][options::CacheSpacing.Key] = spacing;
  key["cache"]["display_range"] = displayRange;
  key["cslf"] = CSLF_VERSION;
  return key.dump();
}

void vtkCSLFPathTracer::MakeCache(double spacing, double displayRange, cslf::CacheShare* ranks)
{
  cslf::CacheSettings settings;
  settings.Tolerance = this->GetUsedCacheTolerance();
  settings.Spacing = 2.0 * spacing; // the bounding sphere's radius is 1
  settings.Samples = this->GetUsedCacheSamples();
  settings.Exposure = this->Exposure;
  settings.DisplayRange = displayRange;
  settings.Seed = static_cast<std::uint32_t>(this->Seed);
  settings.Paths.MaximumDepth = this->MaximumDepth;
  settings.ProbeSeconds = this->CacheProbeSeconds;
  settings.Share = ranks;
  this->Internals->CacheKey.clear();
  this->Internals->Cache =
    std::make_unique<cslf::RadianceCache>(*this->Internals->Scene.World, settings);
}

bool vtkCSLFPathTracer::ProbeCache(double spacing, double displayRange)
{
  const std::string key = this->MakeCacheKey(spacing, displayRange);
  this->ExpectedCacheSeconds = 0.0;
  if (this->Internals->CacheKey == key)
  {
    return true;
  }
  // A probe is valid for any spacing: it is so coarse that the spacing matters little.
  if (!this->Internals->IsProbe)
  {
    const auto start = std::chrono::steady_clock::now();
    this->MakeCache(spacing, displayRange, nullptr);
    this->Internals->IsProbe = this->FillCache();
    this->CacheSeconds += cslf::SecondsSince(start);
  }
  this->ExpectedCacheSeconds = this->Internals->Cache->GetExpectedSeconds();
  return this->Internals->IsProbe;
}

bool vtkCSLFPathTracer::UpdateCache(
  double spacing, double displayRange, const cslf::CheckedPicture* checked)
{
  if (this->CacheProbeSeconds > 0.0)
  {
    return this->ProbeCache(spacing, displayRange);
  }
  using Plan = cslf::CacheKeeper::Plan;
  const std::string key = this->MakeCacheKey(spacing, displayRange);
  const bool isThere = this->Internals->CacheKey == key;
  cslf::CacheKeeper* keeper = cslf::BorrowCacheKeeper(this->GetOutputInformation(0));
  // Ranks make and check a cache together only if they check it at the same texels.
  std::string shared = key;
  if (checked)
  {
    for (const int number :
      { checked->TileWidth, checked->TileHeight, checked->Tiles, checked->Slices })
    {
      shared += " " + std::to_string(number);
    }
  }
  const Plan plan = keeper ? keeper->Join(key, shared, isThere) : Plan::Alone;
  if (plan == Plan::Break || (plan == Plan::Alone && isThere))
  {
    return plan != Plan::Break;
  }
  const auto start = std::chrono::steady_clock::now();
  if (!isThere || (plan == Plan::Together && !keeper->IsEverywhere()))
  {
    this->MakeCache(spacing, displayRange, plan == Plan::Together ? keeper->GetShare() : nullptr);
    this->Internals->IsProbe = false;
  }
  cslf::CacheShare* ranks = plan == Plan::Together ? keeper->GetShare() : nullptr;
  const auto fill = [this, ranks, checked]
  { return this->FillCache() && (!checked || this->MeasureCache(*checked, ranks)); };
  const bool done = plan == Plan::Together ? keeper->Make(*this->Internals->Cache, fill) : fill();
  this->NumberOfCachePoints = this->Internals->Cache->GetNumberOfValues();
  this->CacheSeconds += cslf::SecondsSince(start);
  if (done)
  {
    this->Internals->CacheKey = key;
    this->Internals->IsToldOf = ranks && ranks->GetRank() > 0;
  }
  return done;
}

bool vtkCSLFPathTracer::MeasureCache(const cslf::CheckedPicture& picture, cslf::CacheShare* ranks)
{
  cslf::Phase phase(this, "Checking the radiance cache", CheckProgress);
  // If there are few texels, a few are enough: the check should not take longer than the rest.
  // Like the cache, which may be kept when they change, the check does not depend on the samples.
  constexpr std::int64_t most = 1024;
  constexpr std::int64_t least = 16;
  constexpr std::int64_t part = 16;
  const std::int64_t texels =
    std::int64_t(picture.TileWidth) * picture.TileHeight * picture.Tiles * picture.Slices;
  cslf::CheckSettings settings;
  settings.Texels = static_cast<int>(std::clamp(texels / part, least, most));
  settings.Exposure = this->Exposure;
  settings.Seed = static_cast<std::uint32_t>(this->Seed);
  settings.Paths.MaximumDepth = this->MaximumDepth;
  settings.Share = ranks;
  cslf::RadianceCache& cache = *this->Internals->Cache;
  const auto report = [&phase](double share) { return phase.Report(share); };
  const NeutralScene neutral(*this->Internals->Scene.World, this->Interreflection == Neutral);
  const cslf::CacheCheck check =
    cslf::CheckCache(*this->Internals->Scene.World, cache, picture, settings, report);
  if (check.IsMade())
  {
    cache.SetCheck(check);
  }
  return check.IsMade();
}

void vtkCSLFPathTracer::ReportCache()
{
  const cslf::RadianceCache& cache = *this->Internals->Cache;
  const cslf::CacheCheck& check = cache.GetCheck();
  this->CheckedTexels = std::max(check.Texels, 0);
  this->CacheMeanDifference = check.Mean;
  this->CacheMeanDifferenceError = check.MeanError;
  this->CacheRMSDifference = check.RMS;
  this->CacheRMSDifferenceError = check.RMSError;
  this->UsedCacheSpacing = 0.5 * cache.GetSpacing();
  if (this->Internals->IsToldOf)
  {
    return;
  }
  this->Internals->IsToldOf = true;
  if (cache.IsCoarsened())
  {
    vtkWarningMacro(
      "The radiance cache would need too many points, so their spacing was increased to "
      << this->UsedCacheSpacing
      << " of the scene's diagonal. Use path tracing if shadow edges must be sharper.");
  }
  const double tolerance = this->GetUsedCacheTolerance();
  if (check.IsExceeded(tolerance))
  {
    vtkWarningMacro("The radiance cache differs from path tracing by more than its bounds: at "
      << check.Texels << " texels, its mean radiance differs by " << 100.0 * check.Mean << " % (+- "
      << 100.0 * check.MeanError << " %; bound 2 %), and its displayed colours by " << check.RMS
      << " of white in the root mean square (+- " << check.RMSError << "; bound "
      << cslf::CacheCheck::GetRMSBound(tolerance)
      << "). Use a smaller tolerance or spacing or more samples of the cache (CacheOptions, in the "
         "tool --cache-tolerance and its kin), or path tracing.");
  }
}

bool vtkCSLFPathTracer::FillCache()
{
  cslf::Phase phase(this, "Filling the radiance cache", CacheProgress);
  cslf::RadianceCache& cache = *this->Internals->Cache;
  const NeutralScene neutral(*this->Internals->Scene.World, this->Interreflection == Neutral);
  const bool done = cache.Build([&phase](double share) { return phase.Report(share); });
  this->NumberOfCacheRays += cache.GetNumberOfRays();
  return done;
}
