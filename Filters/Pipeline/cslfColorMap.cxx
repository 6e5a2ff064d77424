// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfColorMap.h"

#include "cslfChannel.h"
#include "cslfColor.h"
#include "cslfGeometryArrays.h"
#include "cslfJSONText.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkScalarsToColors.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <map>
#include <stdexcept>

namespace cslf
{
namespace
{
/// The largest number of steps of a map: those of VTK's textures of continuous colours.
constexpr int MaximumSteps = 8190;

/// The steps of a map of continuous colours.
constexpr int ContinuousSteps = 4096;

/// The distance of values in the range from its ends, as a share of the map, so that floats never
/// round them to values outside.
constexpr double Inset = 1e-6;

/// Changes of colours count over one of so many parts of the range.
constexpr int SteepnessWindows = 128;

/// Places that are so near to the beginning of a step are there.
constexpr double SnapDistance = 1e-7;

/// What rounding to floats may add to a scalar, as a share of it.
constexpr double FloatStep = 0x1p-24;

/// Far outside of the range, a place must remain a number that floats can interpolate.
constexpr double MaximumColumn = 1e6;

constexpr const char* ArrayKey = "array";
constexpr const char* ComponentKey = "component";
constexpr const char* RangeKey = "range";
constexpr const char* LogarithmicKey = "logarithmic";
constexpr const char* StepsKey = "steps";
constexpr const char* ImageKey = "image";

/// What lies at the value 0 of a logarithmic range.
double ToScale(double value, bool isLogarithmic)
{
  return isLogarithmic ? std::log10(std::max(value, VTK_DBL_MIN)) : value;
}

ColorMap::Pixel ToPixel(const unsigned char* color)
{
  return { color[0], color[1], color[2], color[3] };
}

bool IsValid(const double range[2], bool isLogarithmic)
{
  return range[0] < range[1] && std::isfinite(range[1] - range[0]) &&
    !(isLogarithmic && range[0] <= 0.0);
}

vtkSmartPointer<vtkFloatArray> MakeLight(const char* name, const std::vector<glm::vec3>& codes)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(codes.size()));
  for (std::size_t i = 0; i < codes.size(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      array->SetTypedComponent(static_cast<vtkIdType>(i), c, float(SRGBToLinear(codes[i][c])));
    }
  }
  return array;
}

/// An array of point data with so many components, or null.
vtkDataArray* FindArray(vtkPolyData* geometry, const std::string& name, int components)
{
  vtkDataArray* array = geometry->GetPointData()->GetArray(name.c_str());
  const bool fits = array && array->GetNumberOfComponents() == components &&
    array->GetNumberOfTuples() == geometry->GetNumberOfPoints();
  return fits ? array : nullptr;
}

}

bool ColorMap::IsOpaque() const
{
  return this->IsImage() ||
    (this->NanColor[3] == 255 &&
      std::all_of(this->Colors.begin(), this->Colors.end(),
        [](const Pixel& color) { return color[3] == 255; }));
}

std::string ColorMap::GetScalarName() const
{
  const std::string name = this->Array.empty() ? "Scalars" : this->Array;
  return this->Component.empty() ? NameScalars(name) : name + " " + this->Component;
}

glm::dvec2 ColorMap::GetPlace(double value) const
{
  const int steps = this->GetSteps();
  if (this->IsOneColor)
  {
    return { 1.5, 0.0 };
  }
  if (std::isnan(value))
  {
    return { 0.5 * (steps + 2), 1.0 };
  }
  const double first = ToScale(this->Range[0], this->IsLogarithmic);
  const double last = ToScale(this->Range[1], this->IsLogarithmic);
  double column = 1.0 + steps * (ToScale(value, this->IsLogarithmic) - first) / (last - first);
  const double rounding = FloatStep * std::max(std::abs(this->Range[0]), std::abs(this->Range[1]));
  if (value >= this->Range[0] - rounding && value <= this->Range[1] + rounding)
  {
    const double inset = Inset * (steps + 2);
    column = std::clamp(column, 1.0 + inset, 1.0 + steps - inset);
  }
  // Rounding must not take a value from one step to the next.
  const double whole = std::round(column);
  column = std::abs(column - whole) < SnapDistance ? whole : column;
  return { std::clamp(column, -MaximumColumn, MaximumColumn), 0.0 };
}

double ColorMap::GetValue(const glm::dvec2& place) const
{
  if (place.y > 0.5)
  {
    return vtkMath::Nan();
  }
  const double first = ToScale(this->Range[0], this->IsLogarithmic);
  const double last = ToScale(this->Range[1], this->IsLogarithmic);
  const double value = first + (place.x - 1.0) / this->GetSteps() * (last - first);
  return this->IsLogarithmic ? std::pow(10.0, value) : value;
}

double ColorMap::GetSteepness() const
{
  const int window = std::max(1, this->GetSteps() / SteepnessWindows);
  double most = 0.0;
  for (int i = 1; i + window <= this->GetSteps(); ++i)
  {
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      const double change = (this->Colors[i + window][c] - this->Colors[i][c]) / 255.0;
      sum += change * change / 3.0;
    }
    most = std::max(most, sum);
  }
  // The steps of few colours are edges, whose place counts, not their height.
  const double columns = std::max(double(window), double(this->GetSteps()) / SteepnessWindows);
  return std::sqrt(most) / columns;
}

glm::vec3 ColorMap::GetColor(const glm::dvec2& place) const
{
  if (this->Image)
  {
    return this->Image->GetColor(place);
  }
  const auto last = static_cast<double>(this->Colors.size() - 1);
  const auto column = static_cast<std::size_t>(std::clamp(std::floor(place.x), 0.0, last));
  const Pixel& color = place.y > NanShare ? this->NanColor : this->Colors[column];
  return SRGBToLinear(glm::dvec3(color[0], color[1], color[2]) / 255.0);
}

std::string NameScalars(const std::string& array)
{
  const bool isTaken = array == ColorName || array == BackColorName || array == ExactColorName ||
    array == LightName || array == BackLightName || array == ColorMapName;
  return isTaken ? array + " (scalars)" : array;
}

const SurfaceArray* MappedPoints::FindTexturePlaces() const
{
  for (const SurfaceArray& array : this->Arrays)
  {
    if (array.Name == TexturePlacesName && array.Components.size() == 2)
    {
      return &array;
    }
  }
  return nullptr;
}

glm::dvec2 MappedPoints::GetTexturePlace(std::size_t point) const
{
  const double steps = this->GetMap(point).Layout.Steps;
  const SurfaceArray& places = *this->FindTexturePlaces();
  return glm::dvec2(places.Components[0].Values[point], places.Components[1].Values[point]) / steps;
}

ColorMap MakeImageMap(std::shared_ptr<const MapImage> image)
{
  ColorMap map;
  map.Layout = image->GetLayout();
  map.Image = std::move(image);
  return map;
}

ColorMap MakeOneColor(const ColorMap::Pixel& color)
{
  ColorMap map;
  map.IsOneColor = true;
  map.Colors.assign(3, color);
  map.NanColor = color;
  return map;
}

ColorMap MakeColorMap(vtkScalarsToColors* table)
{
  ColorMap map;
  table->Build();
  std::copy_n(table->GetRange(), 2, map.Range);
  map.IsLogarithmic = table->UsingLogScale() != 0;
  if (table->GetIndexedLookup() || !IsValid(map.Range, map.IsLogarithmic))
  {
    return map;
  }
  const vtkIdType count = table->GetNumberOfAvailableColors();
  const int steps =
    count > 0 && count <= ContinuousSteps ? static_cast<int>(count) : ContinuousSteps;
  vtkNew<vtkDoubleArray> values;
  for (int i = 0; i < steps + 2; ++i)
  {
    double part = (i - 0.5) / steps;
    part = i == 0 ? -1.0 : i == steps + 1 ? 2.0 : part;
    values->InsertNextValue(map.IsLogarithmic
        ? map.Range[0] * std::pow(map.Range[1] / map.Range[0], part)
        : map.Range[0] + part * (map.Range[1] - map.Range[0]));
  }
  values->InsertNextValue(vtkMath::Nan());
  const auto mapped =
    vtk::TakeSmartPointer(table->MapScalars(values, VTK_COLOR_MODE_MAP_SCALARS, 0, VTK_RGBA));
  for (vtkIdType i = 0; i < steps + 2; ++i)
  {
    map.Colors.push_back(ToPixel(mapped->GetPointer(4 * i)));
  }
  map.NanColor = ToPixel(mapped->GetPointer(4 * (vtkIdType(steps) + 2)));
  return map;
}

std::string NameComponent(vtkDataArray* array, int component)
{
  if (array->GetNumberOfComponents() < 2)
  {
    return "";
  }
  if (component < 0)
  {
    return MagnitudeName;
  }
  const char* name = array->GetComponentName(component);
  return name ? name : std::to_string(component);
}

void UpdateLookupTable(const ColorMap& map, vtkLookupTable* table)
{
  const auto set = [](const ColorMap::Pixel& color, double value[4])
  {
    for (int c = 0; c < 4; ++c)
    {
      value[c] = color[c] / 255.0;
    }
  };
  table->SetNumberOfTableValues(map.GetSteps());
  double value[4];
  for (int i = 0; i < map.GetSteps(); ++i)
  {
    set(map.Colors[i + 1], value);
    table->SetTableValue(i, value);
  }
  table->SetScaleToLinear(); // allows all ranges
  table->SetTableRange(map.Range[0], map.Range[1]);
  map.IsLogarithmic ? table->SetScaleToLog10() : table->SetScaleToLinear();
  set(map.Colors.front(), value);
  table->SetBelowRangeColor(value);
  table->UseBelowRangeColorOn();
  set(map.Colors.back(), value);
  table->SetAboveRangeColor(value);
  table->UseAboveRangeColorOn();
  set(map.NanColor, value);
  table->SetNanColor(value);
}

vtkSmartPointer<vtkLookupTable> MakeLookupTable(const ColorMap& map)
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  UpdateLookupTable(map, table);
  return table;
}

std::string DescribeColorMap(const ColorMap& map)
{
  if (map.IsImage())
  {
    nlohmann::json text;
    MapImage::Describe(map.Layout, text[ImageKey]);
    return text.dump();
  }
  nlohmann::json text = { { RangeKey, { map.Range[0], map.Range[1] } },
    { StepsKey, map.GetSteps() } };
  if (!map.IsOneColor)
  {
    text[ArrayKey] = map.Array;
  }
  if (!map.Component.empty())
  {
    text[ComponentKey] = map.Component;
  }
  if (map.IsLogarithmic)
  {
    text[LogarithmicKey] = true;
  }
  return text.dump();
}

ColorMap ReadColorMap(const std::string& text)
{
  const nlohmann::json from = ParseJSON(text);
  ColorMap map;
  if (from.contains(ImageKey))
  {
    map.Layout = MapImage::ReadLayout(from.at(ImageKey));
    return map;
  }
  map.IsOneColor = !from.contains(ArrayKey);
  map.Array = from.value(ArrayKey, std::string());
  map.Component = from.value(ComponentKey, std::string());
  map.IsLogarithmic = from.value(LogarithmicKey, false);
  const auto range = from.at(RangeKey).get<std::array<double, 2>>();
  std::copy(range.begin(), range.end(), map.Range);
  const int steps = from.at(StepsKey).get<int>();
  if (steps < 1 || steps > MaximumSteps || !IsValid(map.Range, map.IsLogarithmic) ||
    (map.IsOneColor && steps > 1))
  {
    throw std::invalid_argument("a color map is invalid");
  }
  map.Colors.resize(std::size_t(steps) + 2);
  return map;
}

glm::dvec3 ShowLight(const glm::dvec3& light, const ColorMap& map, const glm::dvec2& place)
{
  return LinearToSRGB(SRGBToLinear(light) * glm::dvec3(map.GetColor(place)));
}

glm::dvec3 ShowPlace(const MappedPoints& points, int side,
  const std::array<std::size_t, 3>& corners, const glm::dvec3& weights)
{
  glm::dvec3 light(0.0);
  glm::dvec2 place(0.0);
  for (int k = 0; k < 3; ++k)
  {
    light += weights[k] * glm::dvec3(points.Light[side][corners[k]]);
    place += weights[k] * points.GetPlace(corners[k]);
  }
  return ShowLight(light, points.GetMap(corners[0]), place);
}

void AddColorMaps(const std::vector<ColorMap>& maps, vtkDataObject* data)
{
  vtkNew<vtkStringArray> texts;
  texts->SetName(ColorMapsName);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(ColorMapColorsName);
  colors->SetNumberOfComponents(4);
  vtkNew<vtkUnsignedCharArray> images;
  images->SetName(ColorMapImagesName);
  for (const ColorMap& map : maps)
  {
    texts->InsertNextValue(DescribeColorMap(map));
    if (map.IsImage())
    {
      for (const unsigned char byte : map.Image->GetEncoded())
      {
        images->InsertNextValue(byte);
      }
      continue;
    }
    for (const ColorMap::Pixel& color : map.Colors)
    {
      colors->InsertNextTypedTuple(color.data());
    }
    colors->InsertNextTypedTuple(map.NanColor.data());
  }
  data->GetFieldData()->AddArray(texts);
  data->GetFieldData()->AddArray(colors);
  if (images->GetNumberOfValues() > 0)
  {
    data->GetFieldData()->AddArray(images);
  }
}

std::vector<ColorMap> FindColorMaps(vtkDataObject* data)
try
{
  vtkFieldData* fields = data->GetFieldData();
  auto* texts = vtkStringArray::SafeDownCast(fields->GetAbstractArray(ColorMapsName));
  auto* colors = vtkUnsignedCharArray::SafeDownCast(fields->GetAbstractArray(ColorMapColorsName));
  std::vector<ColorMap> maps;
  if (!texts || !colors || colors->GetNumberOfComponents() != 4)
  {
    return maps;
  }
  auto* images = vtkUnsignedCharArray::SafeDownCast(fields->GetAbstractArray(ColorMapImagesName));
  vtkIdType next = 0;
  vtkIdType nextByte = 0;
  for (vtkIdType i = 0; i < texts->GetNumberOfValues(); ++i)
  {
    ColorMap map = ReadColorMap(texts->GetValue(i));
    if (map.IsImage())
    {
      const auto bytes = static_cast<vtkIdType>(map.Layout.Bytes);
      if (!images || bytes > images->GetNumberOfValues() - nextByte)
      {
        return {};
      }
      const unsigned char* first = images->GetPointer(nextByte);
      map.Image = MapImage::Read(map.Layout, { first, first + bytes });
      nextByte += bytes;
      maps.push_back(std::move(map));
      continue;
    }
    if (next + static_cast<vtkIdType>(map.Colors.size()) >= colors->GetNumberOfTuples())
    {
      return {};
    }
    for (ColorMap::Pixel& color : map.Colors)
    {
      color = ToPixel(colors->GetPointer(4 * next++));
    }
    map.NanColor = ToPixel(colors->GetPointer(4 * next++));
    maps.push_back(std::move(map));
  }
  return maps;
}
catch (const std::exception&)
{
  return {};
}

void AddMappedPoints(const MappedPoints& points, vtkPolyData* geometry)
{
  if (points.IsEmpty())
  {
    return;
  }
  const auto count = static_cast<vtkIdType>(points.Numbers.size());
  AddColorMaps(points.Maps, geometry);
  // Floats would be rounded to values outside of the range.
  std::map<std::string, vtkSmartPointer<vtkDoubleArray>> scalars;
  AddSurfaceArrays(points.Arrays, geometry);
  for (const ColorMap& map : points.Maps)
  {
    if (!map.HasScalars())
    {
      continue;
    }
    vtkSmartPointer<vtkDoubleArray>& array = scalars[map.GetScalarName()];
    if (!array)
    {
      array = vtkSmartPointer<vtkDoubleArray>::New();
      array->SetName(map.GetScalarName().c_str());
      array->SetNumberOfTuples(count);
      array->FillValue(vtkMath::Nan());
      // Elsewhere the same array may have coloured nothing.
      for (const SurfaceArray& other : points.Arrays)
      {
        for (vtkIdType i = 0; i < count && other.Name == map.GetScalarName(); ++i)
        {
          array->SetValue(i, other.GetValue(static_cast<std::size_t>(i), 0));
        }
      }
      array->SetLookupTable(MakeLookupTable(map));
    }
  }
  vtkNew<vtkUnsignedCharArray> numbers;
  numbers->SetName(ColorMapName);
  numbers->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const auto point = static_cast<std::size_t>(i);
    numbers->SetValue(i, points.Numbers[point]);
    if (points.Has(point) && points.GetMap(point).HasScalars())
    {
      scalars[points.GetMap(point).GetScalarName()]->SetValue(i, points.Scalars[point]);
    }
  }
  vtkPointData* data = geometry->GetPointData();
  data->AddArray(numbers);
  data->AddArray(MakeLight(LightName, points.Light[0]));
  if (points.Light[1] != points.Light[0])
  {
    data->AddArray(MakeLight(BackLightName, points.Light[1]));
  }
  for (const auto& [name, array] : scalars)
  {
    data->AddArray(array);
  }
}

MappedPoints FindMappedPoints(vtkPolyData* geometry)
try
{
  MappedPoints points;
  vtkDataArray* numbers = FindArray(geometry, ColorMapName, 1);
  vtkDataArray* front = FindArray(geometry, LightName, 3);
  if (!numbers || !front)
  {
    return points;
  }
  points.Maps = FindColorMaps(geometry);
  points.Arrays = FindSurfaceArrays(geometry);
  std::vector<vtkDataArray*> scalars;
  for (const ColorMap& map : points.Maps)
  {
    scalars.push_back(map.HasScalars() ? FindArray(geometry, map.GetScalarName(), 1) : nullptr);
  }
  const SurfaceArray* places = points.FindTexturePlaces();
  // Of a point that has such a map.
  const auto isKnown = [&](std::size_t map, vtkIdType point)
  {
    if (points.Maps[map].IsImage())
    {
      const auto i = static_cast<std::size_t>(point);
      return places && std::isfinite(places->Components[0].Values[i]) &&
        std::isfinite(places->Components[1].Values[i]);
    }
    return points.Maps[map].IsOneColor || scalars[map];
  };
  vtkDataArray* back = FindArray(geometry, BackLightName, 3);
  vtkDataArray* lights[2] = { front, back ? back : front };
  for (vtkIdType i = 0; i < geometry->GetNumberOfPoints(); ++i)
  {
    const double number = numbers->GetTuple1(i);
    const bool isMapped = number >= 1.0 && number <= double(scalars.size());
    const std::size_t map = isMapped ? static_cast<std::size_t>(number) - 1 : 0;
    vtkDataArray* own = isMapped ? scalars[map] : nullptr;
    if (number != 0.0 && !(isMapped && isKnown(map, i)))
    {
      return {};
    }
    points.Numbers.push_back(static_cast<std::uint8_t>(number));
    points.Scalars.push_back(own ? own->GetTuple1(i) : 0.0);
    for (const std::size_t side : { 0, 1 })
    {
      double light[3];
      lights[side]->GetTuple(i, light);
      if (!std::isfinite(light[0] + light[1] + light[2]))
      {
        return {};
      }
      points.Light[side].emplace_back(
        EncodeLight(light[0]), EncodeLight(light[1]), EncodeLight(light[2]));
    }
  }
  return points;
}
catch (const std::exception&)
{
  return {};
}
}
