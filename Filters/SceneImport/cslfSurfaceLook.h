// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From what VTK's window shows of a surface to a material of light transport.
 */
#ifndef cslfSurfaceLook_h
#define cslfSurfaceLook_h

#include "cslfWindowLights.h"

#include <glm/vec3.hpp>

#include <vector>

class vtkProperty;

namespace cslf
{
/// How the window draws a surface.
enum class Drawing
{
  Lit,
  Unlit,       ///< by its colours alone, as lines and points without normals are
  Illuminating ///< likewise, since the property has no lighting: it shines by itself
};

/**
 * The material whose traced colour is what the window displays of a surface in a level of light,
 * where it faces the light. `color` is the property's, or what replaces it: scalars, a texture.
 *
 * VTK's classic shading displays ambient + diffuse * light. The ambient term becomes the emission
 * whose colour is displayed alone, and the diffuse reflectance yields what is missing to the sum.
 * Highlights, cosines to a power, become microfacets of the width at half the height, and of the
 * height: white ones by a dielectric boundary, coloured ones by a part of metal.
 *
 * Physically based shading is linear and encoded by a power of 2.2, in place of sRGB's curve. Its
 * diffuse base gets what is left by one boundary and by the part of metal, which here takes none
 * of it. Reflectances make up for these, and so does the part of metal where it is neither 0 nor 1.
 */
class SurfaceLook
{
public:
  /// `typical` are colours of the surface, for which highlights and parts of metal are made.
  SurfaceLook(vtkProperty* property, const LightLevel& level, Drawing drawing,
    const std::vector<glm::dvec3>& typical);

  /// The reflectance, linear, in [0,1]. Ambient and diffuse colours differ in properties alone.
  glm::dvec3 GetReflectance(const glm::dvec3& ambient, const glm::dvec3& diffuse) const;
  glm::dvec3 GetReflectance(const glm::dvec3& color) const
  {
    return this->GetReflectance(color, color);
  }

  /// The same, sRGB-encoded. Colours that stay as they are do so to the last bit.
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
  /// How much light boundary, metal and diffuse base send back of the light that they get.
  struct Response
  {
    double Diffuse = 1.0;  ///< of lights of a direction, by the diffuse base, over reflectance
    double Base = 1.0;     ///< of light from all around, by all that the reflectance multiplies
    double Boundary = 0.0; ///< of light from all around, by the boundary
  };

  void FindPhysical(const std::vector<glm::dvec3>& typical);
  void FindHighlight(const std::vector<glm::dvec3>& typical);
  void UpdateResponse();
  double GetClassicReflectance(int channel, double ambient, double diffuse) const;
  double GetPhysicalLevel() const;
  double GetPhysicalReflectance(int channel, double color) const;

  /// What the window's diffuse base reflects of a surface of a colour.
  double GetPhysicalDiffuse(double color) const;

  /// Whether the part of metal varies over the surface.
  bool HasMetallicTexture() const;

  /// The base colour that sRGB's curve displays as VTK's power displays another one.
  double MakeUpForGamma(double base, double window) const;

  vtkProperty* Property;
  LightLevel Level;
  Drawing Kind;
  bool IsPhysical;
  double Metallic = 0.0;
  double Roughness = 1.0;
  double IndexOfRefraction = 1.0;
  double WindowReflectance = 0.0; // of the boundary in the window, from straight above
  Response Reflects;
  glm::dvec3 Rest{ 0.0 }; // of highlights that are too broad, as radiance of the diffuse base
};
}

#endif
