// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The directions in which media scatter light: Henyey and Greenstein, "Diffuse radiation in the
 * galaxy", Astrophysical Journal 93, 1941.
 */
#ifndef cslfPhaseFunction_h
#define cslfPhaseFunction_h

#include "PathTracing/Materials/cslfLobe.h"
#include "RandomNumbers/cslfSampling.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
// Closer to 0, the phase function is uniform to the precision of floats.
constexpr float MinimumAnisotropy = 1e-3f;

/// The density per solid angle of a direction whose cosine to the path, before it is scattered, is
/// given.
inline float EvaluatePhase(float cosine, float anisotropy)
{
  const float g = anisotropy;
  const float square = std::max(1.0f + g * g - 2.0f * g * cosine, 1e-12f);
  return 0.25f * InversePi * (1.0f - g * g) / (square * std::sqrt(square));
}

/// A direction with that density.
inline glm::vec3 SamplePhase(const glm::vec3& path, float anisotropy, const glm::vec2& u)
{
  const float g = anisotropy;
  float cosine = 1.0f - 2.0f * u.x;
  if (std::abs(g) > MinimumAnisotropy)
  {
    const float ratio = (1.0f - g * g) / (1.0f - g + 2.0f * g * u.x);
    cosine = (1.0f + g * g - ratio * ratio) / (2.0f * g);
  }
  cosine = std::clamp(cosine, -1.0f, 1.0f);
  const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
  float y = 0.0f;
  float x = 0.0f;
  SinCosOfTurn(u.y, y, x);
  return Frame(path).ToWorld({ sine * x, sine * y, cosine });
}
}

#endif
