// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceAppearance.h"

#include "PathTracing/Materials/cslfSurfaceMaterial.h"
#include "cslfColor.h"

#include <vtkMath.h>
#include <vtkProperty.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
// Light that is less than 1 only by an error of rounding.
constexpr double Rounding = 1e-6;

// The largest share of a surface for the boundary or metal of a highlight. Broader highlights
// become a brighter diffuse base.
constexpr double MaximumReflectance = 0.2;
constexpr double MaximumMetallic = 0.3;

// VTK encodes physically based shading with this exponent.
constexpr double PhysicalGamma = 2.2;

/// The index of refraction of a boundary with this reflectance at normal incidence.
double ToIndexOfRefraction(double reflectance)
{
  const double root = std::sqrt(reflectance);
  return (1.0 + root) / (1.0 - root);
}

/// The non-negative factors of a colour and of white whose sum is closest to a target for all
/// colours that were added.
class ColorAndWhite
{
public:
  void Add(const glm::dvec3& target, const glm::dvec3& color)
  {
    const glm::dvec3 white(1.0);
    this->Count += 3.0;
    this->Colors += glm::dot(color, color);
    this->Both += glm::dot(color, white);
    this->Target += glm::dot(target, white);
    this->TargetColors += glm::dot(target, color);
  }

  std::pair<double, double> Fit() const
  {
    const double determinant = this->Count * this->Colors - this->Both * this->Both;
    if (determinant > 1e-9 * this->Colors)
    {
      const double ofColor =
        (this->Count * this->TargetColors - this->Both * this->Target) / determinant;
      const double ofWhite =
        (this->Colors * this->Target - this->Both * this->TargetColors) / determinant;
      if (ofColor >= 0.0 && ofWhite >= 0.0)
      {
        return { ofColor, ofWhite };
      }
      if (ofColor > 0.0)
      {
        return { this->TargetColors / this->Colors, 0.0 };
      }
    }
    return { 0.0, this->Count > 0.0 ? this->Target / this->Count : 0.0 };
  }

private:
  double Count = 0.0;
  double Colors = 0.0;
  double Both = 0.0;
  double Target = 0.0;
  double TargetColors = 0.0;
};

/// The squared alpha of GGX facets with the same width at half height as a highlight by a power of
/// the cosine between reflection and view. That angle is twice the angle of the facet's normal, and
/// 1 + tan^2 / alpha^2 is the square root of 2 there.
double ToSquaredAlpha(double power)
{
  const double cosine = std::exp2(-1.0 / std::max(power, 1e-3));
  const double squaredTangent = (1.0 - cosine) / (1.0 + cosine);
  return std::clamp(squaredTangent / (std::sqrt(2.0) - 1.0), 1e-6, 1.0);
}
}

SurfaceAppearance::SurfaceAppearance(vtkProperty* property, const LightLevel& level,
  Drawing drawing, const std::vector<glm::dvec3>& typical)
  : Property(property)
  , Level(level)
  , Kind(drawing)
  , IsPhysical(drawing == Drawing::Lit && property->GetInterpolation() == VTK_PBR)
{
  if (drawing != Drawing::Lit)
  {
    return;
  }
  if (this->IsPhysical)
  {
    this->FindPhysical(typical);
  }
  else if (property->GetSpecular() > 0.0)
  {
    this->FindHighlight(typical);
  }
}

void SurfaceAppearance::FindPhysical(const std::vector<glm::dvec3>& typical)
{
  this->Roughness = this->Property->GetRoughness();
  const double ior = std::max(this->Property->GetBaseIOR(), 1.0);
  this->WindowReflectance = std::pow((ior - 1.0) / (ior + 1.0), 2.0);

  // Metal and diffuse base have the same colour here, but not in the window: the share of metal is
  // its share of the light that both reflect.
  const double metallic = this->Property->GetMetallic();
  double metal = 0.0;
  double base = 0.0;
  for (const glm::dvec3& color : typical)
  {
    metal += metallic * this->Property->GetDiffuse() * glm::length(color);
    base += glm::length(glm::dvec3(this->GetPhysicalDiffuse(color.x),
      this->GetPhysicalDiffuse(color.y), this->GetPhysicalDiffuse(color.z)));
  }
  this->Metallic = metallic;
  double boundary = this->WindowReflectance;
  if (metallic < 1.0 && base > 0.0 && !this->HasMetallicTexture())
  {
    this->Metallic = metal / (metal + base);
    boundary *= (1.0 - metallic) / (1.0 - this->Metallic);
  }
  this->IndexOfRefraction = ToIndexOfRefraction(std::min(this->GetPhysicalLevel() * boundary, 0.9));
  this->UpdateResponse();
}

bool SurfaceAppearance::HasMetallicTexture() const
{
  return this->Property->GetTexture("materialTex") != nullptr;
}

double SurfaceAppearance::GetPhysicalDiffuse(double color) const
{
  // VTK's diffuse base gets the light that neither the boundary nor the metal mirrors.
  const double albedo = this->Property->GetDiffuse() * color;
  const double metallic = this->Property->GetMetallic();
  const double mirrored =
    glm::mix(this->WindowReflectance, albedo, this->HasMetallicTexture() ? 0.0 : metallic);
  return (1.0 - metallic) * (1.0 - mirrored) * albedo;
}

void SurfaceAppearance::UpdateResponse()
{
  const auto ior = static_cast<float>(this->IndexOfRefraction);
  const float alpha = SurfaceMaterial::ToAlpha(static_cast<float>(this->Roughness));
  const SpecularAlbedo albedo(ior, alpha);
  const double above = albedo.Get(1.0f, alpha);
  const double part = 1.0 - this->Metallic;
  this->Reflects.Diffuse = part * (1.0 - above) * (1.0 - above) / (1.0 - albedo.GetAverage(alpha));
  this->Reflects.Base = part * (1.0 - above) + this->Metallic;
  this->Reflects.Boundary = part * above;
}

void SurfaceAppearance::FindHighlight(const std::vector<glm::dvec3>& typical)
{
  // The height above the surroundings, as far as it can be displayed.
  const auto& window = this->Level.Window;
  ColorAndWhite parts;
  glm::dvec3 diffuse(0.0);
  for (const glm::dvec3& color : typical)
  {
    const glm::dvec3 base =
      glm::min(color * (this->Property->GetAmbient() + this->Property->GetDiffuse() * window), 1.0);
    const glm::dvec3 top = glm::min(base +
        this->Property->GetSpecular() * glm::make_vec3(this->Property->GetSpecularColor()) * window,
      1.0);
    const glm::dvec3 reflected =
      SRGBToLinear(base) - SRGBToLinear(this->Property->GetAmbient() * color);
    parts.Add(SRGBToLinear(top) - SRGBToLinear(base), reflected);
    diffuse += reflected / static_cast<double>(typical.size());
  }
  const double light = glm::dot(LuminanceWeights, this->Level.Direct + this->Level.Around);
  if (!(light > 0.0))
  {
    return;
  }

  // At normal incidence, a boundary reflects F0 / (4 alpha^2), relative to a white diffuse surface,
  // and a metal its base colour instead of F0.
  const auto [ofColor, ofWhite] = parts.Fit();
  const double squaredAlpha = ToSquaredAlpha(this->Property->GetSpecularPower());
  const double ratio = 4.0 * squaredAlpha * ofColor;
  this->Metallic = std::min(ratio / (1.0 + ratio), MaximumMetallic);
  const double part = 1.0 - this->Metallic;
  const double reflectance =
    std::min(4.0 * squaredAlpha * ofWhite / (light * part), MaximumReflectance);
  this->Roughness = std::sqrt(std::sqrt(squaredAlpha));
  this->IndexOfRefraction = ToIndexOfRefraction(reflectance);
  this->UpdateResponse();

  // The missing height.
  const double metal = this->Metallic / (part * 4.0 * squaredAlpha);
  const double white = light * part * reflectance / (4.0 * squaredAlpha);
  this->Rest = (ofColor - metal) * diffuse + ofWhite - white;
}

double SurfaceAppearance::GetClassicReflectance(int channel, double ambient, double diffuse) const
{
  const double emitted = this->Property->GetAmbient() * ambient;
  const double reflected = this->Property->GetDiffuse() * diffuse;
  const double direct = this->Level.Direct[channel];
  const double around = this->Level.Around[channel];
  if (!(direct + around > 0.0))
  {
    return SRGBToLinear(reflected);
  }
  if (this->Kind == Drawing::Unlit)
  {
    return SRGBToLinear(emitted + reflected) / (direct + around);
  }
  const double missing = SRGBToLinear(emitted + reflected * this->Level.Window[channel]) -
    SRGBToLinear(emitted) + this->Rest[channel];
  return (missing - around * this->Reflects.Boundary) /
    (direct * this->Reflects.Diffuse + around * this->Reflects.Base);
}

double SurfaceAppearance::GetPhysicalLevel() const
{
  const double window = glm::dot(LuminanceWeights, this->Level.Window) / vtkMath::Pi();
  const double traced = glm::dot(LuminanceWeights, this->Level.Direct + this->Level.Around);
  return window > 0.0 && traced > 0.0 ? window / traced : 1.0;
}

double SurfaceAppearance::GetPhysicalReflectance(int channel, double color) const
{
  const double albedo = this->Property->GetDiffuse() * color;
  const double window = this->Level.Window[channel] / vtkMath::Pi();
  const double traced = this->Level.Direct[channel] + this->Level.Around[channel];
  // The colour with which both diffuse base and metal are closest to the window.
  const double own = this->Reflects.Diffuse;
  const double metal = this->Property->GetMetallic() * albedo;
  const double base = (own * this->GetPhysicalDiffuse(color) + this->Metallic * metal) /
    (own * own + this->Metallic * this->Metallic);
  const double level = traced > 0.0 && window > 0.0 ? window / traced : 1.0;
  return level * this->MakeUpForGamma(base, window > 0.0 ? window : 1.0);
}

double SurfaceAppearance::MakeUpForGamma(double base, double window) const
{
  // The parts of the light at normal incidence: a diffuse base, a metal in its highlight, whose
  // height is F0 / (4 alpha^2), and the highlight of a rough boundary.
  const double part = 1.0 - this->Metallic;
  const double squaredAlpha = std::max(std::pow(this->Roughness, 4.0), 1e-6);
  double colored = this->Reflects.Diffuse + this->Metallic / (4.0 * squaredAlpha);
  double white = 0.25 * part * this->WindowReflectance;
  if (window * (colored * base + white) >= 1.0)
  {
    // The highlight has the maximum brightness; the base determines its surroundings.
    colored = this->Reflects.Diffuse;
    white = 0.0;
  }
  const double linear = window * (colored * base + white);
  return colored > 0.0 && linear < 1.0
    ? (SRGBToLinear(std::pow(linear, 1.0 / PhysicalGamma)) / window - white) / colored
    : base;
}

glm::dvec3 SurfaceAppearance::GetReflectance(
  const glm::dvec3& ambient, const glm::dvec3& diffuse) const
{
  glm::dvec3 reflectance(0.0);
  for (int i = 0; this->Kind != Drawing::Illuminating && i < 3; ++i)
  {
    const double value = this->IsPhysical ? this->GetPhysicalReflectance(i, diffuse[i])
                                          : this->GetClassicReflectance(i, ambient[i], diffuse[i]);
    reflectance[i] = std::clamp(value, 0.0, 1.0);
  }
  return reflectance;
}

glm::dvec3 SurfaceAppearance::GetBaseColor(
  const glm::dvec3& ambient, const glm::dvec3& diffuse) const
{
  constexpr double precision = 1e12; // the error of encoding and decoding is smaller
  const glm::dvec3 color = LinearToSRGB(this->GetReflectance(ambient, diffuse));
  return glm::round(color * precision) / precision;
}

bool SurfaceAppearance::IsEmissive() const
{
  switch (this->Kind)
  {
    case Drawing::Illuminating:
      return true;
    case Drawing::Unlit:
      return glm::any(
        glm::lessThan(this->Level.Direct + this->Level.Around, glm::dvec3(1.0 - Rounding)));
    default:
      return !this->IsPhysical && this->Property->GetAmbient() > 0.0;
  }
}

glm::dvec3 SurfaceAppearance::GetEmission(
  const glm::dvec3& ambient, const glm::dvec3& diffuse) const
{
  if (!this->IsEmissive())
  {
    return glm::dvec3(0.0);
  }
  const double reflected = this->Kind != Drawing::Lit ? this->Property->GetDiffuse() : 0.0;
  const glm::dvec3 color =
    SRGBToLinear(this->Property->GetAmbient() * ambient + reflected * diffuse);
  // A reflectance of 1 is not enough for colours that are brighter than the light.
  return this->Kind == Drawing::Unlit
    ? glm::max(color - this->Level.Direct - this->Level.Around, 0.0)
    : color;
}
}
