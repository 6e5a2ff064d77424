// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The diffuse base of a surface under its boundary.
 */
#ifndef cslfDiffuseLobe_h
#define cslfDiffuseLobe_h

#include "cslfLambert.h"
#include "cslfLobe.h"
#include "cslfSurfaceMaterial.h"

namespace cslf
{
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
}

#endif
