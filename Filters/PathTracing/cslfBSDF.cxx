// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBSDF.h"

#include "cslfFresnel.h"
#include "cslfGGX.h"
#include "cslfLambert.h"

#include <limits>

namespace cslf
{
BSDF::BSDF(const SurfaceMaterial& material, const glm::vec3& baseColor, const glm::vec3& outgoing)
  : Material(material)
  , BaseColor(baseColor)
  , Outgoing(outgoing)
{
  if (material.Metallic == 0.0f && material.IndexOfRefraction == 1.0f)
  {
    return; // diffuse only
  }
  const float specular = Luminance(this->Fresnel(outgoing.z));
  const float diffuse = (1.0f - material.Metallic) * Luminance(baseColor) *
    (1.0f - material.DielectricSpecular.Get(outgoing.z));
  this->SpecularProbability =
    diffuse > 0.0f ? std::clamp(specular / (specular + diffuse), 0.1f, 0.9f) : 1.0f;
}

glm::vec3 BSDF::Fresnel(float cosine) const
{
  const float metallic = this->Material.Metallic;
  return metallic * SchlickFresnel(cosine, this->BaseColor) +
    (1.0f - metallic) * glm::vec3(DielectricFresnel(cosine, this->Material.IndexOfRefraction));
}

glm::vec3 BSDF::DiffuseAlbedo() const
{
  const float boundary = 1.0f - this->Material.DielectricSpecular.Get(this->Outgoing.z);
  return this->BaseColor * ((1.0f - this->Material.Metallic) * boundary);
}

float BSDF::DiffuseTransmission(const glm::vec3& incident) const
{
  const SpecularAlbedo& albedo = this->Material.DielectricSpecular;
  return (1.0f - albedo.Get(incident.z)) / (1.0f - albedo.GetAverage());
}

glm::vec3 BSDF::EvaluateCosine(const glm::vec3& incident, Lobes lobes) const
{
  glm::vec3 value(0.0f);
  if (!(incident.z > 0.0f) || !(this->Outgoing.z > 0.0f))
  {
    return value;
  }
  if (lobes != Lobes::Specular && this->HasDiffuse())
  {
    value = this->DiffuseAlbedo() *
      (this->DiffuseTransmission(incident) * Lambert::EvaluateCosine(incident));
  }
  if (lobes != Lobes::Diffuse && this->HasSpecular() && this->Material.Alpha > 0.0f)
  {
    const float cosHalf = glm::dot(this->Outgoing, glm::normalize(this->Outgoing + incident));
    value +=
      this->Fresnel(cosHalf) * GGX(this->Material.Alpha).EvaluateCosine(this->Outgoing, incident);
  }
  return value;
}

float BSDF::Pdf(const glm::vec3& incident, Lobes lobes) const
{
  const float specular = this->GetSpecularProbability(lobes);
  float pdf = (1.0f - specular) * Lambert::Pdf(incident);
  if (specular > 0.0f && this->Material.Alpha > 0.0f)
  {
    pdf += specular * GGX(this->Material.Alpha).Pdf(this->Outgoing, incident);
  }
  return pdf;
}

bool BSDF::Sample(float lobe, const glm::vec2& u, BSDFSample& sample, Lobes lobes) const
{
  const float specularProbability = this->GetSpecularProbability(lobes);
  const bool specular = lobe < specularProbability;
  if (specular && this->Material.Alpha == 0.0f)
  {
    sample.Direction = { -this->Outgoing.x, -this->Outgoing.y, this->Outgoing.z };
    sample.Weight = this->Fresnel(this->Outgoing.z) / specularProbability;
    sample.Pdf = std::numeric_limits<float>::infinity();
    return true;
  }
  sample.Direction =
    specular ? GGX(this->Material.Alpha).Sample(this->Outgoing, u) : Lambert::Sample(u);
  sample.Pdf = this->Pdf(sample.Direction, lobes);
  if (!(sample.Direction.z > 0.0f) || !(sample.Pdf > 0.0f))
  {
    return false;
  }
  sample.Weight = this->EvaluateCosine(sample.Direction, lobes) / sample.Pdf;
  return true;
}
}
