// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFLight
 * @brief   lights that travel with the data, as field data
 *
 * The path tracing filters read directional and point lights from the field data of their inputs:
 * of the root data object, and of each block of a composite data set, which may hold nothing else.
 * Any VTK pipeline carries them along. This class knows the arrays' names; each has one tuple a
 * light:
 *
 * | array | components | meaning |
 * |---|---|---|
 * | `DirectionalLightDirection` | 3 | in which the light travels, world; any length but 0 |
 * | `DirectionalLightIrradiance` | 3 | on a surface that faces the light, linear RGB |
 * | `PointLightPosition` | 3 | world |
 * | `PointLightIntensity` | 3 | irradiance times squared distance in world units, linear RGB |
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
class vtkLight;

class VTKCSLF_EXPORT vtkCSLFLight : public vtkObject
{
public:
  static vtkCSLFLight* New();
  vtkTypeMacro(vtkCSLFLight, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The arrays' names.
   */
  static const char* DirectionalLightDirection() { return "DirectionalLightDirection"; }
  static const char* DirectionalLightIrradiance() { return "DirectionalLightIrradiance"; }
  static const char* PointLightPosition() { return "PointLightPosition"; }
  static const char* PointLightIntensity() { return "PointLightIntensity"; }
  ///@}

  /**
   * Adds light from infinitely far away that travels along `direction` (world, any length but 0)
   * and gives `irradiance` (linear RGB) to a surface that faces it.
   */
  static void AddDirectionalLight(
    vtkDataObject* data, const double direction[3], const double irradiance[3]);

  /**
   * Adds a point light at `position` (world) that gives `intensity` (linear RGB), divided by the
   * squared distance in world units, to a surface that faces it.
   */
  static void AddPointLight(
    vtkDataObject* data, const double position[3], const double intensity[3]);

  /**
   * Adds a VTK light that is switched on: a positional one as a point light, any other as a
   * directional one. Its diffuse colour (sRGB) times its intensity is what VTK multiplies a diffuse
   * surface's colour by where the surface faces the light; the light added does the same, a point
   * light at its focal point, since light falls off with distance. A cone of less than 90 degrees
   * is left out with a warning. Headlights and camera lights are taken where they stand now.
   */
  static void AddLight(vtkDataObject* data, vtkLight* light);

  /**
   * Removes all lights from the field data.
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
