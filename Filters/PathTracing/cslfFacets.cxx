// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFacets.h"

#include "cslfFresnel.h"
#include "cslfGGX.h"

#include <cmath>

namespace cslf
{
namespace
{
// Light through glass with an index closer to 1 than this is refracted by less than a degree at
// most angles.
constexpr float SmallestContrast = 1e-2f;

/// Whether facets reflect in this direction. Otherwise they refract.
bool IsReflected(const glm::vec3& incident)
{
  return incident.z > 0.0f;
}
}

Facets::Facets(const SurfaceMaterial& material, const MaterialPoint& point, bool inside)
  : BaseColor(point.BaseColor)
  , Metallic(point.Metallic)
  , Opaque((1.0f - point.Metallic) * (1.0f - material.Transmission))
  , Glass((1.0f - point.Metallic) * material.Transmission)
  , Index(material.IndexOfRefraction)
  , Eta(material.IndexOfRefraction)
  , Alpha(point.Alpha)
  , Thin(material.Thin)
{
  if (inside && this->Glass > 0.0f && !this->Thin)
  {
    this->Eta = 1.0f / this->Eta;
  }
  if (std::abs(this->Eta - 1.0f) < SmallestContrast)
  {
    this->Eta = 1.0f;
  }
  this->Straight = this->Thin || this->Eta == 1.0f;
}

/// The reflection of glass. In a thin sheet, light goes back and forth between its boundaries.
float Facets::GlassFresnel(float cosine) const
{
  const float fresnel = DielectricFresnel(cosine, this->Eta);
  return this->Thin ? 2.0f * fresnel / (1.0f + fresnel) : fresnel;
}

glm::vec3 Facets::GetReflectance(float cosine, float glassCosine) const
{
  return this->Metallic * SchlickFresnel(cosine, this->BaseColor) +
    glm::vec3(this->Opaque * DielectricFresnel(cosine, this->Index) +
      (this->Glass > 0.0f ? this->Glass * this->GlassFresnel(glassCosine) : 0.0f));
}

glm::vec3 Facets::GetTransmittance(float cosine) const
{
  return this->Glass > 0.0f ? this->Glass * (1.0f - this->GlassFresnel(cosine)) * this->BaseColor
                            : glm::vec3(0.0f);
}

float Facets::ReflectionProbability(float cosine) const
{
  const float transmitted = Luminance(this->GetTransmittance(cosine));
  if (transmitted == 0.0f)
  {
    return 1.0f;
  }
  const float reflected = Luminance(this->GetReflectance(cosine));
  return reflected / (reflected + transmitted);
}

glm::vec3 Facets::EvaluateCosine(const glm::vec3& outgoing, const glm::vec3& incident) const
{
  if (this->Alpha == 0.0f || !(outgoing.z > 0.0f))
  {
    return glm::vec3(0.0f);
  }
  if (IsReflected(incident))
  {
    const float cosine = glm::dot(outgoing, glm::normalize(outgoing + incident));
    // Light that goes straight on meets no facets, so the angle determines their reflection.
    return this->GetReflectance(cosine, this->Straight ? outgoing.z : cosine) *
      GGX(this->Alpha).EvaluateCosine(outgoing, incident);
  }
  if (this->Glass == 0.0f || this->Straight)
  {
    return glm::vec3(0.0f);
  }
  // Masking and shadowing on opposite sides are assumed to be independent, as in Walter et al.
  float cosine = 0.0f;
  const float density = this->RefractionDensity(outgoing, incident, cosine);
  return this->GetTransmittance(cosine) *
    (density * GGX(this->Alpha).Masking(incident) * this->GetCompression());
}

float Facets::Pdf(const glm::vec3& outgoing, const glm::vec3& incident) const
{
  if (this->Alpha == 0.0f || !(outgoing.z > 0.0f))
  {
    return 0.0f;
  }
  if (IsReflected(incident))
  {
    const float cosine =
      this->Straight ? outgoing.z : glm::dot(outgoing, glm::normalize(outgoing + incident));
    return this->ReflectionProbability(cosine) * GGX(this->Alpha).Pdf(outgoing, incident);
  }
  if (this->Glass == 0.0f || this->Straight)
  {
    return 0.0f;
  }
  float cosine = 0.0f;
  const float density = this->RefractionDensity(outgoing, incident, cosine);
  return (1.0f - this->ReflectionProbability(cosine)) * density;
}

/// The density of the directions to which visible facets refract, and the cosine at the facet:
/// Walter et al., equation 17.
float Facets::RefractionDensity(
  const glm::vec3& outgoing, const glm::vec3& incident, float& cosine) const
{
  const glm::vec3 sum = outgoing + this->Eta * incident;
  glm::vec3 facet = glm::normalize(sum);
  facet = facet.z < 0.0f ? -facet : facet;
  cosine = glm::dot(outgoing, facet);
  const float cosFar = glm::dot(incident, facet);
  if (!(cosine > 0.0f) || !(cosFar < 0.0f))
  {
    return 0.0f;
  }
  const float jacobian = this->Eta * this->Eta * -cosFar / glm::dot(sum, sum);
  return jacobian * GGX(this->Alpha).VisibleDensity(outgoing, facet);
}

bool Facets::Sample(
  const glm::vec3& outgoing, float which, const glm::vec2& u, Choice& choice) const
{
  glm::vec3 facet(0.0f, 0.0f, 1.0f);
  if (this->Alpha > 0.0f)
  {
    facet = GGX(this->Alpha).SampleFacet(outgoing, u);
  }
  const float cosine = glm::dot(outgoing, facet);
  const float chooseBy = this->Straight ? outgoing.z : cosine;
  const float probability = this->ReflectionProbability(chooseBy);
  if (probability >= 1.0f || which < probability)
  {
    choice.Direction = 2.0f * cosine * facet - outgoing;
    choice.IsSmooth = this->Alpha == 0.0f;
    choice.Weight = this->GetReflectance(chooseBy) / probability;
    return choice.Direction.z > 0.0f;
  }
  choice.IsSmooth = this->Alpha == 0.0f || this->Straight;
  choice.Direction = this->Straight ? -outgoing : this->Refract(outgoing, facet, cosine);
  choice.Weight =
    this->GetTransmittance(chooseBy) * (this->GetCompression() / (1.0f - probability));
  return choice.Direction.z < 0.0f;
}

glm::vec3 Facets::Refract(const glm::vec3& outgoing, const glm::vec3& facet, float cosine) const
{
  const float sine2 = (1.0f - cosine * cosine) / (this->Eta * this->Eta);
  const float cosFar = std::sqrt(std::max(0.0f, 1.0f - sine2));
  return glm::normalize((cosine / this->Eta - cosFar) * facet - outgoing / this->Eta);
}
}
