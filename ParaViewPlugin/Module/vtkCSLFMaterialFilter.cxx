// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFMaterialFilter.h"

#include "vtkCSLFMaterial.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkCSLFMaterialFilter);

//------------------------------------------------------------------------------
int vtkCSLFMaterialFilter::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
int vtkCSLFMaterialFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0], 0);
  vtkDataObject* output = vtkDataObject::GetData(outputVector, 0);
  output->ShallowCopy(input);
  vtkNew<vtkFieldData> fields; // of its own, so that the input stays as it is
  fields->ShallowCopy(input->GetFieldData());
  output->SetFieldData(fields);
  vtkCSLFMaterial::SetBaseColor(output, this->BaseColor[0], this->BaseColor[1], this->BaseColor[2]);
  vtkCSLFMaterial::SetMetallic(output, this->Metallic);
  vtkCSLFMaterial::SetRoughness(output, this->Roughness);
  vtkCSLFMaterial::SetEmission(output, this->Emission[0], this->Emission[1], this->Emission[2]);
  vtkCSLFMaterial::SetIndexOfRefraction(output, this->IndexOfRefraction);
  vtkCSLFMaterial::SetTransmission(output, this->Transmission);
  vtkCSLFMaterial::SetThinWalled(output, this->ThinWalled);
  vtkCSLFMaterial::SetOpacity(output, this->Opacity);
  return 1;
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto printVector = [&os, indent](const char* name, const double* values) {
    os << indent << name << ": (" << values[0] << ", " << values[1] << ", " << values[2] << ")\n";
  };
  printVector("BaseColor", this->BaseColor);
  os << indent << "Metallic: " << this->Metallic << "\n";
  os << indent << "Roughness: " << this->Roughness << "\n";
  printVector("Emission", this->Emission);
  os << indent << "IndexOfRefraction: " << this->IndexOfRefraction << "\n";
  os << indent << "Transmission: " << this->Transmission << "\n";
  os << indent << "ThinWalled: " << (this->ThinWalled ? "on" : "off") << "\n";
  os << indent << "Opacity: " << this->Opacity << "\n";
}
