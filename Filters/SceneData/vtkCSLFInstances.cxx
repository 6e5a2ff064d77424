// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFInstances.h"

#include "Pipeline/cslfArrayLayout.h"
#include "cslfColor.h"

#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkUnsignedCharArray.h>

vtkStandardNewMacro(vtkCSLFInstances);

namespace
{
/// The array of a name and a kind. Makes an empty one if there is none.
template <typename Array>
Array* GetOrMake(vtkDataObject* data, const char* name, int components)
{
  vtkFieldData* fields = data->GetFieldData();
  const auto array = cslf::ToAOS<Array>(fields->GetArray(name));
  if (array && array->GetNumberOfComponents() == components)
  {
    fields->AddArray(array);
    return array;
  }
  vtkNew<Array> made;
  made->SetName(name);
  made->SetNumberOfComponents(components);
  fields->AddArray(made);
  return Array::SafeDownCast(fields->GetAbstractArray(name));
}
}

void vtkCSLFInstances::AddInstance(vtkDataObject* data, vtkMatrix4x4* matrix)
{
  if (data && matrix)
  {
    auto* matrices = GetOrMake<vtkDoubleArray>(data, InstanceMatrix(), 16);
    matrices->InsertNextTuple(matrix->GetData());
    matrices->Modified();
  }
}

void vtkCSLFInstances::AddInstance(vtkDataObject* data, vtkMatrix4x4* matrix, const double color[4])
{
  AddInstance(data, matrix);
  if (data && matrix)
  {
    auto* colors = GetOrMake<vtkUnsignedCharArray>(data, InstanceColor(), 4);
    for (int i = 0; i < 4; ++i)
    {
      colors->InsertNextValue(cslf::ToByte(color[i]));
    }
    colors->Modified();
  }
}

void vtkCSLFInstances::AddInstance(
  vtkDataObject* data, vtkMatrix4x4* matrix, const double color[4], const double emission[3])
{
  AddInstance(data, matrix, color);
  if (data && matrix)
  {
    auto* emissions = GetOrMake<vtkDoubleArray>(data, InstanceEmission(), 3);
    emissions->InsertNextTuple(emission);
    emissions->Modified();
  }
}

void vtkCSLFInstances::RemoveInstances(vtkDataObject* data)
{
  if (data)
  {
    data->GetFieldData()->RemoveArray(InstanceMatrix());
    data->GetFieldData()->RemoveArray(InstanceColor());
    data->GetFieldData()->RemoveArray(InstanceEmission());
    data->GetFieldData()->RemoveArray(InstanceScalar());
  }
}

void vtkCSLFInstances::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
