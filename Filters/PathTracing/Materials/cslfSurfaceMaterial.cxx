// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceMaterial.h"

#include "cslfBSDF.h"
#include "cslfGGX.h"

#include <algorithm>

namespace cslf
{
namespace
{
// With a smaller alpha, facets deviate from the normal by less than the precision of floats within
// a texel: the surface is a mirror.
constexpr float MinimumAlpha = 1e-3f;

// The reflected share of light that leaves at `cosine`: the mean of GGX's sample weights, F G2 /
// G1.
float IntegrateSpecular(float ior, const GGX& facets, float cosine)
{
  float sum = 0.0f;
  const int count =
    VisitReflections(ior, facets, cosine, [&](const glm::vec3&, float weight) { sum += weight; });
  return sum / static_cast<float>(count);
}
}

SpecularAlbedo::SpecularAlbedo(float ior, float alpha)
{
  if (ior > 1.0f)
  {
    this->Rows.push_back(MakeRow(ior, alpha));
  }
}

SpecularAlbedo::SpecularAlbedo(float ior)
{
  for (int i = 0; ior > 1.0f && i <= RoughnessSteps; ++i)
  {
    this->Rows.push_back(
      MakeRow(ior, SurfaceMaterial::ToAlpha(static_cast<float>(i) / RoughnessSteps)));
  }
}

SpecularAlbedo::Row SpecularAlbedo::MakeRow(float ior, float alpha)
{
  Row row;
  const GGX facets(alpha);
  for (int i = 0; i <= Steps; ++i)
  {
    const float cosine = std::max(1e-3f, static_cast<float>(i) / Steps);
    row.Values[i] =
      alpha > 0.0f ? IntegrateSpecular(ior, facets, cosine) : DielectricFresnel(cosine, ior);
  }
  // The integral of 2 E(c) c dc. Simpson's rule is exact, because Get is linear in each step.
  float sum = 0.0f;
  for (int i = 0; i < Steps; ++i)
  {
    const auto lower = static_cast<float>(i);
    const float middle = 0.5f * (row.Values[i] + row.Values[i + 1]);
    sum +=
      lower * row.Values[i] + 4.0f * (lower + 0.5f) * middle + (lower + 1.0f) * row.Values[i + 1];
  }
  row.Average = std::min(sum / (3.0f * Steps * Steps), 0.999f);
  return row;
}

float SpecularAlbedo::Row::Get(float cosine) const
{
  const float position = std::clamp(cosine, 0.0f, 1.0f) * Steps;
  const int lower = std::min(static_cast<int>(position), Steps - 1);
  const float weight = position - static_cast<float>(lower);
  return (1.0f - weight) * this->Values[lower] + weight * this->Values[lower + 1];
}

template <typename Read>
float SpecularAlbedo::Interpolate(float alpha, const Read& read) const
{
  if (this->Rows.size() < 2)
  {
    return this->Rows.empty() ? 0.0f : read(this->Rows[0]);
  }
  const float position = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * RoughnessSteps;
  const int lower = std::min(static_cast<int>(position), RoughnessSteps - 1);
  const float weight = position - static_cast<float>(lower);
  return (1.0f - weight) * read(this->Rows[lower]) + weight * read(this->Rows[lower + 1]);
}

float SpecularAlbedo::Get(float cosine, float alpha) const
{
  return this->Interpolate(alpha, [cosine](const Row& row) { return row.Get(cosine); });
}

float SpecularAlbedo::GetAverage(float alpha) const
{
  return this->Interpolate(alpha, [](const Row& row) { return row.Average; });
}

float SurfaceMaterial::ToAlpha(float roughness)
{
  const float clamped = std::clamp(roughness, 0.0f, 1.0f);
  const float alpha = clamped * clamped;
  return alpha < MinimumAlpha ? 0.0f : alpha;
}

SurfaceMaterial::SurfaceMaterial(const glm::vec3& baseColor, float metallic, float roughness,
  float indexOfRefraction, const glm::vec3& emission)
  : BaseColor(glm::clamp(baseColor, 0.0f, 1.0f))
  , Metallic(std::clamp(metallic, 0.0f, 1.0f))
  , Roughness(std::clamp(roughness, 0.0f, 1.0f))
  , Alpha(ToAlpha(roughness))
  , IndexOfRefraction(std::max(indexOfRefraction, 1.0f))
  , Emission(glm::max(emission, glm::vec3(0.0f)))
{
  this->DielectricSpecular = SpecularAlbedo(this->IndexOfRefraction, this->Alpha);
}

bool SurfaceMaterial::IsLambertian() const
{
  return BSDF::ConsistsOf<DiffuseLobe>(*this);
}

bool SurfaceMaterial::IsRoughDielectric() const
{
  return BSDF::ConsistsOf<DiffuseLobe, FacetLobe>(*this) && this->IndexOfRefraction > 1.0f &&
    this->Alpha > 0.0f && this->Metallic == 0.0f && this->Transmission == 0.0f;
}
}
