// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// How vtkCSLFPathTracer renders pictures and single rays for its subclasses.
#include "Certificate/cslfCertifier.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Texels/cslfTexelRenderer.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfPhase.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "cslfSeconds.h"
#include "vtkCSLFPathTracer.h"
#include "vtkCSLFPathTracerInternals.h"

#include <algorithm>
#include <chrono>
#include <vector>

namespace
{
/// Makes the random numbers of single pixels differ from those of pictures with the same seed.
constexpr std::uint64_t PixelSalt = 0x506978656c426561u;

/// The pixels traced at once: enough to keep many threads busy.
constexpr std::size_t ChunkPixels = 4096;

/// A pixel's rays in the scene, as cells that share its area.
cslf::RayGrid MakeRays(const cslf::PixelBeam& beam, const cslf::SceneFrame& frame)
{
  cslf::RayGrid rays;
  rays.Origin = frame.PointToScene(beam.Eye);
  rays.Direction = frame.VectorToScene(beam.Corner);
  rays.DirectionX = frame.VectorToScene(beam.Right);
  rays.DirectionY = frame.VectorToScene(beam.Up);
  return cslf::MakeTexelRays(rays, 0, 0, cslf::TracedPixel::CellsPerSide);
}

/// The mean of a part of a pixel, whose cells these are.
glm::dvec4 MeanOf(const float* cells, int count)
{
  glm::dvec4 sum(0.0);
  for (int cell = 0; cell < count; ++cell, cells += 4)
  {
    sum += glm::dvec4(cells[0], cells[1], cells[2], cells[3]);
  }
  return sum / static_cast<double>(count);
}
}

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

std::string vtkCSLFPathTracer::GetSceneHash()
{
  return this->Internals->SceneKey.empty() ? "" : this->Internals->Scene.Fingerprint;
}

// A part of a pixel is a slice of a picture. Its number determines its random numbers.
bool vtkCSLFPathTracer::TracePixels(const std::vector<cslf::PixelBeam>& beams, int samples,
  int seed, const std::function<bool(double)>& progress, std::vector<cslf::TracedPixel>& pixels)
{
  constexpr int side = cslf::TracedPixel::CellsPerSide;
  constexpr int cells = side * side;
  constexpr int parts = cslf::TracedPixel::Parts;
  const cslf::BuiltScene& scene = this->Internals->Scene;
  if (this->GetSceneHash().empty())
  {
    return false;
  }
  cslf::RenderSettings settings = this->GetRenderSettings();
  settings.Samples = std::max(1, samples / cslf::TracedPixel::PathStep);
  settings.NoiseTarget = 0.0;
  settings.Seed =
    static_cast<std::uint32_t>(cslf::MixBits(PixelSalt, static_cast<std::uint32_t>(seed)));
  pixels.resize(beams.size());
  for (std::size_t first = 0; first < beams.size(); first += ChunkPixels)
  {
    const std::size_t count = std::min(ChunkPixels, beams.size() - first);
    cslf::ViewpointSamples output;
    output.SetArray(cslf::KnownChannel::Color,
      cslf::MakeArray(cslf::MakeChannel(cslf::KnownChannel::Color, VTK_FLOAT),
        static_cast<vtkIdType>(cells * parts * count)));
    const cslf::PictureLayout layout{ side, side, 1, static_cast<int>(parts * first),
      static_cast<int>(parts * count) };
    const cslf::TexelRenderer renderer(
      *scene.World, layout, settings,
      [&](int slice, int) { return MakeRays(beams[slice / parts], scene.Frame); }, output);
    const auto report = [&](double share)
    {
      const double done = static_cast<double>(first) + share * static_cast<double>(count);
      return progress(done / static_cast<double>(beams.size()));
    };
    if (!renderer.Render(report))
    {
      return false;
    }
    const float* colors = output.Get<float>(cslf::KnownChannel::Color);
    for (std::size_t k = 0; k < parts * count; ++k)
    {
      pixels[first + k / parts].Means[k % parts] = MeanOf(colors + 4 * cells * k, cells);
    }
  }
  return true;
}
