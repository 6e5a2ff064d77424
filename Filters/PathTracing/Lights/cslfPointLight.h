// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The light that arrives at a surface point from a light; and lights without extent: from
 * infinitely far away, and from one point, uniform in all directions or within a cone.
 */
#ifndef cslfPointLight_h
#define cslfPointLight_h

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
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

struct PointLight
{
  glm::vec3 Position{ 0.0f };
  glm::vec3 Intensity{ 0.0f }; ///< irradiance where the falloff is 1
  glm::vec3 Axis{ 0.0f };      ///< of the cone, of unit length; 0 for light all around
  float ConeCosine = 0.0f;     ///< of the angle between the axis and the cone's surface
  float Exponent = 0.0f;       ///< of the cosine to the axis, by which the intensity falls off
  glm::vec3 Attenuation{ 0.0f, 0.0f, 1.0f }; ///< 1 over the falloff, by powers of the distance
  float AttenuationExponent = 1.0f;          ///< of the falloff with the distance

  LightSample Sample(const glm::vec3& from) const
  {
    LightSample sample;
    const glm::vec3 path = this->Position - from;
    const float distance2 = glm::dot(path, path);
    if (distance2 > 0.0f)
    {
      sample.Distance = std::sqrt(distance2);
      sample.Direction = path / sample.Distance;
      sample.Radiance =
        this->GetFalloff(sample.Direction) / this->GetDivisor(sample.Distance) * this->Intensity;
      sample.Pdf = std::numeric_limits<float>::infinity();
    }
    return sample;
  }

private:
  /// The divisor of the irradiance at a distance.
  float GetDivisor(float distance) const
  {
    const float polynomial =
      this->Attenuation.x + distance * (this->Attenuation.y + distance * this->Attenuation.z);
    return this->AttenuationExponent == 1.0f ? polynomial
                                             : std::pow(polynomial, this->AttenuationExponent);
  }

  /// The share of the intensity in the direction of a point that sees the light in a direction.
  float GetFalloff(const glm::vec3& direction) const
  {
    if (this->Axis == glm::vec3(0.0f))
    {
      return 1.0f;
    }
    const float cosine = -glm::dot(direction, this->Axis);
    return cosine < this->ConeCosine ? 0.0f : std::pow(std::max(cosine, 0.0f), this->Exponent);
  }
};
}

#endif
