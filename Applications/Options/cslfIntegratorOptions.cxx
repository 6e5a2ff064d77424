// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfIntegratorOptions.h"

#include "vtkCSLFPathTracer.h"

#include <CLI/CLI.hpp>

namespace cslf
{
namespace tool
{
namespace
{
constexpr const char* PathTracing = "path";
constexpr const char* RadianceCaching = "cache";
}

void IntegratorOptions::AddTo(CLI::App& command)
{
  const std::string group = "Light transport";
  command
    .add_option("--integrator", this->Integrator,
      "path: path tracing, the reference; cache: radiance caching, which computes the light of "
      "diffuse surfaces once")
    ->check(CLI::IsMember({ PathTracing, RadianceCaching }))
    ->capture_default_str()
    ->group(group);
  command.add_option("--spp", this->Samples, "samples per texel or pixel")
    ->check(CLI::Range(1, 1 << 20))
    ->capture_default_str()
    ->group(group);
  command
    .add_option("--noise", this->NoiseTarget,
      "take fewer samples where the standard error is at most this fraction of displayed white; 0: "
      "take all")
    ->check(CLI::Range(0.0, 1.0))
    ->capture_default_str()
    ->group(group);
  command.add_option("--seed", this->Seed, "random seed")->capture_default_str()->group(group);
  command
    .add_option("--cache-tolerance", this->CacheTolerance,
      "bias and noise of the cache, as a fraction of displayed white")
    ->check(CLI::Range(1e-6, 1.0))
    ->capture_default_str()
    ->group(group);
  command
    .add_option("--cache-spacing", this->CacheSpacing,
      "smallest distance between points of the cache, as a fraction of the scene's diagonal; 0: "
      "from the resolution")
    ->check(CLI::Range(0.0, 1.0))
    ->capture_default_str()
    ->group(group);
  command
    .add_option(
      "--cache-samples", this->CacheSamples, "maximum number of paths for a point of the cache")
    ->check(CLI::Range(64, 1 << 20))
    ->capture_default_str()
    ->group(group);
  command
    .add_flag("--cache-check,--no-cache-check{false}", this->CacheCheck,
      "whether to compare the cache with path tracing at random texels (default: yes)")
    ->group(group);
}

void IntegratorOptions::Apply(vtkCSLFPathTracer* tracer) const
{
  tracer->SetIntegrator(this->Integrator == PathTracing ? vtkCSLFPathTracer::PathTracing
                                                        : vtkCSLFPathTracer::RadianceCaching);
  tracer->SetSamples(this->Samples);
  tracer->SetNoiseTarget(this->NoiseTarget);
  tracer->SetSeed(this->Seed);
  tracer->SetCacheTolerance(this->CacheTolerance);
  tracer->SetCacheSpacing(this->CacheSpacing);
  tracer->SetCacheSamples(this->CacheSamples);
  tracer->SetCheckCache(this->CacheCheck);
}

nlohmann::json IntegratorOptions::GetCost(vtkCSLFPathTracer* tracer)
{
  nlohmann::json cost = { { "rays", tracer->GetNumberOfRays() },
    { "render_seconds", tracer->GetRenderSeconds() },
    { "cache_rays", tracer->GetNumberOfCacheRays() },
    { "cache_points", tracer->GetNumberOfCachePoints() },
    { "cache_seconds", tracer->GetCacheSeconds() } };
  if (tracer->GetUsedCacheSpacing() > 0.0)
  {
    cost["cache_spacing"] = tracer->GetUsedCacheSpacing();
  }
  if (tracer->GetCheckedTexels() > 0)
  {
    cost["cache_check"] = { { "texels", tracer->GetCheckedTexels() },
      { "mean", tracer->GetCacheMeanDifference() },
      { "mean_error", tracer->GetCacheMeanDifferenceError() },
      { "rms", tracer->GetCacheRMSDifference() },
      { "rms_error", tracer->GetCacheRMSDifferenceError() } };
  }
  return cost;
}
}
}
