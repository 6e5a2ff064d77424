// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBSDF.h"

#include "cslfLambert.h"

#include <algorithm>
#include <limits>

namespace cslf
{
BSDF::BSDF(const SurfaceMaterial& material, const MaterialPoint& point, const glm::vec3& outgoing,
  bool inside)
  : Material(material)
  , Point(point)
  , Outgoing(outgoing)
  , Specular(material, point, inside)
  , DiffusePart((1.0f - point.Metallic) * (1.0f - material.Transmission))
{
  if (this->DiffusePart == 1.0f && material.IndexOfRefraction == 1.0f)
  {
    return; // diffuse only
  }
  const float specular = Luminance(
    this->Specular.GetReflectance(outgoing.z) + this->Specular.GetTransmittance(outgoing.z));
  const float diffuse = this->DiffusePart * Luminance(point.BaseColor) *
    (1.0f - material.DielectricSpecular.Get(outgoing.z, point.Alpha));
  this->SpecularProbability =
    diffuse > 0.0f ? std::clamp(specular / (specular + diffuse), 0.1f, 0.9f) : 1.0f;
}

glm::vec3 BSDF::DiffuseAlbedo() const
{
  const float boundary =
    1.0f - this->Material.DielectricSpecular.Get(this->Outgoing.z, this->Point.Alpha);
  return this->Point.BaseColor * (this->DiffusePart * boundary);
}

float BSDF::DiffuseTransmission(float cosine) const
{
  const SpecularAlbedo& albedo = this->Material.DielectricSpecular;
  const float alpha = this->Point.Alpha;
  return (1.0f - albedo.Get(cosine, alpha)) / (1.0f - albedo.GetAverage(alpha));
}

glm::vec3 BSDF::EvaluateCosine(const glm::vec3& incident, Lobes lobes) const
{
  glm::vec3 value(0.0f);
  if (!(this->Outgoing.z > 0.0f))
  {
    return value;
  }
  if (lobes != Lobes::Specular && this->HasDiffuse() && incident.z > 0.0f)
  {
    value = this->DiffuseAlbedo() *
      (this->DiffuseTransmission(incident.z) * Lambert::EvaluateCosine(incident));
  }
  if (lobes != Lobes::Diffuse && this->HasSpecular())
  {
    value += this->Specular.EvaluateCosine(this->Outgoing, incident);
  }
  return value;
}

float BSDF::Pdf(const glm::vec3& incident, Lobes lobes) const
{
  const float specular = this->GetSpecularProbability(lobes);
  float pdf = (1.0f - specular) * Lambert::Pdf(incident);
  if (specular > 0.0f)
  {
    pdf += specular * this->Specular.Pdf(this->Outgoing, incident);
  }
  return pdf;
}

bool BSDF::Sample(float lobe, const glm::vec2& u, BSDFSample& sample, Lobes lobes) const
{
  const float specular = this->GetSpecularProbability(lobes);
  sample.Compression = 1.0f;
  sample.Direction = Lambert::Sample(u);
  if (lobe < specular)
  {
    Facets::Choice choice;
    if (!this->Specular.Sample(this->Outgoing, lobe / specular, u, choice))
    {
      return false;
    }
    sample.Direction = choice.Direction;
    sample.Compression = choice.Direction.z < 0.0f ? this->Specular.GetCompression() : 1.0f;
    if (choice.IsSmooth)
    {
      sample.Weight = choice.Weight / specular;
      sample.Pdf = std::numeric_limits<float>::infinity();
      return true;
    }
  }
  sample.Pdf = this->Pdf(sample.Direction, lobes);
  if (!(sample.Pdf > 0.0f))
  {
    return false;
  }
  sample.Weight = this->EvaluateCosine(sample.Direction, lobes) / sample.Pdf;
  return true;
}
}
