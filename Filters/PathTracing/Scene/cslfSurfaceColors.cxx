// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceColors.h"

#include "SceneData/cslfTextureImage.h"
#include "cslfColor.h"
#include "cslfFingerprint.h"

#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDiscretizableColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkScalarsToColors.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
// The largest number of steps of a table as a texture. Tables of continuous colours have it.
constexpr int MaximumSteps = 4096;

// The distance of values in the range from its ends, as a fraction of the texture, so that floats
// never round them to values outside.
constexpr double Inset = 1e-6;

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

vtkScalarsToColors* SurfaceColors::GetTable(vtkDataArray* array)
{
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
  return table;
}

vtkSmartPointer<vtkUnsignedCharArray> SurfaceColors::MapThroughTable(vtkDataArray* array)
{
  const std::lock_guard<std::mutex> lock(this->Mapping);
  vtkScalarsToColors* table = this->GetTable(array);
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

double SurfaceColors::Scale::GetPosition(double value) const
{
  const auto convert = [this](double number)
  { return this->IsLogarithmic ? std::log10(std::max(number, VTK_DBL_MIN)) : number; };
  const double first = convert(this->Range[0]);
  return (convert(value) - first) / (convert(this->Range[1]) - first);
}

glm::vec2 SurfaceColors::Scale::GetPlace(double value) const
{
  if (std::isnan(value))
  {
    return { 0.0f, 0.75f };
  }
  double column = 1.0 + this->Steps * this->GetPosition(value);
  if (value >= this->Range[0] && value <= this->Range[1])
  {
    const double inset = Inset * (this->Steps + 2);
    column = std::clamp(column, 1.0 + inset, 1.0 + this->Steps - inset);
  }
  // Far outside, it must remain a number that floats can interpolate.
  const double place = std::clamp(column / (this->Steps + 2), -1e6, 1e6);
  return { static_cast<float>(place), 0.25f };
}

SurfaceColors::Scale SurfaceColors::MakeScale(vtkScalarsToColors* table)
{
  Scale scale;
  std::copy_n(table->GetRange(), 2, scale.Range);
  scale.IsLogarithmic = table->UsingLogScale() != 0;
  const bool isValid = scale.Range[0] < scale.Range[1] &&
    std::isfinite(scale.Range[1] - scale.Range[0]) &&
    !(scale.IsLogarithmic && scale.Range[0] <= 0.0);
  if (!isValid)
  {
    return scale;
  }
  const vtkIdType colors = table->GetNumberOfAvailableColors();
  scale.Steps = colors > 0 && colors <= MaximumSteps ? static_cast<int>(colors) : MaximumSteps;
  const int columns = scale.Steps + 2;
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfTuples(2 * columns);
  for (int i = 0; i < columns; ++i)
  {
    double part = (i - 0.5) / scale.Steps;
    part = i == 0 ? -1.0 : i == columns - 1 ? 2.0 : part;
    values->SetValue(i,
      scale.IsLogarithmic ? scale.Range[0] * std::pow(scale.Range[1] / scale.Range[0], part)
                          : scale.Range[0] + part * (scale.Range[1] - scale.Range[0]));
    values->SetValue(columns + i, vtkMath::Nan());
  }
  const auto mapped =
    vtk::TakeSmartPointer(table->MapScalars(values, VTK_COLOR_MODE_MAP_SCALARS, 0, VTK_RGBA));
  TextureImage image;
  image.Width = columns;
  image.Height = 2;
  image.Wraps[0] = TextureWrap::Edge;
  image.Wraps[1] = TextureWrap::Edge;
  image.Interpolate = false;
  image.Pixels.assign(
    mapped->GetPointer(0), mapped->GetPointer(0) + 4 * mapped->GetNumberOfTuples());
  Fingerprint name;
  name.Add(image.Pixels);
  scale.Name = name.Finish();
  scale.Colors = std::make_shared<const Texture>(std::move(image), TextureKind::Colors);
  return scale;
}

MappedTable SurfaceColors::FindPlaces(vtkDataArray* array)
{
  MappedTable result;
  if (HoldsColors(array))
  {
    return result;
  }
  const std::lock_guard<std::mutex> lock(this->Mapping);
  vtkScalarsToColors* table = this->GetTable(array);
  const int components = array->GetNumberOfComponents();
  const int mode = table->GetVectorMode();
  if (table->GetIndexedLookup() || (components > 1 && mode == vtkScalarsToColors::RGBCOLORS))
  {
    return result;
  }
  const auto known = this->Scales.find(table);
  const Scale& scale =
    known != this->Scales.end() ? known->second : this->Scales[table] = MakeScale(table);
  if (!scale.Colors)
  {
    return result;
  }
  result.Colors = scale.Colors;
  result.Name = scale.Name;
  result.Places.reserve(array->GetNumberOfTuples());
  const int component = std::clamp(table->GetVectorComponent(), 0, components - 1);
  std::vector<double> tuple(components);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    array->GetTuple(i, tuple.data());
    const bool isVector = components > 1 && mode == vtkScalarsToColors::MAGNITUDE;
    result.Places.push_back(
      scale.GetPlace(isVector ? vtkMath::Norm(tuple.data(), components) : tuple[component]));
  }
  return result;
}
}
