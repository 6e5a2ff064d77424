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
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

class vtkCSLFMapper::vtkInternals
{
public:
  std::map<vtkWindow*, vtkSmartPointer<vtkCSLFCubeMapper>> CubeMappers;
  std::optional<cslf::Description> Field;
  std::array<glm::dvec3, cslf::FaceCount> AutomaticFocalPoints{};
  vtkImageData* CheckedInput = nullptr; ///< only compared
  vtkMTimeType CheckedTime = 0;
  bool HasWarnedOfInside = false;

  std::array<glm::dvec3, cslf::FaceCount> GetFocalPointsCC(const vtkCSLFMapper* mapper) const;
  std::vector<glm::dvec4> GetClippingPlanesCC(vtkMapper* mapper, vtkActor* actor) const;
};

//------------------------------------------------------------------------------
std::array<glm::dvec3, cslf::FaceCount> vtkCSLFMapper::vtkInternals::GetFocalPointsCC(
  const vtkCSLFMapper* mapper) const
{
  if (mapper->AutomaticFocalPoint)
  {
    return this->AutomaticFocalPoints;
  }
  const double* point = mapper->FocalPoint;
  std::array<glm::dvec3, cslf::FaceCount> points;
  points.fill(this->Field->Box.PointToCube({ point[0], point[1], point[2] }));
  return points;
}

//------------------------------------------------------------------------------
std::vector<glm::dvec4> vtkCSLFMapper::vtkInternals::GetClippingPlanesCC(
  vtkMapper* mapper, vtkActor* actor) const
{
  const cslf::Cube& box = this->Field->Box;
  std::vector<glm::dvec4> planes;
  for (int i = 0; i < mapper->GetNumberOfClippingPlanes(); ++i)
  {
    double plane[4];
    mapper->GetClippingPlaneInDataCoords(actor->GetMatrix(), i, plane);
    const glm::dvec3 normal(plane[0], plane[1], plane[2]);
    planes.emplace_back(0.5 * normal * box.Edges, plane[3] + glm::dot(normal, box.Center));
  }
  return planes;
}

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
const char* vtkCSLFMapper::GetToneMappingAsString()
{
  static const char* const names[] = { "clamp", "reinhard", "aces" };
  return names[this->ToneMapping];
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkCSLFMapper::GetTextureBytes()
{
  vtkTypeInt64 bytes = 0;
  for (const auto& windowAndMapper : this->Internals->CubeMappers)
  {
    bytes += windowAndMapper.second->GetTextureBytes();
  }
  return bytes;
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
  internals.HasWarnedOfInside = false;
  for (const auto& windowAndMapper : internals.CubeMappers)
  {
    windowAndMapper.second->SetField(*internals.Field, input);
  }
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
// The one that draws in a window, made when it is first needed.
vtkCSLFCubeMapper* vtkCSLFMapper::GetCubeMapper(vtkWindow* window)
{
  vtkInternals& internals = *this->Internals;
  vtkSmartPointer<vtkCSLFCubeMapper>& cubeMapper = internals.CubeMappers[window];
  if (!cubeMapper)
  {
    cubeMapper = vtkSmartPointer<vtkCSLFCubeMapper>::New();
    cubeMapper->SetField(*internals.Field, internals.CheckedInput);
  }
  return cubeMapper;
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::Render(vtkRenderer* renderer, vtkActor* actor)
{
  if (!this->UpdateField())
  {
    return;
  }
  vtkInternals& internals = *this->Internals;
  vtkCSLFCubeMapper* cubeMapper = this->GetCubeMapper(renderer->GetRenderWindow());
  cubeMapper->SetLookup(this->Lookup);
  cubeMapper->SetFocalPointsCC(internals.GetFocalPointsCC(this));
  cubeMapper->SetClippingPlanesCC(internals.GetClippingPlanesCC(this, actor));
  cubeMapper->SetToneMapping({ this->Exposure, this->ToneMapping });
  cubeMapper->Render(renderer, actor);
  this->TimeToDraw = cubeMapper->GetTimeToDraw();
  if (cubeMapper->IsEyeInside() && !internals.HasWarnedOfInside)
  {
    internals.HasWarnedOfInside = true;
    vtkWarningMacro("The eye is inside the light field's cube: only what can also be seen from "
                    "outside, along the same lines of sight, is drawn.");
  }
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::ReleaseGraphicsResources(vtkWindow* window)
{
  const auto found = this->Internals->CubeMappers.find(window);
  if (found != this->Internals->CubeMappers.end())
  {
    found->second->ReleaseGraphicsResources(window);
    this->Internals->CubeMappers.erase(found);
  }
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
    this->SetFocalPoint(other->GetFocalPoint());
    this->SetExposure(other->GetExposure());
    this->SetToneMapping(other->GetToneMapping());
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
void vtkCSLFMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Lookup: " << this->GetLookupAsString() << "\n";
  os << indent << "AutomaticFocalPoint: " << (this->AutomaticFocalPoint ? "on" : "off") << "\n";
  os << indent << "FocalPoint: (" << this->FocalPoint[0] << ", " << this->FocalPoint[1] << ", "
     << this->FocalPoint[2] << ")\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "ToneMapping: " << this->GetToneMappingAsString() << "\n";
}
