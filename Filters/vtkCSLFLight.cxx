// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFLight.h"

#include "cslfColor.h"

#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkLight.h>
#include <vtkMath.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

vtkStandardNewMacro(vtkCSLFLight);

namespace
{
void Append(vtkDataObject* data, const char* name, const double tuple[3])
{
  if (!data)
  {
    return;
  }
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  vtkDataArray* present = data->GetFieldData()->GetArray(name);
  if (present && present->GetNumberOfComponents() == 3)
  {
    array->DeepCopy(present);
  }
  array->InsertNextTuple(tuple);
  data->GetFieldData()->AddArray(array);
}
}

void vtkCSLFLight::AddDirectionalLight(
  vtkDataObject* data, const double direction[3], const double irradiance[3])
{
  Append(data, DirectionalLightDirection(), direction);
  Append(data, DirectionalLightIrradiance(), irradiance);
}

void vtkCSLFLight::AddPointLight(
  vtkDataObject* data, const double position[3], const double intensity[3])
{
  Append(data, PointLightPosition(), position);
  Append(data, PointLightIntensity(), intensity);
}

void vtkCSLFLight::AddLight(vtkDataObject* data, vtkLight* light)
{
  if (!light || !light->GetSwitch())
  {
    return;
  }
  double position[3];
  double focalPoint[3];
  double color[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focalPoint);
  light->GetDiffuseColor(color);
  // A diffuse surface of reflectance 1 in the irradiance E has the radiance E / pi.
  double irradiance[3];
  for (int i = 0; i < 3; ++i)
  {
    irradiance[i] = vtkMath::Pi() * light->GetIntensity() * cslf::SRGBToLinear(color[i]);
  }
  if (!light->GetPositional())
  {
    double direction[3];
    vtkMath::Subtract(focalPoint, position, direction);
    AddDirectionalLight(data, direction, irradiance);
    return;
  }
  if (light->GetConeAngle() < 90.0)
  {
    vtkGenericWarningMacro("A spot light's cone is left out: it lights all around.");
  }
  vtkMath::MultiplyScalar(irradiance, vtkMath::Distance2BetweenPoints(position, focalPoint));
  AddPointLight(data, position, irradiance);
}

void vtkCSLFLight::RemoveLights(vtkDataObject* data)
{
  if (!data)
  {
    return;
  }
  for (const char* name : { DirectionalLightDirection(), DirectionalLightIrradiance(),
         PointLightPosition(), PointLightIntensity() })
  {
    data->GetFieldData()->RemoveArray(name);
  }
}

void vtkCSLFLight::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
