// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFMaterial
 * @brief   materials that travel with the data, as field data
 *
 * The path tracing filters read the material of a surface from the field data of its block: of the
 * vtkPolyData itself, or, for arrays that it lacks, of the composite data set it is a leaf of. Any
 * VTK pipeline carries them along. This class knows the arrays' names; each holds one tuple:
 *
 * | array | components | meaning | range | default |
 * |---|---|---|---|---|
 * | `BaseColor` | 3 | sRGB-encoded; a dielectric's diffuse reflectance, a metal's reflectance at
 * normal incidence | [0,1] | 0.8, 0.8, 0.8 | | `Metallic` | 1 | 0 is a dielectric, 1 a metal, a
 * blend between | [0,1] | 0 | | `Roughness` | 1 | perceptual; its square is GGX's alpha; below 0.03
 * a perfect mirror | [0,1] | 1 | | `Emission` | 3 | radiance, linear, from both sides | >= 0 | 0,
 * 0, 0 | | `IndexOfRefraction` | 1 | of a dielectric's glossy boundary; 1 has none | >= 1 | 1 | |
 * `Transmission` | 1 | the part of the light that passes a dielectric's boundary | [0,1] | 0 | |
 * `Opacity` | 1 | 0 is invisible, 1 covers | [0,1] | 1 |
 *
 * The model is the metallic-roughness material of glTF 2.0. The default, metallic 0 and index 1, is
 * purely diffuse. Transmission other than 0 and opacity other than 1 are carried but not
 * represented by the tracer, which warns of them. Colours of points or cells, where they are shown,
 * replace the base colour (see vtkCSLFPathTracer).
 *
 * Values out of range are clamped when set.
 *
 * @sa vtkCSLFLight vtkCSLFPathTracer
 */
#ifndef vtkCSLFMaterial_h
#define vtkCSLFMaterial_h

#include "vtkCSLFModule.h" // for export macro
#include "vtkObject.h"

class vtkDataObject;
class vtkProperty;

class VTKCSLF_EXPORT vtkCSLFMaterial : public vtkObject
{
public:
  static vtkCSLFMaterial* New();
  vtkTypeMacro(vtkCSLFMaterial, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Sets all arrays from a property.
   *
   * With PBR interpolation: base colour, metallic, roughness, base index of refraction, opacity. An
   * emissive factor only scales an emissive texture, and textures are not read, so there is no
   * emission. Any other interpolation gives a diffuse surface of the diffuse colour times the
   * diffuse coefficient, and the opacity; ambient and Blinn-Phong specular terms are no light
   * transport and have no counterpart. Coats, anisotropy, edge tint, textures, edges and
   * representations other than surfaces are not represented.
   */
  static void SetFromProperty(vtkDataObject* data, vtkProperty* property);

  ///@{
  /**
   * Set or get the base colour, sRGB-encoded, each component in [0,1]. Default: 0.8, 0.8, 0.8.
   */
  static void SetBaseColor(vtkDataObject* data, double red, double green, double blue);
  static void GetBaseColor(vtkDataObject* data, double color[3]);
  ///@}

  ///@{
  /**
   * Set or get how metallic the surface is, in [0,1]. Default: 0.
   */
  static void SetMetallic(vtkDataObject* data, double metallic);
  static double GetMetallic(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the perceptual roughness, in [0,1]. Default: 1.
   */
  static void SetRoughness(vtkDataObject* data, double roughness);
  static double GetRoughness(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the radiance emitted from both sides: linear, not negative. Default: 0, 0, 0.
   */
  static void SetEmission(vtkDataObject* data, double red, double green, double blue);
  static void GetEmission(vtkDataObject* data, double radiance[3]);
  ///@}

  ///@{
  /**
   * Set or get the index of refraction, at least 1. With 1 a dielectric is purely diffuse; glass
   * and plastics have about 1.5. Default: 1.
   */
  static void SetIndexOfRefraction(vtkDataObject* data, double index);
  static double GetIndexOfRefraction(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the transmission, in [0,1]. Default: 0.
   */
  static void SetTransmission(vtkDataObject* data, double transmission);
  static double GetTransmission(vtkDataObject* data);
  ///@}

  ///@{
  /**
   * Set or get the opacity, in [0,1]. Default: 1.
   */
  static void SetOpacity(vtkDataObject* data, double opacity);
  static double GetOpacity(vtkDataObject* data);
  ///@}

  /**
   * Copies the arrays of `fallback` that `data` lacks. For a block that inherits from its root.
   */
  static void Inherit(vtkDataObject* data, vtkDataObject* fallback);

protected:
  vtkCSLFMaterial() = default;
  ~vtkCSLFMaterial() override = default;

private:
  vtkCSLFMaterial(const vtkCSLFMaterial&) = delete;
  void operator=(const vtkCSLFMaterial&) = delete;
};

#endif
