// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFVolume.h"

#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkVolumeProperty.h>

#include <array>
#include <vector>

vtkStandardNewMacro(vtkCSLFVolume);

namespace
{
/// The colours of a property: as many as mappers have at most for floats.
constexpr int ColorCount = 4096;

void SetNumbers(vtkDataSet* data, const char* name, int components, const double* values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->InsertNextTuple(values);
  data->GetFieldData()->AddArray(array);
}

void SetNumber(vtkDataSet* data, const char* name, double value)
{
  SetNumbers(data, name, 1, &value);
}

/// The functions of a component of a property, as colours and opacities over a range.
vtkSmartPointer<vtkFloatArray> MakeColors(
  vtkVolumeProperty* property, int component, const double range[2])
{
  std::vector<float> rgb(3 * ColorCount);
  std::vector<float> opacity(ColorCount);
  if (property->GetColorChannels(component) == 1)
  {
    std::vector<float> gray(ColorCount);
    property->GetGrayTransferFunction(component)->GetTable(
      range[0], range[1], ColorCount, gray.data());
    for (int i = 0; i < 3 * ColorCount; ++i)
    {
      rgb[i] = gray[i / 3];
    }
  }
  else
  {
    property->GetRGBTransferFunction(component)->GetTable(
      range[0], range[1], ColorCount, rgb.data());
  }
  property->GetScalarOpacity(component)->GetTable(range[0], range[1], ColorCount, opacity.data());
  const double weight =
    property->GetIndependentComponents() ? property->GetComponentWeight(component) : 1.0;
  auto colors = vtkSmartPointer<vtkFloatArray>::New();
  colors->SetName(vtkCSLFVolume::ColorsName());
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(ColorCount);
  for (int i = 0; i < ColorCount; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      colors->SetComponent(i, k, vtkMath::ClampValue(rgb[3 * i + k], 0.0f, 1.0f));
    }
    colors->SetComponent(i, 3, vtkMath::ClampValue(weight * opacity[i], 0.0, 1.0));
  }
  return colors;
}
}

bool vtkCSLFVolume::SetFromProperty(vtkDataSet* data, vtkVolumeProperty* property, int component)
{
  vtkDataArray* scalars = data ? data->GetPointData()->GetScalars() : nullptr;
  if (data && !scalars)
  {
    scalars = data->GetCellData()->GetScalars();
  }
  if (!property || !scalars || component < 0 || component >= scalars->GetNumberOfComponents() ||
    component >= VTK_MAX_VRCOMP)
  {
    return false;
  }
  double range[2];
  scalars->GetFiniteRange(range, component);
  if (!(range[0] <= range[1]))
  {
    return false;
  }
  data->GetFieldData()->AddArray(MakeColors(property, component, range));
  SetNumbers(data, RangeName(), 2, range);
  SetNumber(data, ComponentName(), component);
  SetNumber(data, UnitDistanceName(), property->GetScalarOpacityUnitDistance(component));
  SetNumber(data, InterpolationName(), property->GetInterpolationType());
  SetNumber(data, ShadeName(), property->GetShade(component));
  return true;
}

void vtkCSLFVolume::SetMatrix(vtkDataSet* data, vtkMatrix4x4* matrix)
{
  if (data && matrix)
  {
    SetNumbers(data, MatrixName(), 16, matrix->GetData());
  }
}

void vtkCSLFVolume::AddPlane(vtkDataSet* data, const double origin[3], const double normal[3])
{
  if (!data)
  {
    return;
  }
  vtkNew<vtkDoubleArray> planes;
  planes->SetName(PlanesName());
  planes->SetNumberOfComponents(4);
  vtkDataArray* before = data->GetFieldData()->GetArray(PlanesName());
  if (before && before->GetNumberOfComponents() == 4)
  {
    planes->DeepCopy(before);
  }
  const double plane[4] = { normal[0], normal[1], normal[2], -vtkMath::Dot(normal, origin) };
  planes->InsertNextTuple(plane);
  data->GetFieldData()->AddArray(planes);
}

void vtkCSLFVolume::SetShade(vtkDataSet* data, bool shade)
{
  if (data)
  {
    SetNumber(data, ShadeName(), shade ? 1.0 : 0.0);
  }
}

void vtkCSLFVolume::SetAnisotropy(vtkDataSet* data, double anisotropy)
{
  if (data)
  {
    SetNumber(data, AnisotropyName(), anisotropy);
  }
}

void vtkCSLFVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
