// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A material in the tracer's form, with linear values and everything precomputed that depends only
 * on the material.
 */
#ifndef cslfSurfaceMaterial_h
#define cslfSurfaceMaterial_h

#include "vtkCSLFModule.h" // for export macro

#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace cslf
{
/// The share of the light that a dielectric's glossy boundary reflects: the BSDF's integral over
/// all incident directions, by the outgoing cosine.
class VTKCSLF_EXPORT SpecularAlbedo
{
public:
  /// A boundary that reflects nothing.
  SpecularAlbedo() = default;

  /// For one roughness. An `alpha` of 0 is a smooth boundary.
  SpecularAlbedo(float ior, float alpha);

  /// For any roughness, if a texture varies it.
  explicit SpecularAlbedo(float ior);

  float Get(float cosine, float alpha) const;

  /// The mean over the hemisphere, weighted by the cosine.
  float GetAverage(float alpha) const;

private:
  static constexpr int Steps = 32;          // between the cosines of 0 and 1
  static constexpr int RoughnessSteps = 24; // between the roughness of 0 and 1

  struct Row
  {
    std::array<float, Steps + 1> Values{};
    float Average = 0.0f;

    float Get(float cosine) const;
  };

  static Row MakeRow(float ior, float alpha);

  /// Calls `read(row)` for the rows around an alpha, and interpolates.
  template <typename Read>
  float Interpolate(float alpha, const Read& read) const;

  std::vector<Row> Rows; // empty, one row for the material, or one row per step of the roughness
};

/// The parameters that textures vary over a surface.
struct MaterialPoint
{
  glm::vec3 BaseColor{ 0.6f }; ///< linear
  float Metallic = 0.0f;       ///< in [0,1]
  float Alpha = 1.0f;          ///< GGX's; 0 is a perfect mirror
};

/// The sides on which triangles are visible.
enum class VisibleSides
{
  Both,
  Front, ///< the side where the corners run counterclockwise
  Back
};

class VTKCSLF_EXPORT SurfaceMaterial
{
public:
  SurfaceMaterial() = default;
  SurfaceMaterial(const glm::vec3& baseColor, float metallic, float roughness,
    float indexOfRefraction, const glm::vec3& emission);

  /// GGX's alpha of a perceptual roughness. 0 if the deviation of facets is invisible.
  static float ToAlpha(float roughness);

  glm::vec3 BaseColor{ 0.6f };    ///< linear
  float Metallic = 0.0f;          ///< in [0,1]
  float Roughness = 1.0f;         ///< perceptual, in [0,1]
  float Alpha = 1.0f;             ///< GGX's; 0 is a perfect mirror
  float IndexOfRefraction = 1.0f; ///< at least 1; with 1, the boundary reflects nothing
  float Transmission = 0.0f;      ///< the share of a dielectric that is glass, in [0,1]
  bool Thin = false;              ///< whether glass is a thin sheet, else solid
  float Opacity = 1.0f;           ///< the probability that light hits the surface, in [0,1]
  float OpacityCutoff = 0.0f;     ///< above 0: lower opacities count as 0, others as 1
  float NormalScale = 1.0f;       ///< how far the normal texture bends normals
  glm::vec3 Emission{ 0.0f };     ///< radiance, from all visible sides
  bool Unlit = false;             ///< whether it shows its base colour besides its emission
  VisibleSides Sides = VisibleSides::Both; ///< of triangles
  SpecularAlbedo DielectricSpecular; ///< of the boundary; for any roughness if a texture varies it

  /// Whether rays from the front, or the back, pass as if there were no surface.
  bool Hides(bool back) const
  {
    return this->Sides == (back ? VisibleSides::Front : VisibleSides::Back);
  }

  /// Whether it emits light. No component of an emission is negative.
  bool IsEmissive() const
  {
    return this->Unlit || this->Emission.x + this->Emission.y + this->Emission.z > 0.0f;
  }

  /// Whether it has only a diffuse base, which reflects equally in all directions.
  bool IsLambertian() const;

  /// Whether it has a diffuse base and a rough boundary alone.
  bool IsRoughDielectric() const;
};
}

#endif
