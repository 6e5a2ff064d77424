// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCSLFMaterialFilter
 * @brief   gives data a material for path tracing
 *
 * The output is the input, with the material's arrays in its field data: see vtkCSLFMaterial.
 * Blocks of composite data that have their own material keep it.
 *
 * @sa vtkCSLFMaterial vtkCSLFSampler
 */
#ifndef vtkCSLFMaterialFilter_h
#define vtkCSLFMaterialFilter_h

#include "vtkCSLFParaViewModule.h" // for export macro
#include "vtkNew.h"                // for vtkNew
#include "vtkPassInputTypeAlgorithm.h"

class vtkDataObject;

class VTKCSLFPARAVIEW_EXPORT vtkCSLFMaterialFilter : public vtkPassInputTypeAlgorithm
{
public:
  static vtkCSLFMaterialFilter* New();
  vtkTypeMacro(vtkCSLFMaterialFilter, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The parameters of vtkCSLFMaterial. Those that are never set do not change.
   */
  void SetBaseColor(double red, double green, double blue);
  void SetMetallic(double metallic);
  void SetRoughness(double roughness);
  void SetEmission(double red, double green, double blue);
  void SetIndexOfRefraction(double index);
  void SetTransmission(double transmission);
  void SetThinWalled(bool thin);
  void SetOpacity(double opacity);
  ///@}

protected:
  vtkCSLFMaterialFilter();
  ~vtkCSLFMaterialFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkCSLFMaterialFilter(const vtkCSLFMaterialFilter&) = delete;
  void operator=(const vtkCSLFMaterialFilter&) = delete;

  vtkNew<vtkDataObject> Material; // its field data holds the parameters that are set
};

#endif
