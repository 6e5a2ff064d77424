// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The reflectance of a smooth boundary.
 */
#ifndef cslfFresnel_h
#define cslfFresnel_h

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
/// The exact reflectance of a dielectric of relative index `ior` for unpolarised light at angle
/// acos(`cosine`). An index of 1 reflects nothing; below 1, there is total reflection at grazing
/// angles.
inline float DielectricFresnel(float cosine, float ior)
{
  if (ior == 1.0f)
  {
    return 0.0f;
  }
  const float cosIn = std::clamp(cosine, 0.0f, 1.0f);
  const float sinOut2 = (1.0f - cosIn * cosIn) / (ior * ior);
  if (sinOut2 >= 1.0f)
  {
    return 1.0f;
  }
  const float cosOut = std::sqrt(std::max(0.0f, 1.0f - sinOut2));
  const float parallel = (ior * cosIn - cosOut) / (ior * cosIn + cosOut);
  const float perpendicular = (cosIn - ior * cosOut) / (cosIn + ior * cosOut);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// A metal of reflectance `normal` at normal incidence: Schlick's approximation.
inline glm::vec3 SchlickFresnel(float cosine, const glm::vec3& normal)
{
  const float m = 1.0f - std::clamp(cosine, 0.0f, 1.0f);
  const float m2 = m * m;
  return normal + (glm::vec3(1.0f) - normal) * (m2 * m2 * m);
}
}

#endif
