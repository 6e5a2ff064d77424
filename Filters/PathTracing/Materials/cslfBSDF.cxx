// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBSDF.h"
#include "cslfGGX.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslf
{
namespace
{
// Light through glass with an index closer to 1 than this is refracted by less than a degree at
// most angles.
constexpr float MinimumContrast = 1e-2f;

/// Whether facets reflect in this direction. Otherwise they refract.
bool IsReflected(const glm::vec3& incident)
{
  return incident.z > 0.0f;
}
}

FacetLobe::FacetLobe(const SurfaceMaterial& material, const MaterialPoint& point,
  const glm::vec3& outgoing, bool inside)
  : Outgoing(outgoing)
  , BaseColor(point.BaseColor)
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
  if (std::abs(this->Eta - 1.0f) < MinimumContrast)
  {
    this->Eta = 1.0f;
  }
  this->Straight = this->Thin || this->Eta == 1.0f;
}

float FacetLobe::GetImportance() const
{
  if (this->Opaque == 1.0f && this->Index == 1.0f)
  {
    return 0.0f;
  }
  return Luminance(
    this->GetReflectance(this->Outgoing.z) + this->GetTransmittance(this->Outgoing.z));
}

/// The reflection of glass. In a thin sheet, light goes back and forth between its boundaries.
float FacetLobe::GlassFresnel(float cosine) const
{
  const float fresnel = DielectricFresnel(cosine, this->Eta);
  return this->Thin ? 2.0f * fresnel / (1.0f + fresnel) : fresnel;
}

/// The reflection of a facet at an angle acos(`cosine`) to its normal.
glm::vec3 FacetLobe::GetReflectance(float cosine, float glassCosine) const
{
  return this->Metallic * SchlickFresnel(cosine, this->BaseColor) +
    glm::vec3(this->Opaque * DielectricFresnel(cosine, this->Index) +
      (this->Glass > 0.0f ? this->Glass * this->GlassFresnel(glassCosine) : 0.0f));
}

/// The transmission of a facet, without the compression.
glm::vec3 FacetLobe::GetTransmittance(float cosine) const
{
  return this->Glass > 0.0f ? this->Glass * (1.0f - this->GlassFresnel(cosine)) * this->BaseColor
                            : glm::vec3(0.0f);
}

float FacetLobe::ReflectionProbability(float cosine) const
{
  const float transmitted = Luminance(this->GetTransmittance(cosine));
  if (transmitted == 0.0f)
  {
    return 1.0f;
  }
  const float reflected = Luminance(this->GetReflectance(cosine));
  return reflected / (reflected + transmitted);
}

glm::vec3 FacetLobe::EvaluateCosine(const glm::vec3& incident) const
{
  if (this->Alpha == 0.0f || !(this->Outgoing.z > 0.0f))
  {
    return glm::vec3(0.0f);
  }
  if (IsReflected(incident))
  {
    const float cosine = glm::dot(this->Outgoing, glm::normalize(this->Outgoing + incident));
    // Light that goes straight on meets no facets, so the angle determines their reflection.
    return this->GetReflectance(cosine, this->Straight ? this->Outgoing.z : cosine) *
      GGX(this->Alpha).EvaluateCosine(this->Outgoing, incident);
  }
  if (this->Glass == 0.0f || this->Straight)
  {
    return glm::vec3(0.0f);
  }
  // Masking and shadowing on opposite sides are assumed to be independent, as in Walter et al.
  float cosine = 0.0f;
  const float density = this->RefractionDensity(incident, cosine);
  return this->GetTransmittance(cosine) *
    (density * GGX(this->Alpha).Masking(incident) * this->GetCompression());
}

float FacetLobe::Pdf(const glm::vec3& incident) const
{
  if (this->Alpha == 0.0f || !(this->Outgoing.z > 0.0f))
  {
    return 0.0f;
  }
  if (IsReflected(incident))
  {
    const float cosine = this->Straight
      ? this->Outgoing.z
      : glm::dot(this->Outgoing, glm::normalize(this->Outgoing + incident));
    return this->ReflectionProbability(cosine) * GGX(this->Alpha).Pdf(this->Outgoing, incident);
  }
  if (this->Glass == 0.0f || this->Straight)
  {
    return 0.0f;
  }
  float cosine = 0.0f;
  const float density = this->RefractionDensity(incident, cosine);
  return (1.0f - this->ReflectionProbability(cosine)) * density;
}

/// The density of the directions to which visible facets refract, and the cosine at the facet:
/// Walter et al., equation 17.
float FacetLobe::RefractionDensity(const glm::vec3& incident, float& cosine) const
{
  const glm::vec3 sum = this->Outgoing + this->Eta * incident;
  glm::vec3 facet = glm::normalize(sum);
  facet = facet.z < 0.0f ? -facet : facet;
  cosine = glm::dot(this->Outgoing, facet);
  const float cosFar = glm::dot(incident, facet);
  if (!(cosine > 0.0f) || !(cosFar < 0.0f))
  {
    return 0.0f;
  }
  const float jacobian = this->Eta * this->Eta * -cosFar / glm::dot(sum, sum);
  return jacobian * GGX(this->Alpha).VisibleDensity(this->Outgoing, facet);
}

bool FacetLobe::Sample(float which, const glm::vec2& u, LobeSample& sample) const
{
  glm::vec3 facet(0.0f, 0.0f, 1.0f);
  if (this->Alpha > 0.0f)
  {
    facet = GGX(this->Alpha).SampleFacet(this->Outgoing, u);
  }
  const float cosine = glm::dot(this->Outgoing, facet);
  const float chooseBy = this->Straight ? this->Outgoing.z : cosine;
  const float probability = this->ReflectionProbability(chooseBy);
  if (probability >= 1.0f || which < probability)
  {
    sample.Direction = 2.0f * cosine * facet - this->Outgoing;
    sample.IsSmooth = this->Alpha == 0.0f;
    sample.Weight = this->GetReflectance(chooseBy) / probability;
    return sample.Direction.z > 0.0f;
  }
  sample.IsSmooth = this->Alpha == 0.0f || this->Straight;
  sample.Compression = this->GetCompression();
  sample.Direction = this->Straight ? -this->Outgoing : this->Refract(facet, cosine);
  sample.Weight =
    this->GetTransmittance(chooseBy) * (this->GetCompression() / (1.0f - probability));
  return sample.Direction.z < 0.0f;
}

glm::vec3 FacetLobe::Refract(const glm::vec3& facet, float cosine) const
{
  const float sine2 = (1.0f - cosine * cosine) / (this->Eta * this->Eta);
  const float cosFar = std::sqrt(std::max(0.0f, 1.0f - sine2));
  return glm::normalize((cosine / this->Eta - cosFar) * facet - this->Outgoing / this->Eta);
}

namespace
{
// No lobe that reflects anything is taken less often than this, of it and those after it.
constexpr float MinimumProbability = 0.1f;

template <typename... AllLobes>
std::tuple<AllLobes...> MakeLobes(const std::tuple<AllLobes...>*, const SurfaceMaterial& material,
  const MaterialPoint& point, const glm::vec3& outgoing, bool inside)
{
  return { AllLobes(material, point, outgoing, inside)... };
}
}

BSDF::BSDF(const SurfaceMaterial& material, const MaterialPoint& point, const glm::vec3& outgoing,
  bool inside)
  : Parts(MakeLobes(static_cast<const LobeList*>(nullptr), material, point, outgoing, inside))
{
  const auto importances = std::apply(
    [](const auto&... part) { return std::array{ part.GetImportance()... }; }, this->Parts);
  float rest = 1.0f; // of the probability
  for (std::size_t i = 0; i < importances.size(); ++i)
  {
    float others = 0.0f;
    std::for_each(importances.begin() + i + 1, importances.end(),
      [&others](float importance) { others += importance; });
    float share = importances[i] > 0.0f ? 1.0f : 0.0f;
    if (others > 0.0f && importances[i] > 0.0f)
    {
      share = std::clamp(
        importances[i] / (importances[i] + others), MinimumProbability, 1.0f - MinimumProbability);
    }
    this->Probabilities[i] = rest * share;
    rest -= this->Probabilities[i];
  }
}

/// Calls `visit(lobe, probability)` for the lobes that exist, with the probability of taking each
/// among these.
template <typename Visit>
void BSDF::ForEachLobe(Lobes lobes, const Visit& visit) const
{
  const float all = lobes == Lobes::All ? 1.0f : this->GetProbability(lobes);
  std::size_t i = 0;
  const auto visitOne = [&](const auto& part)
  {
    const float probability = this->Probabilities[i++];
    if (probability > 0.0f && (lobes == Lobes::All || lobes == part.Kind))
    {
      visit(part, probability / all);
    }
  };
  std::apply([&](const auto&... part) { (visitOne(part), ...); }, this->Parts);
}

float BSDF::GetProbability(Lobes lobes) const
{
  float sum = 0.0f;
  std::size_t i = 0;
  const auto add = [&](const auto& part)
  {
    sum += lobes == Lobes::All || lobes == part.Kind ? this->Probabilities[i] : 0.0f;
    ++i;
  };
  std::apply([&](const auto&... part) { (add(part), ...); }, this->Parts);
  return sum;
}

bool BSDF::IsMirror(Lobes lobes) const
{
  bool isMirror = true;
  this->ForEachLobe(
    lobes, [&isMirror](const auto& part, float) { isMirror = isMirror && part.IsSmooth(); });
  return isMirror;
}

glm::vec3 BSDF::EvaluateCosine(const glm::vec3& incident, Lobes lobes) const
{
  glm::vec3 value(0.0f);
  this->ForEachLobe(
    lobes, [&](const auto& part, float) { value += part.EvaluateCosine(incident); });
  return value;
}

float BSDF::Pdf(const glm::vec3& incident, Lobes lobes) const
{
  float pdf = 0.0f;
  this->ForEachLobe(
    lobes, [&](const auto& part, float probability) { pdf += probability * part.Pdf(incident); });
  return pdf;
}

bool BSDF::Sample(float lobe, const glm::vec2& u, BSDFSample& sample, Lobes lobes) const
{
  // Choose a lobe, and use the rest of the number within it.
  LobeSample chosen;
  float taken = 0.0f; // the probability of the lobe
  float end = 0.0f;
  bool isValid = false;
  this->ForEachLobe(lobes,
    [&](const auto& part, float probability)
    {
      const float begin = end;
      end += probability;
      if (taken == 0.0f && lobe < end)
      {
        taken = probability;
        isValid = part.Sample((lobe - begin) / probability, u, chosen);
      }
    });
  if (!isValid)
  {
    return false;
  }
  sample.Direction = chosen.Direction;
  sample.Compression = chosen.Compression;
  if (chosen.IsSmooth)
  {
    sample.Weight = chosen.Weight / taken;
    sample.Pdf = std::numeric_limits<float>::infinity();
    return true;
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
