// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFBoxSampler.h"

#include "cslfLegend.h"
#include "vtkCSLFMaterial.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkCSLFBoxSampler);

//------------------------------------------------------------------------------
void vtkCSLFBoxSampler::SetCubePosition(double x, double y, double z)
{
  this->CubePosition[0] = x;
  this->CubePosition[1] = y;
  this->CubePosition[2] = z;
  this->UpdateCube();
}

//------------------------------------------------------------------------------
void vtkCSLFBoxSampler::SetCubeLengths(double x, double y, double z)
{
  this->CubeLengths[0] = x;
  this->CubeLengths[1] = y;
  this->CubeLengths[2] = z;
  this->UpdateCube();
}

//------------------------------------------------------------------------------
void vtkCSLFBoxSampler::SetUseReferenceBounds(bool use)
{
  this->UseReferenceBounds = use;
  this->UpdateCube();
}

//------------------------------------------------------------------------------
void vtkCSLFBoxSampler::SetReferenceBounds(
  double xMin, double xMax, double yMin, double yMax, double zMin, double zMax)
{
  const double bounds[6] = { xMin, xMax, yMin, yMax, zMin, zMax };
  std::copy_n(bounds, 6, this->ReferenceBounds);
  this->UpdateCube();
}

//------------------------------------------------------------------------------
void vtkCSLFBoxSampler::UpdateCube()
{
  double center[3];
  double edges[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = this->UseReferenceBounds ? this->ReferenceBounds[2 * axis] : 0.0;
    const double high = this->UseReferenceBounds ? this->ReferenceBounds[2 * axis + 1] : 1.0;
    center[axis] = this->CubePosition[axis] + this->CubeLengths[axis] * 0.5 * (low + high);
    edges[axis] = this->CubeLengths[axis] * (high - low);
  }
  const double margin = 0.001 * *std::max_element(edges, edges + 3);
  this->SetCubeCenter(center);
  this->SetCubeEdges(edges[0] + 2 * margin, edges[1] + 2 * margin, edges[2] + 2 * margin);
}

//------------------------------------------------------------------------------
// After an error the output is empty. If it was a failure for VTK, ParaView would try again for
// each picture, and its own filters would report the requests that fail with this one.
int vtkCSLFBoxSampler::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  int result = 0;
  const auto sample = [&]()
  { result = this->Superclass::RequestData(request, inputVector, outputVector); };
  if (std::string(vtkSMPTools::GetBackend()) != "Sequential")
  {
    sample();
  }
  else
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config("STDThread"), sample);
  }
  vtkMultiProcessController* controller = this->GetController();
  if (!result && (!controller || controller->GetNumberOfProcesses() < 2))
  {
    for (int port = 0; port < outputVector->GetNumberOfInformationObjects(); ++port)
    {
      if (vtkDataObject* output = vtkDataObject::GetData(outputVector, port))
      {
        output->Initialize();
      }
    }
    return 1;
  }
  vtkImageData* field = vtkImageData::GetData(outputVector);
  if (result && field)
  {
    this->AddLegends(inputVector[0], field->GetFieldData());
  }
  return result;
}

//------------------------------------------------------------------------------
// Adds the legends of captured scenes and of this filter's array to those of the field.
void vtkCSLFBoxSampler::AddLegends(vtkInformationVector* inputs, vtkFieldData* fields)
{
  bool isMapped = false;
  for (int i = 0; i < inputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject* input = vtkDataObject::GetData(inputs, i);
    cslf::CopyLegends(input, fields);
    isMapped = isMapped || this->IsMapped(input);
  }
  const char* name = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  if (isMapped && name && this->GetLookupTable())
  {
    cslf::AddLegend(fields, name, this->GetLookupTable());
  }
}

//------------------------------------------------------------------------------
// Whether this filter's array colours a part of an input.
bool vtkCSLFBoxSampler::IsMapped(vtkDataObject* input)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      if (this->IsMapped(leaf->GetCurrentDataObject()))
      {
        return true;
      }
    }
    return false;
  }
  int association = 0;
  return input && this->GetScalarVisibility() && !vtkCSLFMaterial::GetFinishedColors(input) &&
    this->GetInputAbstractArrayToProcess(0, input, association);
}

//------------------------------------------------------------------------------
void vtkCSLFBoxSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CubePosition: (" << this->CubePosition[0] << ", " << this->CubePosition[1]
     << ", " << this->CubePosition[2] << ")\n";
  os << indent << "CubeLengths: (" << this->CubeLengths[0] << ", " << this->CubeLengths[1] << ", "
     << this->CubeLengths[2] << ")\n";
  os << indent << "UseReferenceBounds: " << this->UseReferenceBounds << "\n";
  os << indent << "ReferenceBounds: (" << this->ReferenceBounds[0];
  for (int i = 1; i < 6; ++i)
  {
    os << ", " << this->ReferenceBounds[i];
  }
  os << ")\n";
}
