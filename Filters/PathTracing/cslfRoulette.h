// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which paths end by chance.
 */
#ifndef cslfRoulette_h
#define cslfRoulette_h

#include <glm/vec3.hpp>

#include <algorithm>

namespace cslf
{
// From this many reflections on, paths of little weight end early.
constexpr int RouletteDepth = 3;

// The largest chance of going on, so that paths end between white surfaces too.
constexpr float LargestSurvival = 0.95f;

/// The chance that a path goes on, by its weight without the compression that leaving the glass
/// undoes.
inline float GetSurvival(const glm::vec3& beta, float compression)
{
  const float weight = std::max(std::max(beta.x, beta.y), beta.z) / compression;
  return std::min(weight, LargestSurvival);
}

/// Russian roulette. False where the path ends.
inline bool Survive(glm::vec3& beta, float compression, float u)
{
  const float survival = GetSurvival(beta, compression);
  if (u >= survival)
  {
    return false;
  }
  beta /= survival;
  return true;
}
}

#endif
