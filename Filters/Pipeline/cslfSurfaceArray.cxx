// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceArray.h"

#include "cslfColorMap.h"
#include "cslfGeometryArrays.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkType.h>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
bool IsIntegral(vtkDataArray* array)
{
  const int type = array->GetDataType();
  return type != VTK_FLOAT && type != VTK_DOUBLE;
}

/// Integers, if all numbers are such of 32 bits, or else doubles: between points of different
/// integers, a simplified surface may have other numbers.
vtkSmartPointer<vtkDataArray> MakeDataArray(const SurfaceArray& from, std::size_t points)
{
  bool areIntegers = from.IsInteger;
  for (const SurfaceArray::Component& component : from.Components)
  {
    areIntegers = areIntegers &&
      std::all_of(component.Values.begin(), component.Values.end(),
        [](double value)
        { return value == std::floor(value) && value >= VTK_INT_MIN && value <= VTK_INT_MAX; });
  }
  const auto array =
    vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(areIntegers ? VTK_INT : VTK_DOUBLE));
  const int size = static_cast<int>(from.Components.size());
  array->SetName(from.Name.c_str());
  array->SetNumberOfComponents(size);
  array->SetNumberOfTuples(static_cast<vtkIdType>(points));
  for (int c = 0; c < size; ++c)
  {
    if (!from.Components[c].Name.empty())
    {
      array->SetComponentName(c, from.Components[c].Name.c_str());
    }
    for (std::size_t i = 0; i < points; ++i)
    {
      array->SetComponent(static_cast<vtkIdType>(i), c, from.Components[c].Values[i]);
    }
  }
  return array;
}
}

double SurfaceArray::GetValue(std::size_t point, int component) const
{
  if (component >= 0)
  {
    return this->Components[component].Values[point];
  }
  double sum = 0.0;
  for (const Component& each : this->Components)
  {
    sum += each.Values[point] * each.Values[point];
  }
  return std::sqrt(sum);
}

std::optional<std::array<double, 2>> SurfaceArray::GetRange(int component) const
{
  std::optional<std::array<double, 2>> range;
  for (std::size_t i = 0; i < this->Components.front().Values.size(); ++i)
  {
    const double value = this->GetValue(i, component);
    if (std::isfinite(value))
    {
      range = range
        ? std::array<double, 2>{ std::min((*range)[0], value), std::max((*range)[1], value) }
        : std::array<double, 2>{ value, value };
    }
  }
  return range;
}

std::optional<int> SurfaceArray::FindComponent(const std::string& text) const
{
  if (text == this->Name)
  {
    return 0;
  }
  const int size = static_cast<int>(this->Components.size());
  for (int component = -1; component < size; ++component)
  {
    const std::string number = this->Name + " " + std::to_string(component);
    if (text == this->GetScalarName(component) || (component >= 0 && text == number))
    {
      return component;
    }
  }
  return std::nullopt;
}

std::string SurfaceArray::GetScalarName(int component) const
{
  if (this->Components.size() < 2)
  {
    return this->Name;
  }
  const std::string& name = this->Components[std::max(component, 0)].Name;
  return this->Name + " " +
    (component < 0     ? MagnitudeName
        : name.empty() ? std::to_string(component)
                       : name);
}

SurfaceArray MakeSurfaceArray(vtkDataArray* array, const std::string& name,
  const std::vector<vtkIdType>& tuples, bool keepsInfinite)
{
  SurfaceArray result;
  result.Name = name;
  result.IsInteger = IsIntegral(array);
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    SurfaceArray::Component& component = result.Components.emplace_back();
    const char* own = array->GetComponentName(c);
    component.Name = own ? own : "";
    component.Values.reserve(tuples.size());
    for (const vtkIdType tuple : tuples)
    {
      const double value = array->GetComponent(tuple, c);
      component.Values.push_back(keepsInfinite || std::isfinite(value) ? value : vtkMath::Nan());
    }
  }
  return result;
}

void AddSurfaceArrays(const std::vector<SurfaceArray>& arrays, vtkPolyData* geometry)
{
  if (arrays.empty())
  {
    return;
  }
  vtkNew<vtkStringArray> names;
  names->SetName(SurfaceArraysName);
  vtkNew<vtkStringArray> integers;
  integers->SetName(IntegerArraysName);
  for (const SurfaceArray& array : arrays)
  {
    names->InsertNextValue(array.Name);
    if (array.IsInteger)
    {
      integers->InsertNextValue(array.Name);
    }
    geometry->GetPointData()->AddArray(
      MakeDataArray(array, static_cast<std::size_t>(geometry->GetNumberOfPoints())));
  }
  geometry->GetFieldData()->AddArray(names);
  if (integers->GetNumberOfValues() > 0)
  {
    geometry->GetFieldData()->AddArray(integers);
  }
}

std::vector<SurfaceArray> FindSurfaceArrays(vtkPolyData* geometry)
{
  std::vector<SurfaceArray> arrays;
  const auto find = [geometry](const char* name)
  { return vtkStringArray::SafeDownCast(geometry->GetFieldData()->GetAbstractArray(name)); };
  auto* names = find(SurfaceArraysName);
  auto* integers = find(IntegerArraysName);
  std::vector<vtkIdType> all(static_cast<std::size_t>(geometry->GetNumberOfPoints()));
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i] = static_cast<vtkIdType>(i);
  }
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    const std::string& name = names->GetValue(i);
    vtkDataArray* array = geometry->GetPointData()->GetArray(name.c_str());
    const bool isNew = std::none_of(arrays.begin(), arrays.end(),
      [&name](const SurfaceArray& other) { return other.Name == name; });
    if (array && isNew && array->GetNumberOfTuples() == geometry->GetNumberOfPoints())
    {
      arrays.push_back(MakeSurfaceArray(array, name, all));
      arrays.back().IsInteger = integers && integers->LookupValue(name) >= 0;
    }
  }
  return arrays;
}
}
