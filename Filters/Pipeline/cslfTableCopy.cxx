// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTableCopy.h"

#include <vtkColorTransferFunction.h>
#include <vtkDiscretizableColorTransferFunction.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkScalarsToColors.h>
#include <vtkUnsignedCharArray.h>

namespace cslf
{
namespace
{
/// Copies what vtkLookupTable::DeepCopy leaves out, and copies the colours, so that they are not
/// built again from ranges of hues.
void CopyRest(vtkLookupTable* table, vtkLookupTable* copy)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->DeepCopy(table->GetTable());
  copy->SetTable(colors);
  copy->SetNanColor(table->GetNanColor());
  copy->SetBelowRangeColor(table->GetBelowRangeColor());
  copy->SetUseBelowRangeColor(table->GetUseBelowRangeColor());
  copy->SetAboveRangeColor(table->GetAboveRangeColor());
  copy->SetUseAboveRangeColor(table->GetUseAboveRangeColor());
}

void CopyRest(
  vtkDiscretizableColorTransferFunction* function, vtkDiscretizableColorTransferFunction* copy)
{
  copy->SetDiscretize(function->GetDiscretize());
  copy->SetNumberOfValues(function->GetNumberOfValues());
  copy->SetUseLogScale(function->GetUseLogScale());
  copy->SetEnableOpacityMapping(function->GetEnableOpacityMapping());
  copy->SetScalarOpacityFunction(function->GetScalarOpacityFunction());
  copy->SetNumberOfIndexedColors(function->GetNumberOfIndexedColors());
  for (unsigned int i = 0; i < function->GetNumberOfIndexedColors(); ++i)
  {
    double color[4];
    function->GetIndexedColor(i, color);
    copy->SetIndexedColorRGBA(i, color);
  }
}

/// Copies what vtkColorTransferFunction::DeepCopy leaves out.
void CopyRest(vtkColorTransferFunction* function, vtkColorTransferFunction* copy)
{
  copy->SetNanColor(function->GetNanColor());
  copy->SetNanOpacity(function->GetNanOpacity());
  copy->SetBelowRangeColor(function->GetBelowRangeColor());
  copy->SetUseBelowRangeColor(function->GetUseBelowRangeColor());
  copy->SetAboveRangeColor(function->GetAboveRangeColor());
  copy->SetUseAboveRangeColor(function->GetUseAboveRangeColor());
  if (auto* steps = vtkDiscretizableColorTransferFunction::SafeDownCast(function))
  {
    CopyRest(steps, vtkDiscretizableColorTransferFunction::SafeDownCast(copy));
  }
}

/// A new table of a class that maps like the table's. ParaView's subclass builds its categories
/// from a set that only it has, and would lose them.
vtkSmartPointer<vtkScalarsToColors> MakeTableLike(vtkScalarsToColors* table)
{
  if (table->IsA("vtkDiscretizableColorTransferFunction"))
  {
    return vtkSmartPointer<vtkDiscretizableColorTransferFunction>::New();
  }
  return vtk::TakeSmartPointer(table->NewInstance());
}

}

vtkSmartPointer<vtkScalarsToColors> CopyTable(vtkScalarsToColors* table)
{
  table->Build();
  const vtkSmartPointer<vtkScalarsToColors> copy = MakeTableLike(table);
  copy->DeepCopy(table);
  if (auto* colors = vtkLookupTable::SafeDownCast(table))
  {
    CopyRest(colors, vtkLookupTable::SafeDownCast(copy));
  }
  if (auto* function = vtkColorTransferFunction::SafeDownCast(table))
  {
    CopyRest(function, vtkColorTransferFunction::SafeDownCast(copy));
  }
  copy->Build();
  return copy;
}
}
