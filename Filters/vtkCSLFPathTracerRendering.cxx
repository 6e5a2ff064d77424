// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// How vtkCSLFPathTracer renders pictures and single rays for its subclasses.
#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "Pipeline/cslfPhase.h"
#include "cslfSeconds.h"
#include "vtkCSLFPathTracer.h"
#include "vtkCSLFPathTracerInternals.h"

#include <algorithm>
#include <chrono>
#include <vector>

cslf::RenderSettings vtkCSLFPathTracer::GetRenderSettings()
{
  cslf::RenderSettings settings;
  settings.Samples = this->GetUsedSamples();
  settings.NoiseTarget = this->GetUsedNoiseTarget();
  settings.Seed = static_cast<std::uint32_t>(this->Seed);
  settings.Exposure = this->GetUsedExposure();
  settings.ShowEnvironment = this->Internals->Environment->GetShow();
  settings.Paths.MaximumDepth = this->GetUsedMaximumDepth();
  return settings;
}

// Prepares the cache, if there is one. With `isAgain`, a cache that is there is used at once.
// Otherwise ranks agree about it.
bool vtkCSLFPathTracer::PrepareRendering(
  const cslf::CheckedPicture& whole, bool isFloat, bool isAgain, cslf::RenderSettings& settings)
{
  if (this->CostTime != this->GetMTime())
  {
    this->CostTime = this->GetMTime();
    this->NumberOfRays = 0;
    this->RenderSeconds = 0.0;
    this->NumberOfCacheRays = 0;
    this->CacheSeconds = 0.0;
    this->CheckedTexels = 0;
    this->CacheMeanDifference = 0.0;
    this->CacheMeanDifferenceError = 0.0;
    this->CacheRMSDifference = 0.0;
    this->CacheRMSDifferenceError = 0.0;
    this->UsedCacheSpacing = 0.0;
  }
  settings = this->GetRenderSettings();
  // A viewer may change the exposure of float colours; bytes are clipped at white.
  settings.DisplayRange = isFloat ? cslf::DisplayCurve::FloatRange : cslf::DisplayCurve::ByteRange;
  if (this->GetUsedIntegrator() != RadianceCaching)
  {
    return true;
  }
  const double spacing = this->Internals->CacheOptions->GetSpacing();
  const bool isChecked = this->Internals->CacheOptions->GetCheck();
  const double used = spacing > 0.0
    ? spacing
    : GetAutomaticCacheSpacing(std::max(whole.TileWidth, whole.TileHeight), this->Quality);
  const bool isThere =
    isAgain && this->Internals->CacheKey == this->MakeCacheKey(used, settings.DisplayRange);
  if (!isThere && !this->UpdateCache(used, settings.DisplayRange, isChecked ? &whole : nullptr))
  {
    return false;
  }
  settings.Cache = this->Internals->Cache.get();
  if (!this->Internals->IsProbe)
  {
    // The cache may have been made without it.
    if (isChecked && !settings.Cache->GetCheck().IsMade() && !this->MeasureCache(whole, nullptr))
    {
      return false;
    }
    this->ReportCache();
  }
  return true;
}

bool vtkCSLFPathTracer::RenderTexels(const cslf::PictureLayout& layout,
  const cslf::RenderSettings& settings,
  const std::function<cslf::RayGrid(int slice, int tile)>& grids,
  const cslf::ViewpointSamples& output, const char* name)
{
  cslf::Phase phase(this, name);
  const auto start = std::chrono::steady_clock::now();
  const cslf::TexelRenderer renderer(
    *this->Internals->Scene.World, layout, settings, grids, output);
  const bool done = renderer.Render([&phase](double share) { return phase.Report(share); });
  this->NumberOfRays += renderer.GetNumberOfRays();
  this->RenderSeconds += cslf::SecondsSince(start);
  return done;
}

bool vtkCSLFPathTracer::Render(const cslf::CheckedPicture& whole, int first, int count,
  const cslf::ViewpointSamples& output, bool surfaceTexels, const char* name)
{
  cslf::RenderSettings settings;
  if (!this->PrepareRendering(whole, output.Get<float>(cslf::KnownChannel::Color), false, settings))
  {
    return false;
  }
  settings.SurfaceTexels = surfaceTexels;
  return this->RenderTexels({ whole.TileWidth, whole.TileHeight, whole.Tiles, first, count },
    settings, whole.Grids, output, name);
}

bool vtkCSLFPathTracer::RenderRays(const cslf::CheckedPicture& whole,
  const std::vector<cslf::RayGrid>& rays, const cslf::ViewpointSamples& output, const char* name)
{
  cslf::RenderSettings settings;
  if (!this->PrepareRendering(whole, output.Get<float>(cslf::KnownChannel::Color), true, settings))
  {
    return false;
  }
  settings.ShowEnvironment = false;
  return this->RenderTexels(
    { 1, 1, 1, 0, static_cast<int>(rays.size()) }, settings,
    [&rays](int slice, int) { return rays[slice]; }, output, name);
}
