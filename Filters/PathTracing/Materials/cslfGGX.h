// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reflectances of smooth boundaries, and reflection by the microfacets of Trowbridge and Reitz
 * (GGX): Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007.
 * Directions are local, z being the normal, and both point away from the surface.
 */
#ifndef cslfGGX_h
#define cslfGGX_h

#include "RandomNumbers/cslfSampling.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
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

class GGX
{
public:
  /// `alpha` is the square of the perceptual roughness, as in glTF 2.0, appendix B.
  explicit GGX(float alpha)
    : Alpha(alpha)
  {
  }

  /// The density of facet normals.
  float Density(const glm::vec3& normal) const
  {
    const float x = normal.x / this->Alpha;
    const float y = normal.y / this->Alpha;
    const float d = x * x + y * y + normal.z * normal.z;
    return InversePi / (this->Alpha * this->Alpha * d * d);
  }

  /// Smith's masking of one direction.
  float Masking(const glm::vec3& direction) const
  {
    return 1.0f / (1.0f + this->Lambda(direction));
  }

  /// Smith's masking and shadowing, correlated by height (Heitz, JCGT 3(2), 2014).
  float MaskingShadowing(const glm::vec3& outgoing, const glm::vec3& incident) const
  {
    return 1.0f / (1.0f + this->Lambda(outgoing) + this->Lambda(incident));
  }

  /// The BSDF without its Fresnel factor, times the cosine at the incident direction.
  float EvaluateCosine(const glm::vec3& outgoing, const glm::vec3& incident) const
  {
    if (!(outgoing.z > 0.0f) || !(incident.z > 0.0f))
    {
      return 0.0f;
    }
    const glm::vec3 half = glm::normalize(outgoing + incident);
    return this->Density(half) * this->MaskingShadowing(outgoing, incident) / (4.0f * outgoing.z);
  }

  /// The density of Sample.
  float Pdf(const glm::vec3& outgoing, const glm::vec3& incident) const
  {
    if (!(outgoing.z > 0.0f) || !(incident.z > 0.0f))
    {
      return 0.0f;
    }
    const glm::vec3 half = glm::normalize(outgoing + incident);
    return this->Density(half) * this->Masking(outgoing) / (4.0f * outgoing.z);
  }

  /// The density of the normals of those facets that are seen from the outgoing direction.
  float VisibleDensity(const glm::vec3& outgoing, const glm::vec3& normal) const
  {
    return this->Density(normal) * this->Masking(outgoing) *
      std::max(0.0f, glm::dot(outgoing, normal)) / outgoing.z;
  }

  /// The outgoing direction mirrored by one of the facets it sees. May lie below the surface.
  glm::vec3 Sample(const glm::vec3& outgoing, const glm::vec2& u) const
  {
    const glm::vec3 facet = this->SampleFacet(outgoing, u);
    return 2.0f * glm::dot(outgoing, facet) * facet - outgoing;
  }

  /// The normal of a facet, with VisibleDensity (Dupuy and Benyoub, "Sampling Visible GGX Normals
  /// with Spherical Caps", HPG 2023).
  glm::vec3 SampleFacet(const glm::vec3& outgoing, const glm::vec2& u) const
  {
    const glm::vec3 stretched =
      glm::normalize(glm::vec3(this->Alpha * outgoing.x, this->Alpha * outgoing.y, outgoing.z));
    float sine = 0.0f;
    float cosine = 0.0f;
    SinCosOfTurn(u.x, sine, cosine);
    const float z = (1.0f - u.y) * (1.0f + stretched.z) - stretched.z;
    const float radius = std::sqrt(std::clamp(1.0f - z * z, 0.0f, 1.0f));
    const glm::vec3 cap = glm::vec3(radius * cosine, radius * sine, z) + stretched;
    return glm::normalize(
      glm::vec3(this->Alpha * cap.x, this->Alpha * cap.y, std::max(cap.z, 1e-7f)));
  }

private:
  float Lambda(const glm::vec3& direction) const
  {
    const float z2 = direction.z * direction.z;
    const float tangent2 = std::max(0.0f, 1.0f - z2) / std::max(z2, 1e-12f);
    return 0.5f * (std::sqrt(1.0f + this->Alpha * this->Alpha * tangent2) - 1.0f);
  }

  float Alpha;
};

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
