// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts the appearance of a surface in VTK's window to a material.
 */
#ifndef cslfSurfaceAppearance_h
#define cslfSurfaceAppearance_h

#include "cslfWindowLights.h"

#include <glm/vec3.hpp>

#include <vector>

class vtkProperty;

namespace cslf
{
/// The window's parameters of a surface.
enum class Drawing
{
  Lit,
  Unlit,       ///< shown with its colours only, like lines and points without normals
  Illuminating ///< likewise, because the property has no lighting: it is emissive
};

/**
 * The material whose traced colour is what the window displays for a surface that faces light of a
 * given level. `color` is that of the property, or of the scalars or texture that replace it.
 *
 * VTK's classic shading displays ambient + diffuse * light. The ambient term becomes the emission
 * whose colour is displayed alone, and the diffuse reflectance adds the rest of the sum.
 * Highlights, cosines to a power, become microfacets of the same height and width at half the
 * height: white ones from a dielectric boundary, coloured ones from a metallic factor.
 *
 * Physically based shading is linear and encoded by an exponent of 2.2 instead of sRGB's curve. Its
 * diffuse base receives the light left by one boundary and the metal; here the metal takes none of
 * it. Reflectances compensate for both differences, and so does a metallic factor between 0 and 1.
 */
class SurfaceAppearance
{
public:
  /// `typical` are colours of the surface, to which highlights and the metallic factor are fitted.
  SurfaceAppearance(vtkProperty* property, const LightLevel& level, Drawing drawing,
    const std::vector<glm::dvec3>& typical);

  /// The linear reflectance, in [0,1]. Ambient and diffuse colours differ only in properties.
  glm::dvec3 GetReflectance(const glm::dvec3& ambient, const glm::dvec3& diffuse) const;
  glm::dvec3 GetReflectance(const glm::dvec3& color) const
  {
    return this->GetReflectance(color, color);
  }

  /// The same, sRGB-encoded. Colours that do not change keep all bits.
  glm::dvec3 GetBaseColor(const glm::dvec3& ambient, const glm::dvec3& diffuse) const;

  /// The radiance.
  glm::dvec3 GetEmission(const glm::dvec3& ambient, const glm::dvec3& diffuse) const;
  glm::dvec3 GetEmission(const glm::dvec3& color) const { return this->GetEmission(color, color); }

  /// Whether GetEmission can be above 0.
  bool IsEmissive() const;

  double GetMetallic() const { return this->Metallic; }
  double GetRoughness() const { return this->Roughness; }
  double GetIndexOfRefraction() const { return this->IndexOfRefraction; }

private:
  /// The shares of their incident light that boundary, metal and diffuse base reflect.
  struct Response
  {
    double Diffuse = 1.0; ///< of directional light, by the diffuse base, divided by the reflectance
    double Base = 1.0;    ///< of light from all around, by everything multiplied by the reflectance
    double Boundary = 0.0; ///< of light from all around, by the boundary
  };

  void FindPhysical(const std::vector<glm::dvec3>& typical);
  void FindHighlight(const std::vector<glm::dvec3>& typical);
  void UpdateResponse();
  double GetClassicReflectance(int channel, double ambient, double diffuse) const;
  double GetPhysicalLevel() const;
  double GetPhysicalReflectance(int channel, double color) const;

  /// The share that the window's diffuse base reflects on a surface of a colour.
  double GetPhysicalDiffuse(double color) const;

  /// Whether the metallic factor varies over the surface.
  bool HasMetallicTexture() const;

  /// The base colour that sRGB's curve displays like VTK's exponent displays another one.
  double MakeUpForGamma(double base, double window) const;

  vtkProperty* Property;
  LightLevel Level;
  Drawing Kind;
  bool IsPhysical;
  double Metallic = 0.0;
  double Roughness = 1.0;
  double IndexOfRefraction = 1.0;
  double WindowReflectance = 0.0; // of the boundary in the window, at normal incidence
  Response Reflects;
  glm::dvec3 Rest{ 0.0 }; // of highlights that are too broad, as radiance of the diffuse base
};
}

#endif
