// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A sample of one of a light's points or directions.
 */
#ifndef cslfLightSample_h
#define cslfLightSample_h

#include <glm/vec3.hpp>

#include <limits>

namespace cslf
{
/// Light that arrives at a surface point if nothing lies between. A density of 0 means that there
/// is none. The density of a light without extent is infinite, and its radiance is then its
/// irradiance on a surface that faces it.
struct LightSample
{
  glm::vec3 Direction{ 0.0f }; ///< from the surface point to the light, of unit length
  glm::vec3 Radiance{ 0.0f };
  float Pdf = 0.0f; ///< per solid angle
  float Distance = std::numeric_limits<float>::infinity();
};
}

#endif
