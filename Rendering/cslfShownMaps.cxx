// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShownMaps.h"

#include "Pipeline/cslfParallelFor.h"
#include "Pipeline/cslfTableCopy.h"
#include "cslfColor.h"
#include "cslfGeometryMesh.h"

#include <vtkNew.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace cslf
{
namespace
{
/// Choices that are kept.
constexpr std::size_t MaximumChoices = 16;

/// Points that are worth a thread.
constexpr vtkIdType PointGrain = 10000;

bool HaveSamePlaces(const ColorMap& a, const ColorMap& b)
{
  return a.Range[0] == b.Range[0] && a.Range[1] == b.Range[1] &&
    a.IsLogarithmic == b.IsLogarithmic && a.GetSteps() == b.GetSteps() && a.Image == b.Image;
}

std::string DescribeRange(const double range[2])
{
  std::ostringstream text;
  text << "from " << range[0] << " to " << range[1];
  return text.str();
}

bool IsRange(const double range[2], bool isLogarithmic)
{
  return range[0] < range[1] && std::isfinite(range[1] - range[0]) &&
    !(isLogarithmic && range[0] <= 0.0);
}

/// The same map over another range, or nothing.
std::optional<ColorMap> Stretch(const ColorMap& map, const double range[2], std::string& problem)
{
  if (!IsRange(range, map.IsLogarithmic))
  {
    problem = "they cannot be mapped " + DescribeRange(range);
    return std::nullopt;
  }
  ColorMap stretched = map;
  std::copy_n(range, 2, stretched.Range);
  return stretched;
}

/// The map of a table over a range, or nothing. The table is not changed. Transfer functions have a
/// range of their own, which VTK's mappers do not change either.
std::optional<ColorMap> ApplyTable(
  vtkScalarsToColors* table, const double range[2], std::string& problem)
{
  if (table->GetIndexedLookup())
  {
    problem = "the lookup table is one of categories";
    return std::nullopt;
  }
  const bool isFunction = table->IsA("vtkColorTransferFunction");
  const double* used = isFunction ? table->GetRange() : range;
  if (!IsRange(used, table->UsingLogScale() != 0))
  {
    problem = "the lookup table cannot map them " + DescribeRange(used);
    return std::nullopt;
  }
  if (isFunction)
  {
    return MakeColorMap(table);
  }
  const auto copy = CopyTable(table);
  copy->SetRange(range[0], range[1]);
  return MakeColorMap(copy);
}

/// The range over which a choice shows a map.
std::array<double, 2> FindRange(const ColorMap& own, const MapChoice& choice)
{
  if (choice.Table && choice.UsesTableRange)
  {
    const double* range = choice.Table->GetRange();
    return { range[0], range[1] };
  }
  return choice.Range.value_or(std::array<double, 2>{ own.Range[0], own.Range[1] });
}

ColorMap Paint(const ColorMap& own, const glm::dvec3& color)
{
  const ColorMap::Pixel pixel = { ToByte(color.x), ToByte(color.y), ToByte(color.z), 255 };
  ColorMap map = own;
  std::fill(map.Colors.begin(), map.Colors.end(), pixel);
  map.NanColor = pixel;
  return map;
}

/// The map in which a field shows an array that gave it no colours.
ColorMap MakeMapOf(const SurfaceArray& array, int component, const std::vector<ColorMap>& maps)
{
  std::array<double, 2> range =
    array.GetRange(component).value_or(std::array<double, 2>{ 0.0, 1.0 });
  range[1] = range[1] > range[0] ? range[1] : range[0] + 1.0;
  const auto colors =
    std::find_if(maps.begin(), maps.end(), [](const ColorMap& map) { return map.HasScalars(); });
  ColorMap map = colors != maps.end() ? *colors : MakeColorMap(vtkNew<vtkLookupTable>());
  map.IsLogarithmic = false;
  std::copy(range.begin(), range.end(), map.Range);
  map.Array = array.Name;
  map.Component = component < 0 ? MagnitudeName : array.Components[component].Name;
  return map;
}

/// A map as it is shown, whether or not a choice selects it.
ColorMap Apply(const ColorMap& own, const MapChoice& choice, bool isSelected, std::string& problem)
{
  if (choice.Plain)
  {
    return own.HasScalars() ? Paint(own, *choice.Plain) : own;
  }
  if (!isSelected)
  {
    return own;
  }
  const std::array<double, 2> range = FindRange(own, choice);
  std::optional<ColorMap> map = choice.Table ? ApplyTable(choice.Table, range.data(), problem)
                                             : Stretch(own, range.data(), problem);
  if (!map)
  {
    return own;
  }
  map->Array = own.Array;
  map->Component = own.Component;
  return *map;
}
}

ShownMaps::ShownMaps(std::vector<ColorMap> maps, std::vector<ShownArray> arrays)
  : Maps(std::move(maps))
  , Arrays(std::move(arrays))
{
  for (const ColorMap& map : this->Maps)
  {
    this->Width = std::max(this->Width, static_cast<int>(map.Colors.size()));
  }
  for (const ColorMap& map : this->Maps)
  {
    if (map.IsImage())
    {
      this->Image.resize(this->Image.size() + 2 * static_cast<std::size_t>(this->Width));
      continue;
    }
    for (const float row : { 0.0f, 1.0f })
    {
      for (int column = 0; column < this->Width; ++column)
      {
        const glm::vec2 place(static_cast<float>(column) + 0.5f, row);
        this->Image.emplace_back(map.GetColor(place), 1.0f);
      }
    }
  }
  this->PlaceImages();
}

// Rows of images, the highest first.
void ShownMaps::PlaceImages()
{
  std::vector<std::size_t> order;
  std::size_t area = 0;
  for (std::size_t i = 0; i < this->Maps.size(); ++i)
  {
    const MapImage::Layout& layout = this->Maps[i].Layout;
    if (this->Maps[i].IsImage())
    {
      order.push_back(i);
      area += std::size_t(layout.Width) * layout.Height;
      this->PixelWidth = std::max(this->PixelWidth, layout.Width);
    }
  }
  this->PixelWidth =
    std::max(this->PixelWidth, static_cast<int>(std::ceil(std::sqrt(double(area)))));
  std::sort(order.begin(), order.end(),
    [this](std::size_t a, std::size_t b)
    {
      const int heights[] = { this->Maps[a].Layout.Height, this->Maps[b].Layout.Height };
      return heights[0] != heights[1] ? heights[0] > heights[1] : a < b;
    });
  glm::ivec2 next(0);
  int rowHeight = 0;
  for (const std::size_t map : order)
  {
    const MapImage::Layout& layout = this->Maps[map].Layout;
    if (next.x + layout.Width > this->PixelWidth)
    {
      next = { 0, next.y + rowHeight };
      rowHeight = 0;
    }
    rowHeight = std::max(rowHeight, layout.Height);
    this->PixelHeight = std::max(this->PixelHeight, next.y + layout.Height);
    this->Pixels.resize(std::size_t(this->PixelWidth) * this->PixelHeight);
    for (int y = 0; y < layout.Height; ++y)
    {
      std::copy_n(this->Maps[map].Image->GetPixels().begin() + std::ptrdiff_t(y) * layout.Width,
        layout.Width,
        this->Pixels.begin() + std::ptrdiff_t(next.y + y) * this->PixelWidth + next.x);
    }
    glm::vec4* facts = &this->Image[2 * map * static_cast<std::size_t>(this->Width)];
    facts[0] = glm::vec4(next.x, next.y, layout.Width, layout.Height);
    facts[this->Width] = glm::vec4(layout.Repeats[0], layout.Repeats[1], layout.IsSmooth, 2.0f);
    next.x += layout.Width;
  }
}

bool ShownMaps::HasPlacesOf(const ShownMaps& other) const
{
  return this->Arrays == other.Arrays &&
    std::equal(this->Maps.begin(), this->Maps.end(), other.Maps.begin(), other.Maps.end(),
      [](const ColorMap& a, const ColorMap& b) { return HaveSamePlaces(a, b); });
}

glm::vec2 ShownMaps::GetPlace(const MappedPoints& points, std::size_t point) const
{
  if (!points.Has(point))
  {
    return glm::vec2(0.0f);
  }
  const std::size_t map = points.Numbers[point] - std::size_t(1);
  const ShownArray& shown = this->Arrays[map];
  if (this->Maps[map].IsImage())
  {
    return points.GetPlace(point);
  }
  return this->Maps[map].GetPlace(shown.Number < 0
      ? points.Scalars[point]
      : points.Arrays[shown.Number].GetValue(point, shown.Component));
}

std::vector<glm::vec3> ShownMaps::ListPlaces(const MappedPoints& points) const
{
  std::vector<glm::vec3> places(points.Numbers.size(), glm::vec3(0.0f, 0.0f, -1.0f));
  ParallelFor(0, static_cast<vtkIdType>(places.size()), PointGrain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        if (points.Has(i))
        {
          places[i] = glm::vec3(this->GetPlace(points, i), points.Numbers[i] - 1.0f);
        }
      }
    });
  return places;
}

glm::vec3 ShownMaps::GetColor(std::size_t map, const glm::vec2& place) const
{
  if (this->Maps[map].IsImage())
  {
    return this->Maps[map].GetColor(place);
  }
  const auto last = static_cast<float>(this->Width - 1);
  const auto column = static_cast<std::size_t>(std::clamp(place.x, 0.0f, last));
  const std::size_t row = 2 * map + (place.y > ColorMap::NanShare ? 1 : 0);
  return glm::vec3(this->Image[row * static_cast<std::size_t>(this->Width) + column]);
}

int GetTableComponent(vtkScalarsToColors* table)
{
  return table->GetVectorMode() == vtkScalarsToColors::COMPONENT
    ? std::max(table->GetVectorComponent(), 0)
    : -1;
}

MapTable::MapTable()
  : Table(vtkSmartPointer<vtkLookupTable>::New())
  , Time(this->Table->GetMTime())
{
}

bool MapTable::IsChanged() const
{
  return this->Table->GetMTime() != this->Time;
}

void MapTable::Update(const ColorMap& map, const double range[2])
{
  if (map.IsImage())
  {
    return;
  }
  std::string problem;
  const ColorMap wanted = Stretch(map, range, problem).value_or(map);
  const bool isSame = HaveSamePlaces(wanted, this->Map) && wanted.Colors == this->Map.Colors &&
    wanted.NanColor == this->Map.NanColor;
  if (!isSame && !this->IsChanged())
  {
    UpdateLookupTable(wanted, this->Table);
    this->Time = this->Table->GetMTime();
    this->Map = wanted;
  }
}

bool MapChoice::operator==(const MapChoice& other) const
{
  return this->Table == other.Table && this->TableTime == other.TableTime &&
    this->UsesTableRange == other.UsesTableRange && this->Range == other.Range &&
    this->Array == other.Array && this->Component == other.Component && this->Plain == other.Plain;
}

bool MapChoice::Selects(const ColorMap& map) const
{
  return map.HasScalars() &&
    (this->Array.empty() || this->Array == map.Array || this->Array == map.GetScalarName());
}

void MapChooser::SetGeometry(const std::shared_ptr<const GeometryMesh>& geometry)
{
  if (this->Geometry != geometry)
  {
    this->Geometry = geometry;
    this->Made.clear();
    this->Known.clear();
  }
}

// Null if it selects none, or scalars of maps.
const MapChooser::KnownArray* MapChooser::FindArray(const MapChoice& choice)
{
  const MappedPoints& points = this->Geometry->Mapped;
  if (choice.Array.empty() || points.Arrays.empty())
  {
    return nullptr;
  }
  for (const auto& known : this->Known)
  {
    if (known->Text == choice.Array && known->Component == choice.Component)
    {
      return known->Array.Number >= 0 ? known.get() : nullptr;
    }
  }
  this->Known.push_back(std::make_unique<KnownArray>());
  KnownArray& known = *this->Known.back();
  known.Text = choice.Array;
  known.Component = choice.Component;
  known.HasMap.assign(points.Maps.size(), 0);
  for (std::size_t i = 0; i < points.Arrays.size(); ++i)
  {
    const SurfaceArray& array = points.Arrays[i];
    const std::optional<int> told = array.FindComponent(choice.Array);
    if (!told || array.Name == TexturePlacesName)
    {
      continue;
    }
    const int last = static_cast<int>(array.Components.size()) - 1;
    const int component = choice.Array == array.Name ? std::min(choice.Component, last) : *told;
    known.Array = { static_cast<int>(i), last > 0 ? component : 0 };
    known.Map = MakeMapOf(array, known.Array.Component, points.Maps);
    for (std::size_t point = 0; point < points.Numbers.size(); ++point)
    {
      if (points.Has(point) && !std::isnan(array.Components.front().Values[point]))
      {
        known.HasMap[points.Numbers[point] - 1] = 1;
      }
    }
    return &known;
  }
  return nullptr;
}

const ColorMap& MapChooser::FindMap(
  const std::shared_ptr<const GeometryMesh>& geometry, const MapChoice& choice)
{
  this->SetGeometry(geometry);
  const std::vector<ColorMap>& maps = geometry->Mapped.Maps;
  const auto find = [&maps](const MapChoice& wanted)
  {
    return std::find_if(
      maps.begin(), maps.end(), [&](const ColorMap& map) { return wanted.Selects(map); });
  };
  auto found = find(choice);
  if (found == maps.end())
  {
    if (const KnownArray* array = this->FindArray(choice))
    {
      return array->Map;
    }
    found = find(MapChoice());
  }
  return found != maps.end() ? *found : maps.front();
}

std::shared_ptr<const ShownMaps> MapChooser::Choose(
  const std::shared_ptr<const GeometryMesh>& geometry, const MapChoice& choice,
  std::string& problem)
{
  this->SetGeometry(geometry);
  if (!geometry || geometry->Mapped.IsEmpty())
  {
    return nullptr;
  }
  const auto found = std::find_if(
    this->Made.begin(), this->Made.end(), [&](const auto& made) { return made.first == choice; });
  if (found != this->Made.end())
  {
    return found->second;
  }
  const std::vector<ColorMap>& own = geometry->Mapped.Maps;
  const KnownArray* array = this->FindArray(choice);
  if (!array && !choice.Array.empty() &&
    std::none_of(own.begin(), own.end(), [&](const ColorMap& map) { return choice.Selects(map); }))
  {
    problem = "none are of the array " + choice.Array;
  }
  std::vector<ColorMap> maps;
  std::vector<ShownArray> arrays(own.size());
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    const bool isOther = array && array->HasMap[i] != 0 && !choice.Plain && !choice.Selects(own[i]);
    arrays[i] = isOther ? array->Array : ShownArray();
    maps.push_back(
      Apply(isOther ? array->Map : own[i], choice, isOther || choice.Selects(own[i]), problem));
  }
  if (this->Made.size() >= MaximumChoices)
  {
    this->Made.erase(this->Made.begin());
  }
  this->Made.emplace_back(choice, std::make_shared<ShownMaps>(std::move(maps), std::move(arrays)));
  return this->Made.back().second;
}
}
