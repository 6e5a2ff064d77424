// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Light from one point, alike in all directions.
 */
#ifndef cslfPointLight_h
#define cslfPointLight_h

#include "cslfLightSample.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace cslf
{
struct PointLight
{
  glm::vec3 Position{ 0.0f };
  glm::vec3 Intensity{ 0.0f }; ///< radiant intensity: irradiance times squared distance

  LightSample Sample(const glm::vec3& from) const
  {
    LightSample sample;
    const glm::vec3 path = this->Position - from;
    const float distance2 = glm::dot(path, path);
    if (distance2 > 0.0f)
    {
      sample.Distance = std::sqrt(distance2);
      sample.Direction = path / sample.Distance;
      sample.Radiance = this->Intensity / distance2;
      sample.Pdf = std::numeric_limits<float>::infinity();
    }
    return sample;
  }
};
}

#endif
