// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Russian roulette, which ends paths at random.
 */
#ifndef cslfRoulette_h
#define cslfRoulette_h

#include <glm/vec3.hpp>

#include <algorithm>

namespace cslf
{
// From this many reflections on, paths of little weight end early.
constexpr int RouletteDepth = 3;

// The largest probability of continuing, so that paths between white surfaces end, too.
constexpr float LargestSurvival = 0.95f;

/// The probability that a path continues, from its weight without the compression that is undone on
/// leaving glass.
inline float GetSurvival(const glm::vec3& beta, float compression)
{
  const float weight = std::max(std::max(beta.x, beta.y), beta.z) / compression;
  return std::min(weight, LargestSurvival);
}
}

#endif
