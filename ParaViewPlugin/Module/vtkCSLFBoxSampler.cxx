// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFBoxSampler.h"

#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>

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
void vtkCSLFBoxSampler::UpdateCube()
{
  const double* position = this->CubePosition;
  const double* lengths = this->CubeLengths;
  this->SetCubeCenter(
    position[0] + 0.5 * lengths[0], position[1] + 0.5 * lengths[1], position[2] + 0.5 * lengths[2]);
  this->SetCubeEdges(lengths[0], lengths[1], lengths[2]);
}

//------------------------------------------------------------------------------
int vtkCSLFBoxSampler::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (std::string(vtkSMPTools::GetBackend()) != "Sequential")
  {
    return this->Superclass::RequestData(request, inputVector, outputVector);
  }
  int result = 0;
  vtkSMPTools::LocalScope(vtkSMPTools::Config("STDThread"),
    [&]() { result = this->Superclass::RequestData(request, inputVector, outputVector); });
  return result;
}

//------------------------------------------------------------------------------
void vtkCSLFBoxSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CubePosition: (" << this->CubePosition[0] << ", " << this->CubePosition[1]
     << ", " << this->CubePosition[2] << ")\n";
  os << indent << "CubeLengths: (" << this->CubeLengths[0] << ", " << this->CubeLengths[1] << ", "
     << this->CubeLengths[2] << ")\n";
}
