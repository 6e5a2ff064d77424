// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLegend.h"

#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkScalarsToColors.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace cslf
{
namespace
{
// The arrays of a legend: colours (RGBA), range (minimum, maximum, whether it is logarithmic), and,
// of categories, a value and a name for each colour.
const std::string ColorsPrefix = "CSLF:LegendColors:";
const std::string RangePrefix = "CSLF:LegendRange:";
const std::string CategoriesPrefix = "CSLF:LegendCategories:";

// Colours of a table that is not one of categories.
constexpr int NumberOfColors = 256;

bool IsLogarithmic(vtkScalarsToColors* table)
{
  return table->UsingLogScale() != 0 && table->GetRange()[0] > 0.0;
}

/// The values that a legend shows: in the middle of each of its colours.
std::vector<double> GetValues(vtkScalarsToColors* table)
{
  std::vector<double> values;
  double range[2] = { table->GetRange()[0], table->GetRange()[1] };
  const bool isLogarithmic = IsLogarithmic(table);
  if (isLogarithmic)
  {
    range[0] = std::log10(range[0]);
    range[1] = std::log10(range[1]);
  }
  for (int i = 0; i < NumberOfColors; ++i)
  {
    const double value = range[0] + (i + 0.5) / NumberOfColors * (range[1] - range[0]);
    values.push_back(isLogarithmic ? std::pow(10.0, value) : value);
  }
  return values;
}

void AddColor(vtkUnsignedCharArray* colors, const double color[4])
{
  for (int c = 0; c < 4; ++c)
  {
    colors->InsertNextValue(
      static_cast<unsigned char>(std::lround(255.0 * std::clamp(color[c], 0.0, 1.0))));
  }
}

vtkSmartPointer<vtkUnsignedCharArray> MakeColors(vtkScalarsToColors* table)
{
  table->Build();
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetNumberOfComponents(4);
  double color[4] = { 0.0, 0.0, 0.0, 1.0 };
  if (table->GetIndexedLookup())
  {
    for (vtkIdType i = 0; i < table->GetNumberOfAnnotatedValues(); ++i)
    {
      table->GetAnnotationColor(table->GetAnnotatedValue(i), color);
      AddColor(colors, color);
    }
    return colors;
  }
  for (const double value : GetValues(table))
  {
    table->GetColor(value, color);
    color[3] = table->GetOpacity(value);
    AddColor(colors, color);
  }
  return colors;
}

vtkSmartPointer<vtkStringArray> MakeCategories(vtkScalarsToColors* table)
{
  auto categories = vtkSmartPointer<vtkStringArray>::New();
  categories->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < table->GetNumberOfAnnotatedValues(); ++i)
  {
    categories->InsertNextValue(table->GetAnnotatedValue(i).ToString());
    categories->InsertNextValue(table->GetAnnotation(i));
  }
  return categories;
}

bool IsEqual(vtkAbstractArray* a, vtkAbstractArray* b)
{
  if (!a || !b || a->GetNumberOfValues() != b->GetNumberOfValues())
  {
    return !a && !b;
  }
  for (vtkIdType i = 0; i < a->GetNumberOfValues(); ++i)
  {
    if (a->GetVariantValue(i) != b->GetVariantValue(i))
    {
      return false;
    }
  }
  return true;
}

/// Adds the arrays of a legend, with a title that no different legend has.
void AddArrays(vtkFieldData* fields, const std::string& title, vtkAbstractArray* colors,
  vtkAbstractArray* range, vtkAbstractArray* categories)
{
  std::string unique = title;
  for (int number = 2; fields->HasArray((ColorsPrefix + unique).c_str()); ++number)
  {
    const auto find = [&](const std::string& prefix)
    { return fields->GetAbstractArray((prefix + unique).c_str()); };
    if (IsEqual(find(ColorsPrefix), colors) && IsEqual(find(RangePrefix), range) &&
      IsEqual(find(CategoriesPrefix), categories))
    {
      return;
    }
    unique = title + " (" + std::to_string(number) + ")";
  }
  const auto add = [&](const std::string& prefix, vtkAbstractArray* array)
  {
    auto copy = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
    copy->DeepCopy(array);
    copy->SetName((prefix + unique).c_str());
    fields->AddArray(copy);
  };
  add(ColorsPrefix, colors);
  add(RangePrefix, range);
  if (categories)
  {
    add(CategoriesPrefix, categories);
  }
}
}

std::string DescribeTable(vtkScalarsToColors* table)
{
  std::ostringstream text;
  text << std::setprecision(17) << table->GetRange()[0] << ' ' << table->GetRange()[1] << ' '
       << IsLogarithmic(table) << ' ' << table->GetVectorMode() << ' '
       << table->GetVectorComponent();
  const vtkSmartPointer<vtkUnsignedCharArray> colors = MakeColors(table);
  for (vtkIdType i = 0; i < colors->GetNumberOfValues(); ++i)
  {
    text << ' ' << int(colors->GetValue(i));
  }
  return text.str();
}

void AddLegend(vtkFieldData* fields, const std::string& title, vtkScalarsToColors* table)
{
  const vtkSmartPointer<vtkUnsignedCharArray> colors = MakeColors(table);
  if (colors->GetNumberOfTuples() == 0)
  {
    return;
  }
  vtkNew<vtkDoubleArray> range;
  range->InsertNextValue(table->GetRange()[0]);
  range->InsertNextValue(table->GetRange()[1]);
  range->InsertNextValue(IsLogarithmic(table) ? 1.0 : 0.0);
  AddArrays(fields, title, colors, range,
    table->GetIndexedLookup() ? MakeCategories(table).Get() : nullptr);
}

void CopyLegends(vtkDataObject* from, vtkFieldData* fields)
{
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(from))
  {
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      CopyLegends(leaf->GetCurrentDataObject(), fields);
    }
  }
  vtkFieldData* source = from ? from->GetFieldData() : nullptr;
  for (int i = 0; source && i < source->GetNumberOfArrays(); ++i)
  {
    const std::string name = source->GetArrayName(i) ? source->GetArrayName(i) : "";
    if (name.compare(0, ColorsPrefix.size(), ColorsPrefix) != 0)
    {
      continue;
    }
    const std::string title = name.substr(ColorsPrefix.size());
    vtkAbstractArray* range = source->GetAbstractArray((RangePrefix + title).c_str());
    if (range)
    {
      AddArrays(fields, title, source->GetAbstractArray(i), range,
        source->GetAbstractArray((CategoriesPrefix + title).c_str()));
    }
  }
}

std::vector<Legend> GetLegends(vtkFieldData* fields)
{
  std::vector<Legend> legends;
  for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
  {
    const std::string name = fields->GetArrayName(i) ? fields->GetArrayName(i) : "";
    const std::string title = name.compare(0, ColorsPrefix.size(), ColorsPrefix) == 0
      ? name.substr(ColorsPrefix.size())
      : "";
    auto* colors = vtkUnsignedCharArray::SafeDownCast(fields->GetAbstractArray(i));
    auto* range =
      vtkDoubleArray::SafeDownCast(fields->GetAbstractArray((RangePrefix + title).c_str()));
    if (!colors || colors->GetNumberOfComponents() != 4 || !range ||
      range->GetNumberOfValues() != 3)
    {
      continue;
    }
    vtkNew<vtkLookupTable> table;
    table->SetNumberOfTableValues(colors->GetNumberOfTuples());
    vtkNew<vtkUnsignedCharArray> own;
    own->DeepCopy(colors);
    table->SetTable(own);
    table->SetTableRange(range->GetValue(0), range->GetValue(1));
    if (range->GetValue(2) != 0.0)
    {
      table->SetScaleToLog10();
    }
    auto* categories =
      vtkStringArray::SafeDownCast(fields->GetAbstractArray((CategoriesPrefix + title).c_str()));
    if (categories)
    {
      table->IndexedLookupOn();
      for (vtkIdType c = 0; c + 1 < categories->GetNumberOfValues(); c += 2)
      {
        const std::string& label = categories->GetValue(c + 1);
        table->SetAnnotation(
          vtkVariant(categories->GetValue(c)), label.empty() ? categories->GetValue(c) : label);
      }
    }
    legends.push_back({ title, table.Get() });
  }
  return legends;
}
}
