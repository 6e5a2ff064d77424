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

#include "cslfDiffuseLobe.h"
#include "cslfFacetLobe.h"
#include "cslfLobe.h"
#include "cslfSurfaceMaterial.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <tuple>
#include <type_traits>

namespace cslf
{
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
