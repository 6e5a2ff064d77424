// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The light of a floor from ten times white to nearly black, in floats: at every exposure of the
// display's range, path tracing and radiance caching keep to the requested error.
#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "cslfColor.h"
#include "cslfTestTransport.h"
#include "cslfTexelPicture.h"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

namespace
{
using cslf::testing::MakeDiffuse;
using cslf::testing::MakeRectangle;
using cslf::testing::TexelPicture;

constexpr double Target = 0.005;

/// The largest root mean square difference at any exposure of the range, and that exposure.
double FindLargestError(const std::vector<float>& colors, const std::vector<float>& reference)
{
  double largest = 0.0;
  for (const double exposure : { 1.0 / 16, 0.25, 1.0, 4.0, 16.0 })
  {
    double squares = 0.0;
    for (std::size_t i = 0; i < colors.size(); i += 4)
    {
      const double error =
        cslf::LinearToSRGB(exposure * colors[i]) - cslf::LinearToSRGB(exposure * reference[i]);
      squares += error * error;
    }
    const double error = std::sqrt(4.0 * squares / static_cast<double>(colors.size()));
    std::cout << " " << error;
    largest = std::max(largest, error);
  }
  std::cout << "\n";
  return largest;
}

/// A floor with a lamp close above a corner.
cslf::Scene MakeScene()
{
  return { { MakeRectangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, MakeDiffuse(0.8f)),
             MakeRectangle(
               { -0.6f, -0.6f, 0.3f }, { 0.1f, 0, 0 }, { 0, 0.1f, 0 }, MakeDiffuse(0.0f, 90.0f)) },
    cslf::LightSet() };
}
}

int TestCSLFDisplayRange(int, char*[])
{
  const cslf::Scene scene = MakeScene();
  TexelPicture picture(scene, 24, 0.25);
  cslf::RenderSettings settings;
  settings.Samples = 4096;
  settings.Seed = 1;
  const std::vector<float> reference = picture.Render(settings);
  double brightest = 0.0;
  double darkest = 1.0;
  for (std::size_t i = 0; i < reference.size(); i += 4)
  {
    brightest = std::max<double>(brightest, reference[i]);
    darkest = std::min<double>(darkest, reference[i]);
  }
  CSLF_CHECK(brightest > 8.0 && darkest < 0.01);

  // Bytes show only one exposure, for which fewer samples are enough. The cache is accurate enough
  // either way.
  for (const double range : { cslf::DisplayCurve::ByteRange, cslf::DisplayCurve::FloatRange })
  {
    const bool isFloat = range == cslf::DisplayCurve::FloatRange;
    settings.Seed = 0;
    settings.DisplayRange = range;
    settings.NoiseTarget = Target;
    settings.Cache = nullptr;
    std::uint64_t rays = 0;
    const std::vector<float> traced = picture.Render(settings, &rays);
    std::cout << "range " << range << ", path tracing, " << rays << " rays:";
    CSLF_CHECK((FindLargestError(traced, reference) < Target) == isFloat);

    cslf::CacheSettings cacheSettings;
    cacheSettings.Tolerance = Target;
    cacheSettings.Spacing = 0.02;
    cacheSettings.Samples = 16384;
    cacheSettings.DisplayRange = range;
    cslf::RadianceCache cache(scene, cacheSettings);
    CSLF_CHECK(cache.Build([](double) { return true; }));
    settings.Cache = &cache;
    settings.NoiseTarget = 0.0;
    settings.Samples = 64;
    const std::vector<float> cached = picture.Render(settings);
    std::cout << "range " << range << ", radiance caching, " << cache.GetNumberOfRays() << " rays:";
    CSLF_CHECK(FindLargestError(cached, reference) < Target);
    settings.Samples = 4096;
  }
  return cslf::testing::Result();
}
