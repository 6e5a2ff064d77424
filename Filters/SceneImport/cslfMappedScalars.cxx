// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMappedScalars.h"

#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMapper.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkScalarsToColors.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// The pixels of a lookup table's texture.
constexpr int TableSize = 4096;

// What vtkMapper says of the place of scalars.
constexpr int ScalarsOfCells = 1;
constexpr int ScalarsOfFieldData = 2;

/// A mapper's way to colours without its drawing: mapping caches results in the mapper, which here
/// is not the user's.
class ColorMapper : public vtkMapper
{
public:
  static ColorMapper* New();
  vtkTypeMacro(ColorMapper, vtkMapper);
  void Render(vtkRenderer*, vtkActor*) override {}
};

vtkStandardNewMacro(ColorMapper);

/// The colour of one tuple of field data, for all points.
vtkSmartPointer<vtkUnsignedCharArray> Spread(
  vtkUnsignedCharArray* colors, vtkIdType tuple, vtkIdType points)
{
  auto spread = vtkSmartPointer<vtkUnsignedCharArray>::New();
  spread->SetNumberOfComponents(colors->GetNumberOfComponents());
  spread->SetNumberOfTuples(points);
  for (vtkIdType i = 0; i < points; ++i)
  {
    spread->SetTuple(i, tuple, colors);
  }
  return spread;
}

/// The scalars of points that numbers of a range are mapped from; null where colours are taken as
/// they are, or values are categories.
vtkDataArray* FindNumbers(vtkMapper* mapper, vtkDataSet* data)
{
  int cellFlag = 0;
  auto* scalars =
    vtkDataArray::SafeDownCast(vtkAbstractMapper::GetAbstractScalars(data, mapper->GetScalarMode(),
      mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cellFlag));
  if (!scalars || cellFlag != 0 || scalars->GetNumberOfTuples() < 1)
  {
    return nullptr;
  }
  const bool direct = mapper->GetColorMode() == VTK_COLOR_MODE_DIRECT_SCALARS ||
    (mapper->GetColorMode() == VTK_COLOR_MODE_DEFAULT &&
      scalars->GetDataType() == VTK_UNSIGNED_CHAR);
  vtkScalarsToColors* table = mapper->GetLookupTable();
  return direct || table->GetIndexedLookup() ? nullptr : scalars;
}

/// The number of a tuple that is mapped: a component, or the magnitude.
double GetNumber(vtkDataArray* scalars, vtkIdType tuple, vtkScalarsToColors* table)
{
  const int components = scalars->GetNumberOfComponents();
  if (components > 1 && table->GetVectorMode() == vtkScalarsToColors::MAGNITUDE)
  {
    double sum = 0.0;
    for (int i = 0; i < components; ++i)
    {
      sum += scalars->GetComponent(tuple, i) * scalars->GetComponent(tuple, i);
    }
    return std::sqrt(sum);
  }
  const int component = table->GetVectorMode() == vtkScalarsToColors::COMPONENT
    ? std::clamp(table->GetVectorComponent(), 0, components - 1)
    : 0;
  return scalars->GetComponent(tuple, component);
}

/// Lays the lookup table out as a texture, so that numbers are mapped after they are interpolated.
bool MapThroughTable(vtkMapper* mapper, vtkDataSet* data, MappedScalars& mapped)
{
  vtkDataArray* scalars = FindNumbers(mapper, data);
  if (!scalars)
  {
    return false;
  }
  vtkScalarsToColors* table = mapper->GetLookupTable();
  table->SetAlpha(1.0);
  table->Build();
  double range[2];
  const double* source =
    mapper->GetUseLookupTableScalarRange() ? table->GetRange() : mapper->GetScalarRange();
  std::copy_n(source, 2, range);
  const double width = range[1] - range[0];
  if (!std::isfinite(width) || !(width > 0.0) || table->UsingLogScale())
  {
    return false;
  }

  vtkNew<vtkFloatArray> samples;
  samples->SetNumberOfTuples(TableSize);
  for (int i = 0; i < TableSize; ++i)
  {
    samples->SetValue(i, static_cast<float>(range[0] + width * (i + 0.5) / TableSize));
  }
  vtkSmartPointer<vtkUnsignedCharArray> colors;
  colors.TakeReference(table->MapScalars(samples, VTK_COLOR_MODE_MAP_SCALARS, 0));
  mapped.Table = vtkSmartPointer<vtkImageData>::New();
  mapped.Table->SetDimensions(TableSize, 1, 1);
  mapped.Table->GetPointData()->SetScalars(colors);
  mapped.Coordinates = vtkSmartPointer<vtkFloatArray>::New();
  mapped.Coordinates->SetNumberOfComponents(2);
  mapped.Coordinates->SetNumberOfTuples(scalars->GetNumberOfTuples());
  for (vtkIdType i = 0; i < scalars->GetNumberOfTuples(); ++i)
  {
    const double place = (GetNumber(scalars, i, table) - range[0]) / width;
    mapped.Coordinates->SetTypedComponent(i, 0, static_cast<float>(place));
    mapped.Coordinates->SetTypedComponent(i, 1, 0.5f);
  }
  return true;
}
}

MappedScalars MapScalars(vtkMapper* mapper, vtkDataSet* data, bool useTable)
{
  MappedScalars mapped;
  if (!mapper->GetScalarVisibility())
  {
    return mapped;
  }
  vtkNew<ColorMapper> copy;
  copy->ShallowCopy(mapper);
  copy->ClearColorArrays();
  const bool asTable = useTable && mapper->GetInterpolateScalarsBeforeMapping();
  if (asTable && MapThroughTable(copy, data, mapped))
  {
    return mapped;
  }
  copy->InterpolateScalarsBeforeMappingOff();
  int cellFlag = 0;
  vtkUnsignedCharArray* colors = copy->MapScalars(data, 1.0, cellFlag);
  if (!colors || colors->GetNumberOfTuples() < 1)
  {
    return mapped;
  }
  const vtkIdType tuple = mapper->GetFieldDataTupleId();
  if (cellFlag == ScalarsOfFieldData && tuple >= 0 && tuple < colors->GetNumberOfTuples())
  {
    mapped.Colors = Spread(colors, tuple, data->GetNumberOfPoints());
    return mapped;
  }
  mapped.OfCells = cellFlag == ScalarsOfCells || cellFlag == ScalarsOfFieldData;
  const vtkIdType expected = mapped.OfCells ? data->GetNumberOfCells() : data->GetNumberOfPoints();
  if (colors->GetNumberOfTuples() == expected)
  {
    mapped.Colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
    mapped.Colors->ShallowCopy(colors);
  }
  return mapped;
}
}
