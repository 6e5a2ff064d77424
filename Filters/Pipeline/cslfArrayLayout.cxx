// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/cslfArrayLayout.h"

#include <vtkDataSetAttributes.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <vector>

namespace cslf
{
namespace
{
bool IsAOS(vtkAbstractArray* array)
{
  return !vtkDataArray::SafeDownCast(array) || array->HasStandardMemoryLayout();
}

bool AreAOS(vtkFieldData* fields)
{
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    if (!IsAOS(fields->GetAbstractArray(i)))
    {
      return false;
    }
  }
  return true;
}

/// A copy of some of an array's tuples, with its name and other properties.
vtkSmartPointer<vtkDataArray> CopyTuples(vtkDataArray* array, vtkIdType first, vtkIdType count)
{
  auto copy = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(array->GetDataType()));
  copy->SetName(array->GetName());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->CopyComponentNames(array);
  copy->SetLookupTable(array->GetLookupTable());
  if (array->HasInformation())
  {
    copy->CopyInformation(array->GetInformation(), /*deep=*/1);
  }
  copy->SetNumberOfTuples(count);
  copy->InsertTuples(0, count, first, array);
  return copy;
}

/// The arrays that replace those of the fields, in the same order.
std::vector<vtkSmartPointer<vtkAbstractArray>> CopyArrays(vtkFieldData* fields)
{
  std::vector<vtkSmartPointer<vtkAbstractArray>> arrays;
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* numbers = fields->GetArray(i);
    arrays.emplace_back(numbers ? ToAOS(numbers).Get() : fields->GetAbstractArray(i));
  }
  return arrays;
}
}

vtkSmartPointer<vtkDataArray> ToAOS(vtkDataArray* array)
{
  if (!array || IsAOS(array))
  {
    return array;
  }
  return CopyTuples(array, 0, array->GetNumberOfTuples());
}

vtkSmartPointer<vtkImageData> ToAOS(vtkImageData* image, int first, int last)
{
  vtkPointData* attributes = image->GetPointData();
  if (AreAOS(attributes))
  {
    return image;
  }
  int extent[6];
  image->GetExtent(extent);
  const int* size = image->GetDimensions();
  const vtkIdType points = static_cast<vtkIdType>(size[0]) * size[1];
  const vtkIdType begin = points * (first - extent[4]);
  const vtkIdType count = points * (last - first + 1);
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->CopyStructure(image);
  extent[4] = first;
  extent[5] = last;
  copy->SetExtent(extent);
  copy->GetFieldData()->ShallowCopy(image->GetFieldData());
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    if (vtkDataArray* array = attributes->GetArray(i))
    {
      copy->GetPointData()->AddArray(CopyTuples(array, begin, count));
    }
  }
  return copy;
}

bool MakeAOS(vtkFieldData* fields)
{
  if (AreAOS(fields))
  {
    return false;
  }
  vtkNew<vtkFieldData> made;
  for (const auto& array : CopyArrays(fields))
  {
    made->AddArray(array);
  }
  fields->ShallowCopy(made);
  return true;
}

bool MakeAOS(vtkDataSetAttributes* attributes)
{
  if (AreAOS(attributes))
  {
    return false;
  }
  vtkNew<vtkDataSetAttributes> made;
  const auto arrays = CopyArrays(attributes);
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    const int place = made->AddArray(arrays[i]);
    const int use = attributes->IsArrayAnAttribute(i);
    if (use >= 0)
    {
      made->SetActiveAttribute(place, use);
    }
  }
  attributes->ShallowCopy(made);
  return true;
}

vtkSmartPointer<vtkDataSetAttributes> KeepNumeric(vtkDataSetAttributes* attributes)
{
  vtkSmartPointer<vtkDataSetAttributes> kept = attributes;
  for (int i = attributes->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (vtkDataArray::SafeDownCast(attributes->GetAbstractArray(i)))
    {
      continue;
    }
    if (kept == attributes)
    {
      kept = vtk::TakeSmartPointer(attributes->NewInstance());
      kept->ShallowCopy(attributes);
    }
    kept->RemoveArray(i);
  }
  return kept;
}
}
