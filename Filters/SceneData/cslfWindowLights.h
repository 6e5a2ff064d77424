// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts the lights of VTK's window to lights of light transport.
 *
 * VTK's classic shading multiplies colours by light as they are displayed: a light of intensity 0.5
 * shows a white surface as 0.5, which is 0.214 of white's light (IEC 61966-2-1). So the power of a
 * light is the linear value of the displayed colour of a white surface facing it. Falloffs, which
 * multiply displayed colours in the window, are raised to the exponent that fits best around the
 * level of the scene. VTK's physically based shading is linear, and a white surface reflects 1 / pi
 * of the intensity.
 */
#ifndef cslfWindowLights_h
#define cslfWindowLights_h

#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <set>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkLight;
class vtkRenderer;

namespace cslf
{
/// The light that a surface receives, in the window and when traced.
struct LightLevel
{
  glm::dvec3 Window{ 1.0 }; ///< the factor of colours in the window's classic shading
  glm::dvec3 Direct{ 1.0 }; ///< the radiance of a white diffuse surface in directional light
  glm::dvec3 Around{ 0.0 }; ///< and in light from all around
};

/// The shading models of the lit surfaces.
struct ShadingModels
{
  std::set<std::pair<double, double>> Classic; ///< the coefficients, ambient and diffuse
  bool Physical = false;                       ///< whether there are PBR surfaces
};

/// The slope of sRGB's decoding at a displayed value, in a log-log plot.
double GetDecodingExponent(double displayed);

/// The falloff of a positional light at a distance, in world units.
double GetAttenuation(vtkLight* light, double distance);

class WindowLights
{
public:
  /// The lights that the renderer would use now. Headlights may shine from all around.
  WindowLights(vtkRenderer* renderer, bool headlightsAllAround);

  /// Computes the powers for a scene around a point, with a size of about twice `reach`.
  void Calibrate(const glm::dvec3& center, double reach, const ShadingModels& models);

  /// Whether there is any light, so that the window shades surfaces.
  bool IsLit() const { return !this->Sources.empty(); }

  /// The level of a surface around a point, with a size of about twice `reach`. It faces the camera
  /// if any light moves with the camera, or else the direction of most light.
  LightLevel GetLevel(const glm::dvec3& center, double reach) const;

  /// The factor for the radiance of an environment image.
  double GetEnvironmentFactor() const { return this->EnvironmentFactor; }

  void AddTo(vtkDataObject* lights) const;

private:
  struct Source
  {
    vtkSmartPointer<vtkLight> Light;
    glm::dvec3 Color{ 0.0 }; ///< times the intensity
    bool MovesWithCamera = false;
    bool ShinesFromAllAround = false;
    glm::dvec3 Power{ 0.0 }; ///< of light transport, divided by pi, without falloff
    double Exponent = 1.0;   ///< of the falloff
  };

  void Add(vtkLight* light, vtkRenderer* renderer, bool headlightsAllAround);
  static glm::dvec3 GetDirection(const Source& source, const glm::dvec3& point);
  static double GetFalloff(const Source& source, const glm::dvec3& point, double nearest);
  glm::dvec3 GetWindowLevel(
    const glm::dvec3& point, double nearest, const glm::dvec3& normal) const;
  glm::dvec3 FindNormal(const glm::dvec3& point, double nearest) const;

  std::vector<Source> Sources;
  glm::dvec3 ToCamera{ 0.0, 0.0, 1.0 };
  double EnvironmentFactor = 1.0;
};
}

#endif
