// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfIntegratorOptions.h"

#include "cslfTableOptions.h"

#include "vtkCSLFPathTracer.h"

#include <CLI/CLI.hpp>

namespace cslf::tool
{
void IntegratorOptions::AddTo(CLI::App& command)
{
  const std::string group = "Light transport";
  AddOption(command, options::Integrator, this->Integrator)->group(group);
  AddOption(command, options::Interreflection, this->Interreflection)->group(group);
  AddOption(command, options::Quality, this->Quality)->group(group);
  AddOption(command, options::Samples, this->Samples)->group(group);
  AddOption(command, options::NoiseTarget, this->NoiseTarget)->group(group);
  AddOption(command, options::Seed, this->Seed)->group(group);
  using CacheOptions = vtkCSLFRadianceCacheOptions;
  CacheOptions* cache = this->Cache;
  AddOption(command, options::CacheTolerance, cache, &CacheOptions::SetTolerance)->group(group);
  AddOption(command, options::CacheSpacing, cache, &CacheOptions::SetSpacing)->group(group);
  AddOption(command, options::CacheSamples, cache, &CacheOptions::SetSamples)->group(group);
  AddOption(command, options::CheckCache, cache, &CacheOptions::SetCheck)->group(group);
}

void IntegratorOptions::Apply(vtkCSLFPathTracer* tracer) const
{
  tracer->SetIntegrator(this->Integrator);
  tracer->SetInterreflection(this->Interreflection);
  tracer->SetQuality(this->Quality);
  tracer->SetSamples(this->Samples);
  tracer->SetNoiseTarget(this->NoiseTarget);
  tracer->SetSeed(this->Seed);
  tracer->SetCacheOptions(this->Cache);
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
