// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reflection and refraction at the boundary of a surface, smooth or with microfacets.
 */
#ifndef cslfFacetLobe_h
#define cslfFacetLobe_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfLobe.h"
#include "cslfSurfaceMaterial.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

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
}

#endif
