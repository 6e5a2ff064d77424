// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneLook.h"

#include "Console/cslfMessages.h"
#include "Options/cslfNumberChecks.h"
#include "cslfJoin.h"
#include "vtkCSLFEnvironment.h"
#include "vtkCSLFLight.h"

#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <sstream>

namespace cslf::tool
{
namespace
{
constexpr int Magnitude = -1;
constexpr const char* NoArray = "none";

// Enough for any map to be continuous in 8 bits.
constexpr int TableSize = 1024;

// The colour of values that are not numbers.
constexpr double NanGray = 0.6;

using Levels = std::array<int, 3>; // of red, green and blue, from 0 to 255

/// Colours in equal distances, or what VTK makes itself.
struct ColorMapRow
{
  const char* Name;
  std::vector<Levels> Points;
};

/// The first is the default. Perceptually uniform maps are sampled where they bend.
const std::vector<ColorMapRow>& GetColorMaps()
{
  static const std::vector<ColorMapRow> maps = {
    { "cool-to-warm", { { 59, 76, 192 }, { 221, 221, 221 }, { 180, 4, 38 } } },
    { "viridis",
      { { 68, 1, 84 }, { 71, 44, 122 }, { 59, 81, 139 }, { 44, 113, 142 }, { 33, 144, 141 },
        { 39, 173, 129 }, { 92, 200, 99 }, { 170, 220, 50 }, { 253, 231, 37 } } },
    { "plasma",
      { { 13, 8, 135 }, { 84, 2, 163 }, { 139, 10, 165 }, { 185, 50, 137 }, { 219, 92, 104 },
        { 244, 136, 73 }, { 254, 188, 43 }, { 240, 249, 33 } } },
    { "inferno",
      { { 0, 0, 4 }, { 31, 12, 72 }, { 85, 15, 109 }, { 136, 34, 106 }, { 186, 54, 85 },
        { 227, 89, 51 }, { 249, 140, 10 }, { 249, 201, 50 }, { 252, 255, 164 } } },
    { "gray", { { 0, 0, 0 }, { 255, 255, 255 } } },
    { "rainbow", {} },
  };
  return maps;
}

const std::vector<std::string>& GetLightNames()
{
  static const std::vector<std::string> names = { "studio", "sun", "sky", "white", "none" };
  return names;
}

template <typename Rows>
std::vector<std::string> ListNames(const Rows& rows)
{
  std::vector<std::string> names;
  for (const auto& row : rows)
  {
    names.emplace_back(row.Name);
  }
  return names;
}

vtkSmartPointer<vtkLookupTable> MakeTable(const std::string& name, const double range[2])
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(TableSize);
  const auto& maps = GetColorMaps();
  const auto found = std::find_if(
    maps.begin(), maps.end(), [&name](const ColorMapRow& map) { return name == map.Name; });
  const std::vector<Levels>& points = found->Points;
  if (points.empty())
  {
    table->SetHueRange(0.667, 0.0);
    table->ForceBuild();
  }
  else
  {
    vtkNew<vtkColorTransferFunction> map;
    points.size() == 2     ? map->SetColorSpaceToRGB()
      : points.size() == 3 ? map->SetColorSpaceToDiverging()
                           : map->SetColorSpaceToLab();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      map->AddRGBPoint(static_cast<double>(i) / static_cast<double>(points.size() - 1),
        points[i][0] / 255.0, points[i][1] / 255.0, points[i][2] / 255.0);
    }
    for (int i = 0; i < TableSize; ++i)
    {
      double color[3];
      map->GetColor(i / (TableSize - 1.0), color);
      table->SetTableValue(i, color[0], color[1], color[2]);
    }
  }
  table->SetTableRange(range[0], range[1]);
  table->SetNanColor(NanGray, NanGray, NanGray, 1.0);
  return table;
}

bool HoldsColors(vtkDataArray* array)
{
  return vtkUnsignedCharArray::SafeDownCast(array) && array->GetNumberOfComponents() >= 3 &&
    array->GetNumberOfComponents() <= 4;
}

/// The array that the tracer shows: that of points before that of cells.
vtkDataArray* GetShown(vtkPolyData* surface)
{
  vtkDataArray* ofPoints = surface->GetPointData()->GetScalars();
  return ofPoints ? ofPoints : surface->GetCellData()->GetScalars();
}

void ShowNone(vtkPolyData* surface)
{
  surface->GetPointData()->SetActiveScalars(nullptr);
  surface->GetCellData()->SetActiveScalars(nullptr);
}

/// Shows an array of the points, or else of the cells; nothing if there is none of that name.
void Show(vtkPolyData* surface, const std::string& name)
{
  ShowNone(surface);
  vtkDataSetAttributes* ofPoints = surface->GetPointData();
  vtkDataSetAttributes* ofCells = surface->GetCellData();
  (ofPoints->GetArray(name.c_str()) ? ofPoints : ofCells)->SetActiveScalars(name.c_str());
}

/// Shows the levels of an array of colours as numbers.
void ShowAsNumbers(vtkPolyData* surface, vtkDataArray* colors)
{
  vtkNew<vtkFloatArray> numbers;
  numbers->DeepCopy(colors);
  const bool ofPoints = surface->GetPointData()->GetScalars() == colors;
  vtkDataSetAttributes* attributes = surface->GetCellData();
  if (ofPoints)
  {
    attributes = surface->GetPointData();
  }
  attributes->SetScalars(numbers);
}

/// The names of the numeric arrays, with their components if there are several.
std::string ListArrays(
  const std::vector<vtkPolyData*>& surfaces, bool ofCells, const std::string& title)
{
  std::set<std::string> names;
  for (vtkPolyData* surface : surfaces)
  {
    vtkDataSetAttributes* attributes = surface->GetPointData();
    if (ofCells)
    {
      attributes = surface->GetCellData();
    }
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

bool HasArray(const std::vector<vtkPolyData*>& surfaces, const std::string& name)
{
  return std::any_of(surfaces.begin(), surfaces.end(),
    [&name](vtkPolyData* surface)
    {
      return surface->GetPointData()->GetArray(name.c_str()) ||
        surface->GetCellData()->GetArray(name.c_str());
    });
}

[[noreturn]] void FailForArray(const std::vector<vtkPolyData*>& surfaces, const std::string& name)
{
  const std::string points = ListArrays(surfaces, false, "of points: ");
  const std::string cells = ListArrays(surfaces, true, "of cells: ");
  const std::string lists = points + (points.empty() || cells.empty() ? "" : "; ") + cells;
  throw Failure("There is no array " + name + " to colour by: " +
    (lists.empty() ? "the scene has no arrays." : "the scene has the arrays " + lists + "."));
}

/// The number of a component by its number, its letter or its own name.
int FindComponent(vtkDataArray* array, const std::string& text)
{
  const int count = array->GetNumberOfComponents();
  if (text == "magnitude")
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
  throw Failure("The array " + std::string(array->GetName()) + " has no component " + text +
    (count == 1 ? ": it has only one."
                : ": there are 0 to " + std::to_string(count - 1) +
          " (x, y, z for the first three) and magnitude."));
}

}

bool HasLights(vtkDataObject* data)
{
  const auto hasOwn = [](vtkDataObject* object)
  {
    vtkFieldData* fields = object->GetFieldData();
    return fields->HasArray(vtkCSLFLight::DirectionalLightDirection()) ||
      fields->HasArray(vtkCSLFLight::PointLightPosition()) ||
      fields->HasArray(vtkCSLFLight::SpotLightPosition());
  };
  bool isFound = hasOwn(data);
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    vtkSmartPointer<vtkDataObjectTreeIterator> leaf;
    leaf.TakeReference(tree->NewTreeIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      isFound = isFound || hasOwn(leaf->GetCurrentDataObject());
    }
  }
  return isFound;
}

void SceneLook::AddTo(CLI::App& command)
{
  const std::string group = "Look of scenes from files";
  command
    .add_option("--color-by", this->ColorBy,
      "the array that colours the surfaces, of points or else of cells; for one of its components, "
      "add a colon and its number, x, y, z, its name or magnitude: velocity:x; none: no array "
      "(default: the file's active scalars, if they vary)")
    ->option_text("ARRAY[:COMPONENT]")
    ->group(group);
  command
    .add_option("--color-map", this->ColorMap,
      "the colours of the array's values: cool-to-warm, viridis, plasma, inferno, gray or rainbow "
      "(default: cool-to-warm, or the file's own lookup table)")
    ->check(OneOf(ListNames(GetColorMaps())))
    ->type_name("NAME")
    ->group(group);
  command
    .add_option("--range", this->Range,
      "the values of the colour map's ends (default: the array's smallest and largest value)")
    ->expected(2)
    ->check(Finite())
    ->type_name("MIN MAX")
    ->group(group);
  command
    .add_option("--light", this->Light,
      "the light: studio (soft, from above on the left), sun (a sky and a sun with sharp shadows), "
      "sky (white above, dark below), white (the same from everywhere) or none (default: studio; a "
      "dim sky for files with lights; scenes by name have their own light)")
    ->check(OneOf(GetLightNames()))
    ->type_name("PRESET")
    ->group(group);
  command
    .add_option("--up", this->Up,
      "the axis of the scene that points up: x, y, z, -x, -y or -z; light and first view follow it "
      "(default: y)")
    ->check(OneOf({ "x", "y", "z", "-x", "-y", "-z" }))
    ->type_name("AXIS")
    ->group(group);
}

nlohmann::json SceneLook::SetColors(const std::vector<vtkPolyData*>& surfaces) const
{
  if (this->Range.size() == 2 && !(this->Range[0] < this->Range[1]))
  {
    throw Failure("The first number of --range must be smaller than the second.");
  }
  const std::optional<int> component =
    this->ColorBy.empty() ? std::nullopt : this->ChooseArray(surfaces);
  const bool isForced = !this->ColorMap.empty() || !this->Range.empty();
  std::map<std::string, std::vector<vtkDataArray*>> shown;
  for (vtkPolyData* surface : surfaces)
  {
    vtkDataArray* array = GetShown(surface);
    if (array && !HoldsColors(array) && (!array->GetLookupTable() || isForced))
    {
      shown[array->GetName() ? array->GetName() : ""].push_back(array);
    }
  }
  nlohmann::json legend = nlohmann::json::array();
  for (const auto& [name, arrays] : shown)
  {
    const nlohmann::json row = this->MapArrays(name, arrays, component);
    if (!row.is_null())
    {
      legend.push_back(row);
    }
  }
  // The base colour is better than an arbitrary one.
  for (vtkPolyData* surface : surfaces)
  {
    vtkDataArray* array = GetShown(surface);
    if (array && !HoldsColors(array) && !array->GetLookupTable())
    {
      ShowNone(surface);
    }
  }
  return legend;
}

/// Shows the array of --color-by on all surfaces. Returns the component, if one is chosen.
std::optional<int> SceneLook::ChooseArray(const std::vector<vtkPolyData*>& surfaces) const
{
  std::string name = this->ColorBy;
  std::string component;
  const std::size_t colon = name.rfind(':');
  if (!HasArray(surfaces, name) && colon != std::string::npos &&
    HasArray(surfaces, name.substr(0, colon)))
  {
    component = name.substr(colon + 1);
    name.resize(colon);
  }
  if (name != NoArray && !HasArray(surfaces, name))
  {
    FailForArray(surfaces, name);
  }
  std::optional<int> chosen;
  for (vtkPolyData* surface : surfaces)
  {
    Show(surface, name);
    vtkDataArray* array = GetShown(surface);
    if (array && !component.empty())
    {
      chosen = FindComponent(array, component);
      if (HoldsColors(array))
      {
        ShowAsNumbers(surface, array);
      }
    }
  }
  return chosen;
}

/// Gives arrays of one name one lookup table, and returns its line in the legend. Without a choice
/// of the user, arrays of one value get none.
nlohmann::json SceneLook::MapArrays(const std::string& name,
  const std::vector<vtkDataArray*>& arrays, std::optional<int> chosen) const
{
  const int components = arrays.front()->GetNumberOfComponents();
  const int component = chosen.value_or(components > 1 ? Magnitude : 0);
  double range[2] = { std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest() };
  for (vtkDataArray* array : arrays)
  {
    double own[2];
    array->GetFiniteRange(own, array->GetNumberOfComponents() > 1 ? component : 0);
    range[0] = std::min(range[0], own[0]);
    range[1] = std::max(range[1], own[1]);
  }
  const bool varies = range[0] < range[1];
  if (!this->Range.empty())
  {
    std::copy_n(this->Range.begin(), 2, range);
  }
  else if (!varies && this->ColorBy.empty())
  {
    return nullptr;
  }
  else if (!varies)
  {
    // One value has the colour in the middle.
    const double value = range[0] == range[1] ? range[0] : 0.0;
    const double half = std::max(0.5, std::abs(value) * 1e-6);
    range[0] = value - half;
    range[1] = value + half;
  }
  const std::string map = this->ColorMap.empty() ? GetColorMaps().front().Name : this->ColorMap;
  const auto table = MakeTable(map, range);
  component == Magnitude ? table->SetVectorModeToMagnitude() : table->SetVectorModeToComponent();
  table->SetVectorComponent(std::max(component, 0));
  for (vtkDataArray* array : arrays)
  {
    array->SetLookupTable(table);
  }
  nlohmann::json row = { { "array", name }, { "range", { range[0], range[1] } }, { "map", map } };
  if (components > 1)
  {
    row["component"] = component == Magnitude ? "magnitude" : std::to_string(component);
  }
  return row;
}

std::string DescribeLegend(const nlohmann::json& legend)
{
  std::ostringstream text;
  for (const nlohmann::json& row : legend)
  {
    text << "coloured by " << row["array"].get<std::string>();
    if (row.contains("component"))
    {
      text << ":" << row["component"].get<std::string>();
    }
    text << ", " << row["map"].get<std::string>() << " from " << row["range"][0].get<double>()
         << " to " << row["range"][1].get<double>() << "\n";
  }
  return text.str();
}

SceneAxes SceneLook::GetAxes() const
{
  const bool isDown = !this->Up.empty() && this->Up[0] == '-';
  const char axis = this->Up.empty() ? 'y' : this->Up.back();
  glm::dvec3 up(0.0);
  up[axis - 'x'] = isDown ? -1.0 : 1.0;
  const glm::dvec3 right = axis == 'x' ? glm::dvec3(0.0, -up.x, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  return { right, up, glm::cross(right, up) };
}

void SceneLook::SetUpSky(bool hasLights, vtkCSLFEnvironment* sky) const
{
  const std::string light = !this->Light.empty() ? this->Light : hasLights ? "fill" : "studio";
  const SceneAxes axes = this->GetAxes();
  glm::dvec3 up = axes.Up;
  double top = 1.0;
  double bottom = 0.2;
  if (light == "studio")
  {
    // The bright side is above, on the left and a little in front, so that the three sides of a box
    // that a view shows differ.
    up = axes.Get({ -0.55, 0.75, 0.4 });
    bottom = 0.15;
  }
  else if (light == "sun")
  {
    top = 0.65;
    bottom = 0.35;
  }
  else if (light == "fill")
  {
    top = 0.5;
    bottom = 0.3;
  }
  sky->SetMode(light == "none" ? vtkCSLFEnvironment::NoEnvironment
      : light == "white"       ? vtkCSLFEnvironment::ConstantEnvironment
                               : vtkCSLFEnvironment::GradientEnvironment);
  sky->SetFileName(nullptr);
  sky->SetColor(top, top, top);
  sky->SetBottomColor(bottom, bottom, bottom);
  sky->SetUp(up.x, up.y, up.z);
}

vtkSmartPointer<vtkDataObject> SceneLook::MakeLights() const
{
  if (this->Light != "sun")
  {
    return nullptr;
  }
  const glm::dvec3 direction = -this->GetAxes().Get({ -0.5, 0.75, 0.6 });
  const double towards[3] = { direction.x, direction.y, direction.z };
  const double irradiance = 0.75 * vtkMath::Pi();
  const double white[3] = { irradiance, irradiance, irradiance };
  auto lights = vtkSmartPointer<vtkPolyData>::New();
  vtkCSLFLight::AddDirectionalLight(lights, towards, white);
  return lights;
}
}
