// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceColoring.h"

#include "Options/cslfOptionTable.h"
#include "cslfJoin.h"
#include "cslfNamedColorMaps.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>

namespace cslf
{
namespace
{
constexpr int Magnitude = -1;
constexpr const char* MagnitudeName = "magnitude";
constexpr const char* NoArray = "none";
constexpr int AutomaticColors = 0;

///@{
/// The columns of a legend.
constexpr const char* ArrayColumn = "array";
constexpr const char* ComponentColumn = "component";
constexpr const char* MinimumColumn = "minimum";
constexpr const char* MaximumColumn = "maximum";
constexpr const char* MapColumn = "map";
///@}

std::string GetName(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

bool HoldsColors(vtkDataArray* array)
{
  return vtkUnsignedCharArray::SafeDownCast(array) && array->GetNumberOfComponents() >= 3 &&
    array->GetNumberOfComponents() <= 4;
}

vtkDataSetAttributes* GetAttributes(vtkPolyData* surface, bool ofCells)
{
  vtkDataSetAttributes* ofPoints = surface->GetPointData();
  return ofCells ? surface->GetCellData() : ofPoints;
}

/// Where the array is that the tracer shows: that of points before that of cells.
vtkDataSetAttributes* GetShownAttributes(vtkPolyData* surface)
{
  return GetAttributes(surface, surface->GetPointData()->GetScalars() == nullptr);
}

vtkDataArray* GetShown(vtkPolyData* surface)
{
  return GetShownAttributes(surface)->GetScalars();
}

void ShowNone(vtkPolyData* surface)
{
  surface->GetPointData()->SetActiveScalars(nullptr);
  surface->GetCellData()->SetActiveScalars(nullptr);
}

bool Holds(vtkDataSetAttributes* attributes, const std::string& name)
{
  return attributes->GetArray(name.c_str()) != nullptr;
}

/// Shows an array of the points, or else of the cells; nothing if there is none of that name.
void Show(vtkPolyData* surface, const std::string& name)
{
  ShowNone(surface);
  GetAttributes(surface, !Holds(surface->GetPointData(), name))->SetActiveScalars(name.c_str());
}

/// Gives the shown array a lookup table, in a copy that shares its values.
void SetTable(vtkPolyData* surface, vtkLookupTable* table)
{
  vtkDataSetAttributes* attributes = GetShownAttributes(surface);
  vtkDataArray* array = attributes->GetScalars();
  auto copy = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  copy->ShallowCopy(array);
  copy->SetName(array->GetName());
  copy->SetLookupTable(table);
  // Replacing an array by its name keeps its other uses, such as vectors.
  array->GetName() ? attributes->AddArray(copy) : attributes->SetScalars(copy);
}

/// The number of a component by its number, its letter or its own name.
int FindComponent(vtkDataArray* array, const std::string& text)
{
  const int count = array->GetNumberOfComponents();
  if (text == MagnitudeName)
  {
    return Magnitude;
  }
  for (int i = 0; i < count; ++i)
  {
    const char* own = array->GetComponentName(i);
    const bool isLetter = text.size() == 1 && i < 3 && text[0] == "xyz"[i];
    if (text == std::to_string(i) || isLetter || (own && text == own))
    {
      return i;
    }
  }
  throw LookError("The array " + GetName(array) + " has no component " + text +
    (count == 1 ? ": it has only one."
                : ": there are 0 to " + std::to_string(count - 1) +
          " (x, y, z for the first three) and magnitude."));
}

template <typename Array>
void AddColumn(vtkTable* legend, const char* name)
{
  vtkNew<Array> column;
  column->SetName(name);
  legend->AddColumn(column);
}
}

void ClearLegend(vtkTable* legend)
{
  legend->Initialize();
  AddColumn<vtkStringArray>(legend, ArrayColumn);
  AddColumn<vtkStringArray>(legend, ComponentColumn);
  AddColumn<vtkDoubleArray>(legend, MinimumColumn);
  AddColumn<vtkDoubleArray>(legend, MaximumColumn);
  AddColumn<vtkStringArray>(legend, MapColumn);
}

void SurfaceColoring::Apply(vtkTable* legend)
{
  if (this->Range &&
    !(std::isfinite(this->Range[0]) && std::isfinite(this->Range[1]) &&
      this->Range[0] < this->Range[1]))
  {
    throw LookError("The first number of ColorRange must be smaller than the second, and both "
                    "must be finite.");
  }
  this->ChooseArrays();
  const bool isForced = this->ColorMap != AutomaticColors || this->Range;
  std::map<std::string, std::vector<vtkPolyData*>> shown;
  for (vtkPolyData* surface : this->Surfaces)
  {
    vtkDataArray* array = GetShown(surface);
    if (array && !HoldsColors(array) && (!array->GetLookupTable() || isForced))
    {
      shown[GetName(array)].push_back(surface);
    }
  }
  for (const auto& [name, surfaces] : shown)
  {
    this->MapArrays(name, surfaces, legend);
  }
  // The base colour is better than an arbitrary one.
  for (vtkPolyData* surface : this->Surfaces)
  {
    vtkDataArray* array = GetShown(surface);
    if (array && !HoldsColors(array) && !array->GetLookupTable())
    {
      ShowNone(surface);
    }
  }
}

/// Shows the array of that name on all surfaces, and finds the component.
void SurfaceColoring::ChooseArrays()
{
  const std::size_t colon = this->ArrayName.rfind(':');
  if (this->ComponentName.empty() && colon != std::string::npos &&
    !this->HasArray(this->ArrayName) && this->HasArray(this->ArrayName.substr(0, colon)))
  {
    this->ComponentName = this->ArrayName.substr(colon + 1);
    this->ArrayName.resize(colon);
  }
  if (!this->ArrayName.empty() && this->ArrayName != NoArray && !this->HasArray(this->ArrayName))
  {
    this->FailForArray();
  }
  for (vtkPolyData* surface : this->Surfaces)
  {
    if (!this->ArrayName.empty())
    {
      Show(surface, this->ArrayName);
    }
    vtkDataArray* array = GetShown(surface);
    if (array && !this->ComponentName.empty())
    {
      this->Component = FindComponent(array, this->ComponentName);
      if (HoldsColors(array))
      {
        // As numbers, not as colours.
        vtkNew<vtkFloatArray> numbers;
        numbers->DeepCopy(array);
        GetShownAttributes(surface)->SetScalars(numbers);
      }
    }
  }
}

bool SurfaceColoring::HasArray(const std::string& name) const
{
  return std::any_of(this->Surfaces.begin(), this->Surfaces.end(),
    [&name](vtkPolyData* surface)
    { return Holds(surface->GetPointData(), name) || Holds(surface->GetCellData(), name); });
}

void SurfaceColoring::FailForArray() const
{
  const std::string points = this->ListArrays(false, "of points: ");
  const std::string cells = this->ListArrays(true, "of cells: ");
  const std::string lists = points + (points.empty() || cells.empty() ? "" : "; ") + cells;
  throw LookError("There is no array " + this->ArrayName + " to colour by: " +
    (lists.empty() ? "the scene has no arrays." : "the scene has the arrays " + lists + "."));
}

/// The names of the numeric arrays, with their components if there are several.
std::string SurfaceColoring::ListArrays(bool ofCells, const std::string& title) const
{
  std::set<std::string> names;
  for (vtkPolyData* surface : this->Surfaces)
  {
    vtkDataSetAttributes* attributes = GetAttributes(surface, ofCells);
    for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
    {
      vtkDataArray* array = attributes->GetArray(i);
      if (array && array->GetName())
      {
        const int components = array->GetNumberOfComponents();
        names.insert(array->GetName() +
          (components > 1 ? " (" + std::to_string(components) + " components)" : ""));
      }
    }
  }
  return names.empty() ? "" : title + Join(names);
}

/// Gives arrays of one name one lookup table, and adds it to the legend. Without a choice of the
/// user, arrays of one value get none.
void SurfaceColoring::MapArrays(
  const std::string& name, const std::vector<vtkPolyData*>& surfaces, vtkTable* legend) const
{
  const int components = GetShown(surfaces.front())->GetNumberOfComponents();
  const int component = !this->ComponentName.empty() ? this->Component
    : components > 1                                 ? Magnitude
                                                     : 0;
  double range[2] = { std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest() };
  for (vtkPolyData* surface : surfaces)
  {
    vtkDataArray* array = GetShown(surface);
    double own[2];
    array->GetFiniteRange(own, array->GetNumberOfComponents() > 1 ? component : 0);
    range[0] = std::min(range[0], own[0]);
    range[1] = std::max(range[1], own[1]);
  }
  if (this->GrowingRanges && range[0] <= range[1])
  {
    auto& grown =
      this->GrowingRanges->try_emplace(name, std::array{ range[0], range[1] }).first->second;
    range[0] = grown[0] = std::min(grown[0], range[0]);
    range[1] = grown[1] = std::max(grown[1], range[1]);
  }
  const bool varies = range[0] < range[1];
  if (this->Range)
  {
    std::copy_n(this->Range, 2, range);
  }
  else if (!varies && this->ArrayName.empty() && this->ComponentName.empty())
  {
    return;
  }
  else if (!varies)
  {
    // One value has the colour in the middle.
    const double value = range[0] == range[1] ? range[0] : 0.0;
    const double half = std::max(0.5, std::abs(value) * 1e-6);
    range[0] = value - half;
    range[1] = value + half;
  }
  vtkNew<vtkLookupTable> table;
  const char* map = SetUpLookupTable(this->ColorMap, table);
  table->SetTableRange(range);
  component == Magnitude ? table->SetVectorModeToMagnitude() : table->SetVectorModeToComponent();
  table->SetVectorComponent(std::max(component, 0));
  for (vtkPolyData* surface : surfaces)
  {
    SetTable(surface, table);
  }
  const std::string shown = components == 1 ? ""
    : component == Magnitude                ? MagnitudeName
                                            : std::to_string(component);
  const vtkIdType row = legend->InsertNextBlankRow();
  legend->SetValueByName(row, ArrayColumn, name.c_str());
  legend->SetValueByName(row, ComponentColumn, shown.c_str());
  legend->SetValueByName(row, MinimumColumn, range[0]);
  legend->SetValueByName(row, MaximumColumn, range[1]);
  legend->SetValueByName(row, MapColumn, map);
}
}
