// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFLight
 * @brief   lights that travel with the data, as field data
 *
 * The path tracing filters read lights and the environment from the field data of their inputs: of
 * the root data object, and of each block of a composite data set, even an otherwise empty one. Any
 * VTK pipeline passes them on. This class provides the names of the arrays; each has one tuple per
 * light:
 *
 * | array | components | meaning |
 * |---|---|---|
 * | `CSLF:DirectionalLightDirection` | 3 | in which the light travels, world; any length but 0 |
 * | `CSLF:DirectionalLightIrradiance` | 3 | on a surface that faces the light, linear RGB |
 * | `CSLF:PointLightPosition` | 3 | world |
 * | `CSLF:PointLightIntensity` | 3 | irradiance where the falloff is 1, linear RGB |
 * | `CSLF:PointLightAttenuation` | 4 | optional: falloff with the distance |
 * | `CSLF:SpotLightPosition` | 3 | world |
 * | `CSLF:SpotLightIntensity` | 3 | as of a point light, along the axis |
 * | `CSLF:SpotLightDirection` | 3 | the axis, away from the light, world; any length but 0 |
 * | `CSLF:SpotLightCone` | 2 | angle between axis and cone, degrees; exponent of the falloff |
 * | `CSLF:SpotLightAttenuation` | 4 | optional: as of a point light |
 *
 * The intensity of a spot light is multiplied by the cosine to its axis, raised to that exponent.
 * With an attenuation of a, b, c, e, the irradiance at the distance d, in world units, is the
 * intensity over (a + b d + c d^2)^e. None of the four may be negative, and a, b and c must not all
 * be 0. The default, 0, 0, 1, 1, is the physical falloff: the intensity is irradiance times squared
 * distance.
 *
 * The environment is light from infinitely far away. An environment in the data replaces that of
 * the filter. It is described by `CSLF:EnvironmentRadiance`, 3 components, with one tuple for the
 * same radiance from all directions (linear) or two for those of bottom and top;
 * `CSLF:EnvironmentUp` and `CSLF:EnvironmentRight`, 3 components, its axes in the world; and
 * `CSLF:EnvironmentImage`, a lat-long image that is added: 3 or 4 components per pixel, floats
 * (linear) or unsigned chars (sRGB), beginning with the bottom row. `CSLF:EnvironmentImageLayout`
 * holds its width and height.
 *
 * Lights with an extent are surfaces whose material has an emission (see vtkCSLFMaterial), or the
 * environment (see vtkCSLFPathTracer).
 *
 * @sa vtkCSLFMaterial vtkCSLFPathTracer
 */
#ifndef vtkCSLFLight_h
#define vtkCSLFLight_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class vtkDataObject;
class vtkImageData;
class vtkLight;

class VTKCSLF_EXPORT vtkCSLFLight : public vtkObject
{
public:
  static vtkCSLFLight* New();
  vtkTypeMacro(vtkCSLFLight, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The names of the arrays.
   */
  static const char* DirectionalLightDirection() { return "CSLF:DirectionalLightDirection"; }
  static const char* DirectionalLightIrradiance() { return "CSLF:DirectionalLightIrradiance"; }
  static const char* PointLightPosition() { return "CSLF:PointLightPosition"; }
  static const char* PointLightIntensity() { return "CSLF:PointLightIntensity"; }
  static const char* PointLightAttenuation() { return "CSLF:PointLightAttenuation"; }
  static const char* SpotLightPosition() { return "CSLF:SpotLightPosition"; }
  static const char* SpotLightIntensity() { return "CSLF:SpotLightIntensity"; }
  static const char* SpotLightDirection() { return "CSLF:SpotLightDirection"; }
  static const char* SpotLightCone() { return "CSLF:SpotLightCone"; }
  static const char* SpotLightAttenuation() { return "CSLF:SpotLightAttenuation"; }
  static const char* EnvironmentRadiance() { return "CSLF:EnvironmentRadiance"; }
  static const char* EnvironmentUp() { return "CSLF:EnvironmentUp"; }
  static const char* EnvironmentRight() { return "CSLF:EnvironmentRight"; }
  static const char* EnvironmentImage() { return "CSLF:EnvironmentImage"; }
  static const char* EnvironmentImageLayout() { return "CSLF:EnvironmentImageLayout"; }
  ///@}

  /**
   * Adds a directional light: light from infinitely far away that travels along `direction` (world,
   * any length but 0) and gives `irradiance` (linear RGB) to a surface that faces it.
   */
  static void AddDirectionalLight(
    vtkDataObject* data, const double direction[3], const double irradiance[3]);

  /**
   * Adds a point light at `position` (world) with `intensity` (linear RGB): the irradiance of a
   * surface that faces it, times the squared distance in world units. `attenuation` selects another
   * falloff by four numbers (see above; null for the default).
   */
  static void AddPointLight(vtkDataObject* data, const double position[3],
    const double intensity[3], const double* attenuation = nullptr);

  /**
   * Adds a spot light: a point light whose intensity falls off with the cosine to the axis
   * `direction` (world, any length but 0) to the power of `exponent`, and is 0 beyond `coneAngle`
   * degrees from it.
   */
  static void AddSpotLight(vtkDataObject* data, const double position[3], const double direction[3],
    const double intensity[3], double coneAngle, double exponent,
    const double* attenuation = nullptr);

  /**
   * Sets the environment: radiance (linear RGB) from `bottom` to `top`, linear in the height of the
   * direction's unit vector along `up` (world, any length but 0).
   */
  static void SetEnvironment(
    vtkDataObject* data, const double bottom[3], const double top[3], const double up[3]);

  /**
   * Adds a lat-long image to the environment, as the environment texture of a vtkRenderer: floats
   * (linear) or unsigned chars (sRGB) with 3 or 4 components. Its middle column is in the direction
   * `right`, and its top row in the direction `up` (world, not parallel). Returns false, with a
   * warning, for any other image.
   */
  static bool SetEnvironmentImage(
    vtkDataObject* data, vtkImageData* image, const double up[3], const double right[3]);

  /**
   * Adds a VTK light that is switched on: a positional light becomes a point light, or a spot light
   * if its cone is narrower than 90 degrees, and any other a directional light. VTK multiplies
   * displayed colours of a surface that faces the light by its diffuse colour times its intensity.
   * The added light gives a white diffuse surface the same displayed colour, taken as sRGB. The
   * attenuation is that of VTK, raised to the power of sRGB's decoding there; a point or spot light
   * is exact at its focal point. Headlights and camera lights keep their current position.
   */
  static void AddLight(vtkDataObject* data, vtkLight* light);

  /**
   * Removes all lights and the environment from the field data.
   */
  static void RemoveLights(vtkDataObject* data);

protected:
  vtkCSLFLight() = default;
  ~vtkCSLFLight() override = default;

private:
  vtkCSLFLight(const vtkCSLFLight&) = delete;
  void operator=(const vtkCSLFLight&) = delete;
};

#endif
