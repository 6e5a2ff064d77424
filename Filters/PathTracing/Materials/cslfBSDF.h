// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The metallic-roughness material with transmission: glTF 2.0, appendix B, and its extensions
 * KHR_materials_transmission and KHR_materials_ior, with layers that conserve energy.
 */
#ifndef cslfBSDF_h
#define cslfBSDF_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfLobe.h"
#include "cslfSurfaceMaterial.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <tuple>
#include <type_traits>

namespace cslf
{
/**
 * Facets of metal, of an opaque dielectric and of glass, in the proportions given by the material,
 * with GGX normals: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR
 * 2007. Directions are local and point away from the surface, z being the normal on the outgoing
 * direction's side; incident directions below the surface are those of refracted light.
 *
 * Radiance grows with the squared index of refraction of its medium, because its rays are
 * compressed into a smaller solid angle; this factor is called compression here. If the index is 1,
 * light goes straight through glass of any roughness.
 */
class VTKCSLF_EXPORT FacetLobe
{
public:
  static constexpr Lobes Kind = Lobes::Specular;

  static bool IsIn(const SurfaceMaterial& material)
  {
    return material.IndexOfRefraction != 1.0f || material.Metallic > 0.0f ||
      material.Transmission > 0.0f;
  }

  /// `inside` tells whether the outgoing direction lies behind the surface, in the glass.
  FacetLobe(const SurfaceMaterial& material, const MaterialPoint& point, const glm::vec3& outgoing,
    bool inside);

  bool IsSmooth() const
  {
    return this->Alpha == 0.0f || (this->Metallic == 0.0f && this->Index == 1.0f);
  }

  float GetImportance() const;

  /// BSDF times the cosine at the incident direction, without smooth parts.
  glm::vec3 EvaluateCosine(const glm::vec3& incident) const;

  /// The density with which Sample takes a direction, without smooth parts.
  float Pdf(const glm::vec3& incident) const;

  /// Chooses a facet by `u`, and whether it reflects or refracts by `which`. False if the direction
  /// lies on the wrong side.
  bool Sample(float which, const glm::vec2& u, LobeSample& sample) const;

private:
  float GlassFresnel(float cosine) const;
  glm::vec3 GetReflectance(float cosine) const { return this->GetReflectance(cosine, cosine); }
  glm::vec3 GetReflectance(float cosine, float glassCosine) const;
  glm::vec3 GetTransmittance(float cosine) const;
  float GetCompression() const { return this->Straight ? 1.0f : 1.0f / (this->Eta * this->Eta); }
  float ReflectionProbability(float cosine) const;
  float RefractionDensity(const glm::vec3& incident, float& cosine) const;
  glm::vec3 Refract(const glm::vec3& facet, float cosine) const;

  glm::vec3 Outgoing;
  glm::vec3 BaseColor;
  float Metallic;
  float Opaque; // the share of the opaque dielectric
  float Glass;  // the share of the glass
  float Index;  // of refraction, behind the surface
  float Eta;    // the index of the far side over that of the outgoing direction's
  float Alpha;  // GGX's
  bool Thin;
  bool Straight; // whether light goes through without refraction
};

/**
 * The base gets the light that the boundary transmits, (1 - E(out)) (1 - E(in)) / (1 - mean E) with
 * E the boundary's albedo: unlike glTF's example code, this never reflects more than it receives
 * (Kelemen and Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF Model", Eurographics
 * 2001 short papers).
 */
class DiffuseLobe
{
public:
  static constexpr Lobes Kind = Lobes::Diffuse;

  static bool IsIn(const SurfaceMaterial& material) { return material.Transmission < 1.0f; }

  DiffuseLobe(
    const SurfaceMaterial& material, const MaterialPoint& point, const glm::vec3& outgoing, bool)
    : Boundary(material.DielectricSpecular)
    , Alpha(point.Alpha)
    , IsLit(outgoing.z > 0.0f)
  {
    const float part = (1.0f - point.Metallic) * (1.0f - material.Transmission);
    const float transmitted = 1.0f - this->Boundary.Get(outgoing.z, point.Alpha);
    this->Albedo = point.BaseColor * (part * transmitted);
    this->Importance = part * Luminance(point.BaseColor) * transmitted;
  }

  /// The factor that does not depend on the incident direction.
  const glm::vec3& GetAlbedo() const { return this->Albedo; }

  /// The factor that depends on it: the boundary's transmission at an incident direction of this
  /// cosine, relative to the mean.
  float GetTransmission(float cosine) const
  {
    return (1.0f - this->Boundary.Get(cosine, this->Alpha)) /
      (1.0f - this->Boundary.GetAverage(this->Alpha));
  }

  bool IsSmooth() const { return false; }
  float GetImportance() const { return this->Importance; }

  glm::vec3 EvaluateCosine(const glm::vec3& incident) const
  {
    return this->IsLit && incident.z > 0.0f
      ? this->Albedo * (this->GetTransmission(incident.z) * Lambert::EvaluateCosine(incident))
      : glm::vec3(0.0f);
  }
  float Pdf(const glm::vec3& incident) const { return Lambert::Pdf(incident); }
  bool Sample(float, const glm::vec2& u, LobeSample& sample) const
  {
    sample.Direction = Lambert::Sample(u);
    return true;
  }

private:
  const SpecularAlbedo& Boundary;
  float Alpha;
  bool IsLit; // whether the outgoing direction is above the surface
  glm::vec3 Albedo;
  float Importance;
};

struct BSDFSample
{
  glm::vec3 Direction{ 0.0f }; ///< local
  glm::vec3 Weight{ 0.0f };    ///< BSDF times cosine, over the density
  float Pdf = 0.0f;            ///< per solid angle; infinite for a mirror's direction
  float Compression = 1.0f;    ///< the factor of the weight due to refraction
};

/**
 * How a surface point scatters light towards one outgoing direction. Directions are local: z is the
 * shading normal, both point away from the surface. The outgoing one must be above it. Incident
 * ones below are those of transmitted light.
 *
 * A metal of reflectance "base colour" and a dielectric are blended by "metallic", an opaque
 * dielectric and glass by "transmission". All have the same GGX facets. Light through glass is
 * tinted by the base colour. Under the opaque boundary lies a diffuse base.
 */
class VTKCSLF_EXPORT BSDF
{
public:
  /// All lobes, of which DiffuseLobe is the last. A new one is added here; see cslfLobe.h.
  using LobeList = std::tuple<FacetLobe, DiffuseLobe>;

  /// Whether surfaces of a material can have no other lobes than these.
  template <typename... Some>
  static bool ConsistsOf(const SurfaceMaterial& material)
  {
    return ConsistsOf<Some...>(material, static_cast<const LobeList*>(nullptr));
  }

  /// `inside` tells whether the outgoing direction lies behind the surface, in the glass.
  BSDF(const SurfaceMaterial& material, const MaterialPoint& point, const glm::vec3& outgoing,
    bool inside);

  bool Has(Lobes lobes) const { return this->GetProbability(lobes) > 0.0f; }

  /// The probability that Sample, for all lobes, takes one of these.
  float GetProbability(Lobes lobes) const;

  /// Whether no light from given directions is scattered, as by a pure mirror and by clear glass.
  bool IsMirror(Lobes lobes = Lobes::All) const;

  /// The diffuse lobe, which Has(Lobes::Diffuse) tells to be there.
  const DiffuseLobe& GetDiffuse() const { return std::get<DiffuseLobe>(this->Parts); }

  /// BSDF times the cosine at the incident direction, without a mirror's part.
  glm::vec3 EvaluateCosine(const glm::vec3& incident, Lobes lobes = Lobes::All) const;

  /// The density with which Sample takes a direction, without a mirror's part.
  float Pdf(const glm::vec3& incident, Lobes lobes = Lobes::All) const;

  /// Samples an incident direction; `lobe` in [0,1) chooses the lobe. False if the path ends.
  bool Sample(float lobe, const glm::vec2& u, BSDFSample& sample, Lobes lobes = Lobes::All) const;

private:
  template <typename Lobe, typename... Some>
  static constexpr bool IsOneOf = (std::is_same_v<Lobe, Some> || ...);

  template <typename... Some, typename... AllLobes>
  static bool ConsistsOf(const SurfaceMaterial& material, const std::tuple<AllLobes...>*)
  {
    return ((IsOneOf<AllLobes, Some...> || !AllLobes::IsIn(material)) && ...);
  }

  template <typename Visit>
  void ForEachLobe(Lobes lobes, const Visit& visit) const;

  LobeList Parts;
  std::array<float, std::tuple_size_v<LobeList>> Probabilities{}; // of taking each; 0 if absent
};
}

#endif
