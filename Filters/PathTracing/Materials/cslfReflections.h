// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The directions into which a rough dielectric reflects.
 */
#ifndef cslfReflections_h
#define cslfReflections_h

#include "cslfGGX.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace cslf
{
/// Visits samples of the reflection of light that leaves at a cosine, in the plane y = 0: the
/// incident direction, and GGX's sample weight, F G2 / G1. Returns their number, including those
/// without light, which are not visited.
template <typename Visit>
int VisitReflections(float ior, const GGX& facets, float cosine, Visit visit)
{
  constexpr int side = 24;
  const glm::vec3 outgoing(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
  for (int i = 0; i < side * side; ++i)
  {
    const glm::vec2 u((i / side + 0.5f) / side, (i % side + 0.5f) / side);
    const glm::vec3 incident = facets.Sample(outgoing, u);
    if (incident.z > 0.0f)
    {
      const float cosHalf = glm::dot(outgoing, glm::normalize(outgoing + incident));
      visit(incident,
        DielectricFresnel(cosHalf, ior) * facets.MaskingShadowing(outgoing, incident) /
          facets.Masking(outgoing));
    }
  }
  return side * side;
}
}

#endif
