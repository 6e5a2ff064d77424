// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reflection and refraction at the boundary of a surface, smooth or with microfacets.
 */
#ifndef cslfFacets_h
#define cslfFacets_h

#include "vtkCSLFModule.h" // for export macro

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
class VTKCSLF_EXPORT Facets
{
public:
  struct Choice
  {
    glm::vec3 Direction{ 0.0f };
    bool IsSmooth = false;    ///< whether no other direction was possible
    glm::vec3 Weight{ 0.0f }; ///< if smooth: BSDF times cosine, over the probability
  };

  /// `inside` tells whether the outgoing direction lies behind the surface, in the glass.
  Facets(const SurfaceMaterial& material, const MaterialPoint& point, bool inside);

  /// Whether nothing is scattered: light continues in one or two directions.
  bool IsSmooth() const
  {
    return this->Alpha == 0.0f || (this->Metallic == 0.0f && this->Index == 1.0f);
  }

  /// The reflection of a facet at an angle acos(`cosine`) to its normal.
  glm::vec3 GetReflectance(float cosine) const { return this->GetReflectance(cosine, cosine); }

  /// The transmission of a facet, without the compression.
  glm::vec3 GetTransmittance(float cosine) const;

  /// The factor of radiance that comes through from the far side.
  float GetCompression() const { return this->Straight ? 1.0f : 1.0f / (this->Eta * this->Eta); }

  /// BSDF times the cosine at the incident direction, without smooth parts.
  glm::vec3 EvaluateCosine(const glm::vec3& outgoing, const glm::vec3& incident) const;

  /// The density with which Sample takes a direction, without smooth parts.
  float Pdf(const glm::vec3& outgoing, const glm::vec3& incident) const;

  /// Chooses a facet by `u`, and whether it reflects or refracts by `which`. False if the direction
  /// lies on the wrong side.
  bool Sample(const glm::vec3& outgoing, float which, const glm::vec2& u, Choice& choice) const;

private:
  float GlassFresnel(float cosine) const;
  glm::vec3 GetReflectance(float cosine, float glassCosine) const;
  float ReflectionProbability(float cosine) const;
  float RefractionDensity(
    const glm::vec3& outgoing, const glm::vec3& incident, float& cosine) const;
  glm::vec3 Refract(const glm::vec3& outgoing, const glm::vec3& facet, float cosine) const;

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
