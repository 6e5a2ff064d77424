// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFMapper.h"

#include "cslfDescription.h"
#include "cslfFocus.h"
#include "vtkCSLFCubeMapper.h"

#include <vtkActor.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include <array>
#include <optional>
#include <string>

class vtkCSLFMapper::vtkInternals
{
public:
  vtkNew<vtkCSLFCubeMapper> CubeMapper;
  std::optional<cslf::Description> Field;
  std::array<glm::dvec3, cslf::FaceCount> AutomaticFocalPoints{};
  vtkImageData* CheckedInput = nullptr; ///< only compared
  vtkMTimeType CheckedTime = 0;
};

vtkStandardNewMacro(vtkCSLFMapper);

//------------------------------------------------------------------------------
vtkCSLFMapper::vtkCSLFMapper()
  : Internals(new vtkInternals)
{
}

//------------------------------------------------------------------------------
vtkCSLFMapper::~vtkCSLFMapper() = default;

//------------------------------------------------------------------------------
int vtkCSLFMapper::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
vtkImageData* vtkCSLFMapper::GetInput()
{
  return this->GetNumberOfInputConnections(0) < 1
    ? nullptr
    : vtkImageData::SafeDownCast(this->GetExecutive()->GetInputData(0, 0));
}

//------------------------------------------------------------------------------
const char* vtkCSLFMapper::GetLookupAsString()
{
  static const char* const names[] = { "nearest", "linear", "bilinear", "focal", "depth" };
  return names[this->Lookup];
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkCSLFMapper::GetTextureBytes()
{
  return this->Internals->CubeMapper->GetTextureBytes();
}

//------------------------------------------------------------------------------
// Brings the input up to date and reads its description, once per change of the input.
bool vtkCSLFMapper::UpdateField()
{
  if (this->GetNumberOfInputConnections(0) < 1)
  {
    return false;
  }
  if (!this->Static)
  {
    this->GetInputAlgorithm()->Update();
  }
  vtkInternals& internals = *this->Internals;
  vtkImageData* input = this->GetInput();
  if (!input)
  {
    return false;
  }
  if (internals.CheckedInput == input && internals.CheckedTime == input->GetMTime())
  {
    return internals.Field.has_value();
  }
  internals.CheckedInput = input;
  internals.CheckedTime = input->GetMTime();

  std::string error;
  internals.Field = cslf::Description::ReadFrom(input, error);
  if (internals.Field)
  {
    const int* extent = input->GetExtent();
    if (!internals.Field->FindChannel(cslf::ColorName))
    {
      error = "The light field has no colour.";
    }
    else if (extent[4] != 0 || extent[5] != internals.Field->Grid.GetSlices() - 1)
    {
      error = "The image data holds only a part of its light field's viewpoints.";
    }
  }
  if (!error.empty())
  {
    internals.Field.reset();
    vtkErrorMacro(<< error);
    return false;
  }
  internals.AutomaticFocalPoints = cslf::FindFocalPoints(*internals.Field, input);
  internals.CubeMapper->SetField(*internals.Field, input);
  return true;
}

//------------------------------------------------------------------------------
double* vtkCSLFMapper::GetBounds()
{
  if (this->UpdateField())
  {
    this->Internals->Field->Box.GetBounds(this->Bounds);
  }
  else
  {
    vtkMath::UninitializeBounds(this->Bounds);
  }
  return this->Bounds;
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::Render(vtkRenderer* renderer, vtkActor* actor)
{
  if (!this->UpdateField())
  {
    return;
  }
  vtkCSLFCubeMapper* cubeMapper = this->Internals->CubeMapper;
  cubeMapper->SetLookup(this->Lookup);
  cubeMapper->SetLookupSeconds(
    this->AutoAdjustResolution ? actor->GetAllocatedRenderTime() : VTK_DOUBLE_MAX);
  const cslf::Cube& box = this->Internals->Field->Box;
  std::array<glm::dvec3, cslf::FaceCount> focalPoints;
  focalPoints.fill(
    box.PointToCube({ this->FocalPoint[0], this->FocalPoint[1], this->FocalPoint[2] }));
  cubeMapper->SetFocalPointsCC(
    this->AutomaticFocalPoint ? this->Internals->AutomaticFocalPoints : focalPoints);
  cubeMapper->Render(renderer, actor);
  this->TimeToDraw = cubeMapper->GetTimeToDraw();
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::ProcessSelectorPixelBuffers(
  vtkHardwareSelector* selector, std::vector<unsigned int>& pixelOffsets, vtkProp* prop)
{
  this->Internals->CubeMapper->ProcessSelectorPixelBuffers(selector, pixelOffsets, prop);
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internals->CubeMapper->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkCSLFMapper::SafeDownCast(mapper))
  {
    this->SetInputConnection(other->GetInputConnection(0, 0));
    this->SetLookup(other->GetLookup());
    this->SetAutomaticFocalPoint(other->GetAutomaticFocalPoint());
    this->SetAutoAdjustResolution(other->GetAutoAdjustResolution());
    this->SetFocalPoint(other->GetFocalPoint());
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Lookup: " << this->GetLookupAsString() << "\n";
  os << indent << "AutomaticFocalPoint: " << (this->AutomaticFocalPoint ? "on" : "off") << "\n";
  os << indent << "AutoAdjustResolution: " << (this->AutoAdjustResolution ? "on" : "off") << "\n";
  os << indent << "FocalPoint: (" << this->FocalPoint[0] << ", " << this->FocalPoint[1] << ", "
     << this->FocalPoint[2] << ")\n";
}
