// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceColors.h"

#include "cslfColor.h"

#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDiscretizableColorTransferFunction.h>
#include <vtkLookupTable.h>
#include <vtkScalarsToColors.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>

namespace cslf
{
namespace
{
std::array<float, 256> MakeLinearTable()
{
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i)
  {
    table[i] = static_cast<float>(SRGBToLinear(i / 255.0));
  }
  return table;
}
}

bool HoldsColors(vtkDataArray* array)
{
  return vtkUnsignedCharArray::SafeDownCast(array) && array->GetNumberOfComponents() >= 3 &&
    array->GetNumberOfComponents() <= 4;
}

bool HasColors(vtkScalarsToColors* table)
{
  if (auto* colors = vtkLookupTable::SafeDownCast(table))
  {
    return colors->GetNumberOfTableValues() > 0;
  }
  auto* steps = vtkDiscretizableColorTransferFunction::SafeDownCast(table);
  if (steps && steps->GetIndexedLookup() && steps->GetNumberOfIndexedColors() > 0)
  {
    return true;
  }
  auto* function = vtkColorTransferFunction::SafeDownCast(table);
  return !function || function->GetSize() > 0;
}

SurfaceColors::SurfaceColors(vtkScalarsToColors* lookupTable)
  : LookupTable(lookupTable)
  , Range{ VTK_DOUBLE_MAX, VTK_DOUBLE_MIN }
{
}

void SurfaceColors::AddToRange(vtkDataArray* array)
{
  if (!HoldsColors(array) && array->GetNumberOfTuples() > 0)
  {
    double range[2];
    array->GetFiniteRange(range, 0);
    this->Range[0] = std::min(this->Range[0], range[0]);
    this->Range[1] = std::max(this->Range[1], range[1]);
  }
}

vtkScalarsToColors* SurfaceColors::FindTable(vtkDataArray* array) const
{
  return this->LookupTable ? this->LookupTable : array->GetLookupTable();
}

bool SurfaceColors::CanMap(vtkDataArray* array) const
{
  vtkScalarsToColors* table = this->FindTable(array);
  return HoldsColors(array) || !table || HasColors(table);
}

vtkSmartPointer<vtkUnsignedCharArray> SurfaceColors::MapThroughTable(vtkDataArray* array)
{
  const std::lock_guard<std::mutex> lock(this->Mapping);
  vtkScalarsToColors* table = this->FindTable(array);
  if (!table)
  {
    if (!this->DefaultTable)
    {
      this->DefaultTable = vtkSmartPointer<vtkLookupTable>::New();
      if (this->Range[0] <= this->Range[1])
      {
        this->DefaultTable->SetTableRange(this->Range);
      }
    }
    table = this->DefaultTable;
  }
  table->Build();
  return vtk::TakeSmartPointer(table->MapScalars(array, VTK_COLOR_MODE_MAP_SCALARS, -1));
}

MappedColors SurfaceColors::Map(vtkDataArray* array)
{
  vtkSmartPointer<vtkUnsignedCharArray> colors = vtkUnsignedCharArray::SafeDownCast(array);
  if (!HoldsColors(array))
  {
    colors = this->MapThroughTable(array);
  }

  static const std::array<float, 256> linear = MakeLinearTable();
  const int components = colors->GetNumberOfComponents();
  MappedColors result;
  result.Colors.reserve(colors->GetNumberOfTuples());
  bool translucent = false;
  const unsigned char* values = colors->GetPointer(0);
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i, values += components)
  {
    result.Colors.emplace_back(linear[values[0]], linear[values[1]], linear[values[2]]);
    if (components == 4)
    {
      result.Opacities.push_back(static_cast<float>(values[3]) / 255.0f);
      translucent = translucent || values[3] < 255;
    }
  }
  if (!translucent)
  {
    result.Opacities.clear();
  }
  return result;
}
}
