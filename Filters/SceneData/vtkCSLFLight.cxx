// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFLight.h"

#include "SceneData/cslfWindowLights.h"
#include "cslfColor.h"

#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkLight.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkCSLFLight);

namespace
{
void Append(vtkDataObject* data, const char* name, const double* tuple, int components = 3)
{
  if (!data)
  {
    return;
  }
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  vtkDataArray* present = data->GetFieldData()->GetArray(name);
  if (present && present->GetNumberOfComponents() == components)
  {
    array->DeepCopy(present);
  }
  array->InsertNextTuple(tuple);
  data->GetFieldData()->AddArray(array);
}

/// Appends an attenuation for a light that will be added next; null means the default. There is no
/// array while all lights have the default.
void AppendAttenuation(
  vtkDataObject* data, const char* name, const char* positions, const double* attenuation)
{
  if (!data || (!attenuation && !data->GetFieldData()->GetArray(name)))
  {
    return;
  }
  const double standard[4] = { 0.0, 0.0, 1.0, 1.0 };
  vtkDataArray* lights = data->GetFieldData()->GetArray(positions);
  const vtkIdType before = lights ? lights->GetNumberOfTuples() : 0;
  vtkDataArray* present = data->GetFieldData()->GetArray(name);
  for (vtkIdType i = present ? present->GetNumberOfTuples() : 0; i < before; ++i)
  {
    Append(data, name, standard, 4);
  }
  Append(data, name, attenuation ? attenuation : standard, 4);
}
}

void vtkCSLFLight::AddDirectionalLight(
  vtkDataObject* data, const double direction[3], const double irradiance[3])
{
  Append(data, DirectionalLightDirection(), direction);
  Append(data, DirectionalLightIrradiance(), irradiance);
}

void vtkCSLFLight::AddPointLight(vtkDataObject* data, const double position[3],
  const double intensity[3], const double* attenuation)
{
  AppendAttenuation(data, PointLightAttenuation(), PointLightPosition(), attenuation);
  Append(data, PointLightPosition(), position);
  Append(data, PointLightIntensity(), intensity);
}

void vtkCSLFLight::AddSpotLight(vtkDataObject* data, const double position[3],
  const double direction[3], const double intensity[3], double coneAngle, double exponent,
  const double* attenuation)
{
  AppendAttenuation(data, SpotLightAttenuation(), SpotLightPosition(), attenuation);
  const double cone[2] = { coneAngle, exponent };
  Append(data, SpotLightPosition(), position);
  Append(data, SpotLightIntensity(), intensity);
  Append(data, SpotLightDirection(), direction);
  Append(data, SpotLightCone(), cone, 2);
}

void vtkCSLFLight::SetEnvironment(
  vtkDataObject* data, const double bottom[3], const double top[3], const double up[3])
{
  if (data)
  {
    data->GetFieldData()->RemoveArray(EnvironmentRadiance());
    data->GetFieldData()->RemoveArray(EnvironmentUp());
    Append(data, EnvironmentRadiance(), bottom);
    Append(data, EnvironmentRadiance(), top);
    Append(data, EnvironmentUp(), up);
  }
}

bool vtkCSLFLight::SetEnvironmentImage(
  vtkDataObject* data, vtkImageData* image, const double up[3], const double right[3])
{
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  int dimensions[3] = { 0, 0, 0 };
  if (image)
  {
    image->GetDimensions(dimensions);
  }
  const bool usable = scalars && dimensions[0] > 0 && dimensions[1] > 0 && dimensions[2] == 1 &&
    (scalars->GetDataType() == VTK_FLOAT || scalars->GetDataType() == VTK_UNSIGNED_CHAR) &&
    (scalars->GetNumberOfComponents() == 3 || scalars->GetNumberOfComponents() == 4);
  if (!data || !usable)
  {
    vtkGenericWarningMacro(
      "An environment is left out: its image must be two-dimensional, of floats "
      "or unsigned chars of 3 or 4 components.");
    return false;
  }
  auto pixels = vtk::TakeSmartPointer(scalars->NewInstance());
  pixels->ShallowCopy(scalars);
  pixels->SetName(EnvironmentImage());
  vtkNew<vtkIntArray> layout;
  layout->SetName(EnvironmentImageLayout());
  layout->SetNumberOfComponents(2);
  layout->InsertNextTuple2(dimensions[0], dimensions[1]);
  data->GetFieldData()->AddArray(pixels);
  data->GetFieldData()->AddArray(layout);
  data->GetFieldData()->RemoveArray(EnvironmentUp());
  data->GetFieldData()->RemoveArray(EnvironmentRight());
  Append(data, EnvironmentUp(), up);
  Append(data, EnvironmentRight(), right);
  return true;
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
  double direction[3];
  vtkMath::Subtract(focalPoint, position, direction);
  const double distance = vtkMath::Norm(direction);
  const double falloff = light->GetPositional() ? cslf::GetAttenuation(light, distance) : 1.0;
  // A diffuse surface of reflectance 1 in the irradiance E has the radiance E / pi.
  double irradiance[3];
  double brightest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const double displayed = light->GetIntensity() * falloff * color[i];
    irradiance[i] = vtkMath::Pi() * cslf::SRGBToLinear(std::max(displayed, 0.0));
    brightest = std::max(brightest, displayed);
  }
  if (!light->GetPositional())
  {
    AddDirectionalLight(data, direction, irradiance);
    return;
  }
  const double exponent = cslf::GetDecodingExponent(brightest);
  vtkMath::MultiplyScalar(irradiance, std::pow(falloff, -exponent));
  const double* values = light->GetAttenuationValues();
  const bool falls = values[0] + values[1] + values[2] > 0.0;
  const double attenuation[4] = { falls ? values[0] : 1.0, values[1], values[2], exponent };
  if (light->GetConeAngle() < 90.0)
  {
    AddSpotLight(data, position, direction, irradiance, light->GetConeAngle(),
      exponent * light->GetExponent(), attenuation);
  }
  else
  {
    AddPointLight(data, position, irradiance, attenuation);
  }
}

void vtkCSLFLight::RemoveLights(vtkDataObject* data)
{
  if (!data)
  {
    return;
  }
  for (const char* name :
    { DirectionalLightDirection(), DirectionalLightIrradiance(), PointLightPosition(),
      PointLightIntensity(), PointLightAttenuation(), SpotLightPosition(), SpotLightIntensity(),
      SpotLightDirection(), SpotLightCone(), SpotLightAttenuation(), EnvironmentRadiance(),
      EnvironmentUp(), EnvironmentRight(), EnvironmentImage(), EnvironmentImageLayout() })
  {
    data->GetFieldData()->RemoveArray(name);
  }
}

void vtkCSLFLight::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
