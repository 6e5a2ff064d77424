// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFBoxSampler.h"

#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>

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
  os << indent << "UseReferenceBounds: " << this->UseReferenceBounds << "\n";
  os << indent << "ReferenceBounds: (" << this->ReferenceBounds[0];
  for (int i = 1; i < 6; ++i)
  {
    os << ", " << this->ReferenceBounds[i];
  }
  os << ")\n";
}
