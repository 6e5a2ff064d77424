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

#include "cslfFacets.h"
#include "cslfSurfaceMaterial.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace cslf
{
struct BSDFSample
{
  glm::vec3 Direction{ 0.0f }; ///< local
  glm::vec3 Weight{ 0.0f };    ///< BSDF times cosine, over the density
  float Pdf = 0.0f;            ///< per solid angle; infinite for a mirror's direction
  float Compression = 1.0f;    ///< the factor of the weight due to refraction
};

/// The parts of a BSDF that a function covers.
enum class Lobes
{
  All,
  Diffuse, ///< parts that look the same from all directions, except for BSDF::DiffuseAlbedo
  Specular ///< the facets: their reflection and transmission
};

/**
 * How a surface point scatters light towards one outgoing direction. Directions are local: z is the
 * shading normal, both point away from the surface. The outgoing one must be above it. Incident
 * ones below are those of transmitted light.
 *
 * A metal of reflectance "base colour" and a dielectric are blended by "metallic", an opaque
 * dielectric and glass by "transmission". All have the same GGX facets. Light through glass is
 * tinted by the base colour. Under the opaque boundary lies a diffuse base, which gets the light
 * that the boundary transmits, (1 - E(out)) (1 - E(in)) / (1 - mean E) with E the boundary's
 * albedo: unlike glTF's example code, this never reflects more than it receives (Kelemen and
 * Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF Model", Eurographics 2001 short
 * papers).
 */
class VTKCSLF_EXPORT BSDF
{
public:
  /// `inside` tells whether the outgoing direction lies behind the surface, in the glass.
  BSDF(const SurfaceMaterial& material, const MaterialPoint& point, const glm::vec3& outgoing,
    bool inside);

  /// For a material without varying textures, seen from outside.
  BSDF(const SurfaceMaterial& material, const glm::vec3& baseColor, const glm::vec3& outgoing)
    : BSDF(material, { baseColor, material.Metallic, material.Alpha }, outgoing, false)
  {
  }

  bool HasDiffuse() const { return this->SpecularProbability < 1.0f; }
  bool HasSpecular() const { return this->SpecularProbability > 0.0f; }
  bool Has(Lobes lobes) const
  {
    return lobes == Lobes::All ||
      (lobes == Lobes::Specular ? this->HasSpecular() : this->HasDiffuse());
  }

  /// The probability that Sample takes the specular lobe.
  float GetSpecularProbability(Lobes lobes) const
  {
    return lobes == Lobes::All ? this->SpecularProbability : lobes == Lobes::Specular ? 1.0f : 0.0f;
  }

  /// Whether light from given directions is scattered at all. False for a pure mirror and for clear
  /// glass.
  bool IsMirror(Lobes lobes = Lobes::All) const
  {
    return this->GetSpecularProbability(lobes) >= 1.0f && this->Specular.IsSmooth();
  }

  /// The factor of the diffuse lobe that does not depend on the incident direction.
  glm::vec3 DiffuseAlbedo() const;

  /// BSDF times the cosine at the incident direction, without a mirror's part.
  glm::vec3 EvaluateCosine(const glm::vec3& incident, Lobes lobes = Lobes::All) const;

  /// The density with which Sample takes a direction, without a mirror's part.
  float Pdf(const glm::vec3& incident, Lobes lobes = Lobes::All) const;

  /// Samples an incident direction. False if the path ends.
  bool Sample(float lobe, const glm::vec2& u, BSDFSample& sample, Lobes lobes = Lobes::All) const;

  /// The factor of the diffuse lobe that depends on it: the transmission at an incident direction
  /// of this cosine, relative to the mean.
  float DiffuseTransmission(float cosine) const;

private:
  const SurfaceMaterial& Material;
  MaterialPoint Point;
  glm::vec3 Outgoing;
  Facets Specular;
  float DiffusePart; // the part that is neither metal nor glass
  float SpecularProbability = 0.0f;
};
}

#endif
