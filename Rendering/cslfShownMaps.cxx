// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShownMaps.h"

#include "Pipeline/cslfParallelFor.h"
#include "Pipeline/cslfTableCopy.h"
#include "cslfColor.h"
#include "cslfGeometryMesh.h"

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
    a.IsLogarithmic == b.IsLogarithmic && a.GetSteps() == b.GetSteps();
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

/// A map as it is shown.
ColorMap Apply(const ColorMap& own, const MapChoice& choice, std::string& problem)
{
  if (choice.Plain)
  {
    return Paint(own, *choice.Plain);
  }
  if (!choice.Selects(own))
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

ShownMaps::ShownMaps(std::vector<ColorMap> maps)
  : Maps(std::move(maps))
{
  for (const ColorMap& map : this->Maps)
  {
    this->Width = std::max(this->Width, map.GetSteps() + 2);
  }
  for (const ColorMap& map : this->Maps)
  {
    for (const float row : { 0.0f, 1.0f })
    {
      for (int column = 0; column < this->Width; ++column)
      {
        const glm::vec2 place(static_cast<float>(column) + 0.5f, row);
        this->Image.emplace_back(map.GetColor(place), 1.0f);
      }
    }
  }
}

bool ShownMaps::HasPlacesOf(const ShownMaps& other) const
{
  return std::equal(this->Maps.begin(), this->Maps.end(), other.Maps.begin(), other.Maps.end(),
    [](const ColorMap& a, const ColorMap& b) { return HaveSamePlaces(a, b); });
}

glm::vec2 ShownMaps::GetPlace(const MappedPoints& points, std::size_t point) const
{
  return points.Has(point)
    ? glm::vec2(this->Maps[points.Numbers[point] - 1].GetPlace(points.Scalars[point]))
    : glm::vec2(0.0f);
}

std::vector<glm::vec2> ShownMaps::ListPlaces(const MappedPoints& points) const
{
  std::vector<glm::vec2> places(points.Numbers.size(), glm::vec2(0.0f, -1.0f));
  ParallelFor(0, static_cast<vtkIdType>(places.size()), PointGrain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      {
        if (points.Has(i))
        {
          places[i] = this->GetPlace(points, i);
          places[i].y += 2.0f * static_cast<float>(points.Numbers[i] - 1);
        }
      }
    });
  return places;
}

const glm::vec4& ShownMaps::GetColor(std::size_t map, const glm::vec2& place) const
{
  const auto last = static_cast<float>(this->Width - 1);
  const auto column = static_cast<std::size_t>(std::clamp(place.x, 0.0f, last));
  const std::size_t row = 2 * map + (place.y > ColorMap::NanShare ? 1 : 0);
  return this->Image[row * static_cast<std::size_t>(this->Width) + column];
}

const ColorMap& FindMap(const std::vector<ColorMap>& maps, const std::string& array)
{
  MapChoice choice;
  choice.Array = array;
  const auto found = std::find_if(
    maps.begin(), maps.end(), [&](const ColorMap& map) { return choice.Selects(map); });
  return found != maps.end() ? *found : maps.front();
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
    this->Array == other.Array && this->Plain == other.Plain;
}

bool MapChoice::Selects(const ColorMap& map) const
{
  return this->Array.empty() || this->Array == map.Array || this->Array == map.GetScalarName();
}

std::shared_ptr<const ShownMaps> MapChooser::Choose(
  const std::shared_ptr<const GeometryMesh>& geometry, const MapChoice& choice,
  std::string& problem)
{
  if (this->Geometry != geometry)
  {
    this->Geometry = geometry;
    this->Made.clear();
  }
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
  if (std::none_of(
        own.begin(), own.end(), [&](const ColorMap& map) { return choice.Selects(map); }))
  {
    problem = "none are of the array " + choice.Array;
  }
  std::vector<ColorMap> maps;
  maps.reserve(own.size());
  for (const ColorMap& map : own)
  {
    maps.push_back(Apply(map, choice, problem));
  }
  if (this->Made.size() >= MaximumChoices)
  {
    this->Made.erase(this->Made.begin());
  }
  this->Made.emplace_back(choice, std::make_shared<ShownMaps>(std::move(maps)));
  return this->Made.back().second;
}
}
