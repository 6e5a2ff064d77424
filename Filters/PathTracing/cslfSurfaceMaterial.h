// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material as the tracer uses it: everything linear, and what depends on the material alone
 * worked out once.
 */
#ifndef cslfSurfaceMaterial_h
#define cslfSurfaceMaterial_h

#include "vtkCSLFModule.h" // for export macro

#include <glm/vec3.hpp>

#include <array>

namespace cslf
{
/// The part of the light that a dielectric's glossy boundary reflects: the BSDF's integral over all
/// incident directions, by the outgoing cosine.
class VTKCSLF_EXPORT SpecularAlbedo
{
public:
  /// A boundary that reflects nothing.
  SpecularAlbedo() = default;

  /// `alpha` of 0 is a smooth boundary.
  SpecularAlbedo(float ior, float alpha);

  float Get(float cosine) const;

  /// The mean over the hemisphere, weighted by the cosine.
  float GetAverage() const { return this->Average; }

private:
  static constexpr int Steps = 32;
  std::array<float, Steps + 1> Values{};
  float Average = 0.0f;
};

class VTKCSLF_EXPORT SurfaceMaterial
{
public:
  SurfaceMaterial() = default;
  SurfaceMaterial(const glm::vec3& baseColor, float metallic, float roughness,
    float indexOfRefraction, const glm::vec3& emission);

  glm::vec3 BaseColor{ 0.6f };       ///< linear
  float Metallic = 0.0f;             ///< in [0,1]
  float Alpha = 1.0f;                ///< GGX's; 0 is a perfect mirror
  float IndexOfRefraction = 1.0f;    ///< at least 1; 1 has no boundary that reflects
  glm::vec3 Emission{ 0.0f };        ///< radiance, from both sides
  SpecularAlbedo DielectricSpecular; ///< of the dielectric boundary

  bool IsEmissive() const;
};
}

#endif
