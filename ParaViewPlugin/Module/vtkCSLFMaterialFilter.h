// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFMaterialFilter
 * @brief   gives data a material for path tracing
 *
 * The output is the input, with the material's arrays in its field data: see vtkCSLFMaterial, whose
 * defaults and ranges are those of this class. Blocks of composite data that have a material of
 * their own keep it.
 *
 * @sa vtkCSLFMaterial vtkCSLFSampler
 */
#ifndef vtkCSLFMaterialFilter_h
#define vtkCSLFMaterialFilter_h

#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkPassInputTypeAlgorithm.h"

class VTKCSLFPARAVIEW_EXPORT vtkCSLFMaterialFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkCSLFMaterialFilter* New();
  vtkTypeMacro(vtkCSLFMaterialFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The base colour, sRGB-encoded, each component in [0,1]. Default: 0.8, 0.8, 0.8.
   */
  vtkSetVector3Macro(BaseColor, double);
  vtkGetVector3Macro(BaseColor, double);
  ///@}

  ///@{
  /**
   * How metallic the surface is, in [0,1]. Default: 0.
   */
  vtkSetClampMacro(Metallic, double, 0.0, 1.0);
  vtkGetMacro(Metallic, double);
  ///@}

  ///@{
  /**
   * The perceptual roughness, in [0,1]. Default: 1.
   */
  vtkSetClampMacro(Roughness, double, 0.0, 1.0);
  vtkGetMacro(Roughness, double);
  ///@}

  ///@{
  /**
   * The radiance emitted from both sides: linear, not negative. Default: 0, 0, 0.
   */
  vtkSetVector3Macro(Emission, double);
  vtkGetVector3Macro(Emission, double);
  ///@}

  ///@{
  /**
   * The index of refraction, at least 1. With 1 a dielectric is purely diffuse. Default: 1.
   */
  vtkSetClampMacro(IndexOfRefraction, double, 1.0, 10.0);
  vtkGetMacro(IndexOfRefraction, double);
  ///@}

  ///@{
  /**
   * The part of a dielectric that is glass, in [0,1]. Default: 0.
   */
  vtkSetClampMacro(Transmission, double, 0.0, 1.0);
  vtkGetMacro(Transmission, double);
  ///@}

  ///@{
  /**
   * Whether glass is a thin sheet, which does not bend light. Default: off.
   */
  vtkSetMacro(ThinWalled, bool);
  vtkGetMacro(ThinWalled, bool);
  vtkBooleanMacro(ThinWalled, bool);
  ///@}

  ///@{
  /**
   * The opacity, in [0,1]. Default: 1.
   */
  vtkSetClampMacro(Opacity, double, 0.0, 1.0);
  vtkGetMacro(Opacity, double);
  ///@}

protected:
  vtkCSLFMaterialFilter() = default;
  ~vtkCSLFMaterialFilter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkCSLFMaterialFilter(const vtkCSLFMaterialFilter&) = delete;
  void operator=(const vtkCSLFMaterialFilter&) = delete;

  double BaseColor[3] = { 0.8, 0.8, 0.8 };
  double Metallic = 0.0;
  double Roughness = 1.0;
  double Emission[3] = { 0.0, 0.0, 0.0 };
  double IndexOfRefraction = 1.0;
  double Transmission = 0.0;
  bool ThinWalled = false;
  double Opacity = 1.0;
};

#endif
