// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Light from infinitely far away, in one direction.
 */
#ifndef cslfDirectionalLight_h
#define cslfDirectionalLight_h

#include "cslfLightSample.h"

namespace cslf
{
struct DirectionalLight
{
  glm::vec3 Direction{ 0.0f, 0.0f, -1.0f }; ///< in which the light travels, of unit length
  glm::vec3 Irradiance{ 0.0f };             ///< on a surface that faces it

  LightSample Sample() const
  {
    LightSample sample;
    sample.Direction = -this->Direction;
    sample.Radiance = this->Irradiance;
    sample.Pdf = std::numeric_limits<float>::infinity();
    return sample;
  }
};
}

#endif
