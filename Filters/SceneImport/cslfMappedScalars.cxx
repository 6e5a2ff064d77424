// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMappedScalars.h"

#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTableCopy.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "SceneData/cslfTextureImage.h"
#include "cslfImportedScene.h"

#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkMapper.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkScalarsToColors.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
// vtkMapper's codes for the location of scalars.
constexpr int ScalarsOfCells = 1;
constexpr int ScalarsOfFieldData = 2;

/// Maps scalars like a mapper, without drawing. Mapping caches results in the mapper, so this one
/// is used instead of the user's.
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

/// Replaces an array, which may be the scalars, by one of the same name.
void Replace(vtkFieldData* fields, vtkDataArray* array, vtkDataArray* other)
{
  auto* attributes = vtkDataSetAttributes::SafeDownCast(fields);
  if (attributes && attributes->GetScalars() == array)
  {
    attributes->SetScalars(other);
  }
  else if (array->GetName() && fields->GetArray(array->GetName()) == array)
  {
    fields->AddArray(other);
  }
}

/// The array that a mapper shows. Null if it shows none or an array of strings.
vtkDataArray* FindScalars(vtkMapper* mapper, vtkDataSet* data)
{
  int cellFlag = 0;
  return vtkDataArray::SafeDownCast(
    vtkAbstractMapper::GetAbstractScalars(data, mapper->GetScalarMode(),
      mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cellFlag));
}

/// Whether an array is a mapper's colours.
bool AreDirect(vtkMapper* mapper, vtkDataArray* array)
{
  const int mode = mapper->GetColorMode();
  return mode == VTK_COLOR_MODE_DIRECT_SCALARS ||
    (mode == VTK_COLOR_MODE_DEFAULT && vtkUnsignedCharArray::SafeDownCast(array));
}

/// Whether a mapper would show an array by a table without colours.
bool NeedsEmptyTable(vtkMapper* mapper, vtkDataSet* data)
{
  vtkDataArray* array = FindScalars(mapper, data);
  if (!array || AreDirect(mapper, array))
  {
    return false;
  }
  vtkScalarsToColors* table = array->GetLookupTable();
  return !HasColors(table ? table : mapper->GetLookupTable());
}

/// The array's own table takes precedence over the mapper's. If there is one, it is copied with its
/// array, because the mapper changes it.
vtkSmartPointer<vtkDataSet> CopyTableOfArray(vtkMapper* mapper, vtkDataSet* data)
{
  vtkDataArray* array = FindScalars(mapper, data);
  if (!array || !array->GetLookupTable())
  {
    return data;
  }
  auto other = vtk::TakeSmartPointer(array->NewInstance());
  other->ShallowCopy(array);
  other->SetLookupTable(vtkLookupTable::SafeDownCast(CopyTable(array->GetLookupTable())));
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  copy->ShallowCopy(data);
  Replace(copy->GetPointData(), array, other);
  Replace(copy->GetCellData(), array, other);
  Replace(copy->GetFieldData(), array, other);
  return copy;
}
}

namespace
{
/// The names of the scalars that a table maps.
void NameScalars(vtkScalarsToColors* table, vtkDataArray* array, ColorMap& map)
{
  map.Array = array->GetName() ? array->GetName() : "";
  const int components = array->GetNumberOfComponents();
  const bool isMagnitude = table->GetVectorMode() == vtkScalarsToColors::MAGNITUDE;
  map.Component =
    NameComponent(array, isMagnitude && components > 1 ? -1 : table->GetVectorComponent());
}

/// Says what a table of a mapper maps that has that many colours within its range.
std::string DescribeTable(vtkScalarsToColors* table, vtkDataArray* array, int steps)
{
  ColorMap map;
  NameScalars(table, array, map);
  std::copy_n(table->GetRange(), 2, map.Range);
  map.IsLogarithmic = table->UsingLogScale() != 0;
  map.Colors.resize(std::size_t(steps) + 2);
  return DescribeColorMap(map);
}

/// The scalars that a table maps, and the map.
void AddScalars(vtkScalarsToColors* table, vtkDataArray* array, MappedScalars& mapped)
{
  const int components = array->GetNumberOfComponents();
  const int mode = table->GetVectorMode();
  ColorMap map = MakeColorMap(table);
  if (map.Colors.empty() || (components > 1 && mode == vtkScalarsToColors::RGBCOLORS))
  {
    return;
  }
  NameScalars(table, array, map);
  const bool isMagnitude = components > 1 && mode == vtkScalarsToColors::MAGNITUDE;
  const int component = std::clamp(table->GetVectorComponent(), 0, components - 1);
  mapped.Scalars = vtkSmartPointer<vtkDoubleArray>::New();
  mapped.Scalars->SetName(MapScalarName);
  std::vector<double> tuple(components);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    array->GetTuple(i, tuple.data());
    mapped.Scalars->InsertNextValue(
      isMagnitude ? vtkMath::Norm(tuple.data(), components) : tuple[component]);
  }
  mapped.ColorsOfScalars = std::move(map);
}
}

std::optional<std::array<double, 3>> FindColorOfMissing(vtkMapper* mapper, vtkDataSet* data)
{
  auto* composite = CompositeMapper::SafeDownCast(mapper);
  int cellFlag = 0;
  if (!composite || !composite->GetColorMissingArraysWithNanColor() ||
    !mapper->GetScalarVisibility() ||
    vtkAbstractMapper::GetAbstractScalars(data, mapper->GetScalarMode(),
      mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cellFlag))
  {
    return std::nullopt;
  }
  vtkScalarsToColors* table = mapper->GetLookupTable();
  const double* color = nullptr;
  if (auto* colors = vtkLookupTable::SafeDownCast(table))
  {
    color = colors->GetNanColor();
  }
  else if (auto* function = vtkColorTransferFunction::SafeDownCast(table))
  {
    color = function->GetNanColor();
  }
  if (!color)
  {
    return std::nullopt;
  }
  return std::array<double, 3>{ color[0], color[1], color[2] };
}

MappedScalars MapScalars(vtkMapper* mapper, vtkDataSet* data, bool useTable, ImportedScene& scene)
{
  MappedScalars mapped;
  if (!mapper->GetScalarVisibility())
  {
    return mapped;
  }
  if (NeedsEmptyTable(mapper, data))
  {
    scene.Omitted.insert("colors of a lookup table without values");
    return mapped;
  }
  vtkNew<ColorMapper> copy;
  copy->ShallowCopy(mapper);
  copy->ClearColorArrays();
  if (scene.HasExactColors)
  {
    copy->InterpolateScalarsBeforeMappingOn();
  }
  mapped.WantsTable = copy->CanUseTextureMapForColoring(data) != 0;
  if (!useTable)
  {
    copy->InterpolateScalarsBeforeMappingOff();
  }
  copy->SetLookupTable(CopyTable(mapper->GetLookupTable()));
  const vtkSmartPointer<vtkDataSet> source = CopyTableOfArray(mapper, data);
  int cellFlag = 0;
  vtkUnsignedCharArray* colors = copy->MapScalars(source, 1.0, cellFlag);
  mapped.Table = copy->GetColorTextureMap();
  mapped.Coordinates = copy->GetColorCoordinates();
  vtkDataArray* scalars = FindScalars(mapper, source);
  if (mapped.Table && scalars)
  {
    mapped.Map =
      DescribeTable(copy->GetLookupTable(), scalars, mapped.Table->GetDimensions()[0] - 2);
  }
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
    if (scalars && scalars->GetNumberOfTuples() == expected && !AreDirect(mapper, scalars))
    {
      AddScalars(copy->GetLookupTable(), scalars, mapped);
    }
  }
  return mapped;
}
}
