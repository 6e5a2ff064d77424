// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFMaterialFilter.h"

#include "Pipeline/cslfGuard.h"
#include "vtkCSLFMaterial.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkCSLFMaterialFilter);
cslfGuardedRequestMacro(vtkCSLFMaterialFilter);

//------------------------------------------------------------------------------
vtkCSLFMaterialFilter::vtkCSLFMaterialFilter() = default;

//------------------------------------------------------------------------------
vtkCSLFMaterialFilter::~vtkCSLFMaterialFilter() = default;

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
  vtkNew<vtkFieldData> fields; // a copy, so that the input does not change
  fields->ShallowCopy(input->GetFieldData());
  for (int i = 0; i < this->Material->GetFieldData()->GetNumberOfArrays(); ++i)
  {
    fields->AddArray(this->Material->GetFieldData()->GetAbstractArray(i));
  }
  output->SetFieldData(fields);
  return 1;
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::SetBaseColor(double red, double green, double blue)
{
  vtkCSLFMaterial::SetBaseColor(this->Material, red, green, blue);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::SetMetallic(double metallic)
{
  vtkCSLFMaterial::SetMetallic(this->Material, metallic);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::SetRoughness(double roughness)
{
  vtkCSLFMaterial::SetRoughness(this->Material, roughness);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::SetEmission(double red, double green, double blue)
{
  vtkCSLFMaterial::SetEmission(this->Material, red, green, blue);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::SetIndexOfRefraction(double index)
{
  vtkCSLFMaterial::SetIndexOfRefraction(this->Material, index);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::SetTransmission(double transmission)
{
  vtkCSLFMaterial::SetTransmission(this->Material, transmission);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::SetThinWalled(bool thin)
{
  vtkCSLFMaterial::SetThinWalled(this->Material, thin);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::SetOpacity(double opacity)
{
  vtkCSLFMaterial::SetOpacity(this->Material, opacity);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkCSLFMaterialFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Material:\n";
  this->Material->GetFieldData()->PrintSelf(os, indent.GetNextIndent());
}
