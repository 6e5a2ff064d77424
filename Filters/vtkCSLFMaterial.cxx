// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFMaterial.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkProperty.h>

#include <algorithm>

vtkStandardNewMacro(vtkCSLFMaterial);

namespace
{
/// A row of the table in the class's documentation.
struct Parameter
{
  const char* Name;
  int Components;
  double Default;
  double Minimum;
  double Maximum;
};

// The tracer computes in floats.
constexpr double Unlimited = 1e30;
constexpr Parameter BaseColor = { "BaseColor", 3, 0.8, 0.0, 1.0 };
constexpr Parameter Metallic = { "Metallic", 1, 0.0, 0.0, 1.0 };
constexpr Parameter Roughness = { "Roughness", 1, 1.0, 0.0, 1.0 };
constexpr Parameter Emission = { "Emission", 3, 0.0, 0.0, Unlimited };
constexpr Parameter IndexOfRefraction = { "IndexOfRefraction", 1, 1.0, 1.0, Unlimited };
constexpr Parameter Transmission = { "Transmission", 1, 0.0, 0.0, 1.0 };
constexpr Parameter Opacity = { "Opacity", 1, 1.0, 0.0, 1.0 };
constexpr Parameter Parameters[] = { BaseColor, Metallic, Roughness, Emission, IndexOfRefraction,
  Transmission, Opacity };

double Clamp(const Parameter& parameter, double value)
{
  // A value that is no number is replaced, too.
  return value >= parameter.Minimum
    ? std::min(value, parameter.Maximum)
    : (value < parameter.Minimum ? parameter.Minimum : parameter.Default);
}

void Set(vtkDataObject* data, const Parameter& parameter, const double* values)
{
  if (!data)
  {
    return;
  }
  vtkNew<vtkDoubleArray> array;
  array->SetName(parameter.Name);
  array->SetNumberOfComponents(parameter.Components);
  array->SetNumberOfTuples(1);
  for (int i = 0; i < parameter.Components; ++i)
  {
    array->SetTypedComponent(0, i, Clamp(parameter, values[i]));
  }
  data->GetFieldData()->AddArray(array);
}

vtkDataArray* Find(vtkDataObject* data, const Parameter& parameter)
{
  vtkDataArray* array = data ? data->GetFieldData()->GetArray(parameter.Name) : nullptr;
  return array && array->GetNumberOfTuples() > 0 &&
      array->GetNumberOfComponents() == parameter.Components
    ? array
    : nullptr;
}

void Get(vtkDataObject* data, const Parameter& parameter, double* values)
{
  vtkDataArray* array = Find(data, parameter);
  for (int i = 0; i < parameter.Components; ++i)
  {
    values[i] = array ? Clamp(parameter, array->GetComponent(0, i)) : parameter.Default;
  }
}

double Get(vtkDataObject* data, const Parameter& parameter)
{
  double value = parameter.Default;
  Get(data, parameter, &value);
  return value;
}
}

void vtkCSLFMaterial::SetFromProperty(vtkDataObject* data, vtkProperty* property)
{
  if (!property)
  {
    return;
  }
  const bool physical = property->GetInterpolation() == VTK_PBR;
  double color[3];
  property->GetDiffuseColor(color);
  const double coefficient = physical ? 1.0 : property->GetDiffuse();
  SetBaseColor(data, coefficient * color[0], coefficient * color[1], coefficient * color[2]);
  SetMetallic(data, physical ? property->GetMetallic() : Metallic.Default);
  SetRoughness(data, physical ? property->GetRoughness() : Roughness.Default);
  SetIndexOfRefraction(data, physical ? property->GetBaseIOR() : IndexOfRefraction.Default);
  SetEmission(data, 0.0, 0.0, 0.0);
  SetTransmission(data, Transmission.Default);
  SetOpacity(data, property->GetOpacity());
}

void vtkCSLFMaterial::SetBaseColor(vtkDataObject* data, double red, double green, double blue)
{
  const double color[3] = { red, green, blue };
  Set(data, BaseColor, color);
}

void vtkCSLFMaterial::GetBaseColor(vtkDataObject* data, double color[3])
{
  Get(data, BaseColor, color);
}

void vtkCSLFMaterial::SetMetallic(vtkDataObject* data, double metallic)
{
  Set(data, Metallic, &metallic);
}

double vtkCSLFMaterial::GetMetallic(vtkDataObject* data)
{
  return Get(data, Metallic);
}

void vtkCSLFMaterial::SetRoughness(vtkDataObject* data, double roughness)
{
  Set(data, Roughness, &roughness);
}

double vtkCSLFMaterial::GetRoughness(vtkDataObject* data)
{
  return Get(data, Roughness);
}

void vtkCSLFMaterial::SetEmission(vtkDataObject* data, double red, double green, double blue)
{
  const double radiance[3] = { red, green, blue };
  Set(data, Emission, radiance);
}

void vtkCSLFMaterial::GetEmission(vtkDataObject* data, double radiance[3])
{
  Get(data, Emission, radiance);
}

void vtkCSLFMaterial::SetIndexOfRefraction(vtkDataObject* data, double index)
{
  Set(data, IndexOfRefraction, &index);
}

double vtkCSLFMaterial::GetIndexOfRefraction(vtkDataObject* data)
{
  return Get(data, IndexOfRefraction);
}

void vtkCSLFMaterial::SetTransmission(vtkDataObject* data, double transmission)
{
  Set(data, Transmission, &transmission);
}

double vtkCSLFMaterial::GetTransmission(vtkDataObject* data)
{
  return Get(data, Transmission);
}

void vtkCSLFMaterial::SetOpacity(vtkDataObject* data, double opacity)
{
  Set(data, Opacity, &opacity);
}

double vtkCSLFMaterial::GetOpacity(vtkDataObject* data)
{
  return Get(data, Opacity);
}

void vtkCSLFMaterial::Inherit(vtkDataObject* data, vtkDataObject* fallback)
{
  for (const Parameter& parameter : Parameters)
  {
    vtkDataArray* array = Find(fallback, parameter);
    if (data && array && !Find(data, parameter))
    {
      data->GetFieldData()->AddArray(array);
    }
  }
}

void vtkCSLFMaterial::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
