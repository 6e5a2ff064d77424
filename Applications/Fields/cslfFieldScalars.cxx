// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldScalars.h"

#include "Pipeline/cslfColorMap.h"
#include "cslfFieldFiles.h"
#include "cslfJoin.h"

#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkTriangle.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <sstream>

namespace cslf::tool
{
namespace
{
/// The name of a component on the command line, and in geometries.
constexpr const char* MagnitudeOption = "magnitude";

FieldScalars MakeScalars(const ColorMap& map)
{
  FieldScalars scalars;
  scalars.Array = map.Array;
  scalars.Component = map.Component == MagnitudeName ? MagnitudeOption : map.Component;
  scalars.ScalarName = map.GetScalarName();
  std::copy_n(map.Range, 2, scalars.MapRange.begin());
  scalars.IsLogarithmic = map.IsLogarithmic;
  return scalars;
}

/// Without its values.
FieldScalars MakeScalars(const SurfaceArray& array, int component)
{
  FieldScalars scalars;
  scalars.Array = array.Name;
  scalars.ScalarName = array.GetScalarName(component);
  scalars.HasMap = false;
  if (array.Components.size() > 1)
  {
    const std::string name = component < 0 ? MagnitudeOption : array.Components[component].Name;
    scalars.Component = name.empty() ? std::to_string(component) : name;
  }
  return scalars;
}

void AddValue(FieldScalars& scalars, double value)
{
  ++scalars.Points;
  if (std::isfinite(value))
  {
    const auto range = scalars.Range.value_or(std::array<double, 2>{ value, value });
    scalars.Range = { std::min(range[0], value), std::max(range[1], value) };
  }
}

/// Whole numbers with all digits.
std::string ToText(double value)
{
  constexpr double maximumExact = 9007199254740992.0;
  if (value == std::floor(value) && std::abs(value) <= maximumExact)
  {
    return std::to_string(static_cast<std::int64_t>(value));
  }
  std::ostringstream text;
  text << value;
  return text.str();
}

/// A component's number, if the text is the letter of one of the first three.
std::string ReadComponent(const std::string& component)
{
  const std::size_t letter = std::string("xyz").find(component);
  return component.size() == 1 && letter != std::string::npos ? std::to_string(letter) : component;
}
}

std::string FieldScalars::GetLabel() const
{
  const std::string& name = this->Array.empty() ? this->ScalarName : this->Array;
  return this->Component.empty() ? name : name + ":" + this->Component;
}

bool FieldScalars::IsMeantBy(const std::string& text) const
{
  if (text == this->Array || text == this->GetLabel())
  {
    return true;
  }
  const std::size_t colon = text.rfind(':');
  return colon != std::string::npos && text.substr(0, colon) == this->Array &&
    ReadComponent(text.substr(colon + 1)) == this->Component;
}

std::vector<FieldScalars> ListScalars(const FieldFile& file)
{
  std::vector<FieldScalars> list;
  vtkPolyData* geometry = file.ReadGeometry();
  if (!geometry)
  {
    return list;
  }
  const MappedPoints points = FindMappedPoints(geometry);
  for (const ColorMap& map : points.Maps)
  {
    list.push_back(MakeScalars(map));
  }
  for (std::size_t i = 0; i < points.Numbers.size(); ++i)
  {
    if (points.Has(i))
    {
      AddValue(list[points.Numbers[i] - 1], points.Scalars[i]);
    }
  }
  std::vector<FieldScalars> all;
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    if (points.Maps[i].HasScalars())
    {
      all.push_back(list[i]);
    }
  }
  for (const SurfaceArray& array : points.Arrays)
  {
    if (array.Name == TexturePlacesName)
    {
      continue;
    }
    const int size = static_cast<int>(array.Components.size());
    for (int component = size > 1 ? -1 : 0; component < size; ++component)
    {
      all.push_back(MakeScalars(array, component));
      for (std::size_t i = 0; i < points.Numbers.size(); ++i)
      {
        const double value = array.GetValue(i, component);
        if (points.Has(i) && !std::isnan(value))
        {
          AddValue(all.back(), value);
        }
      }
      all.back().MapRange = all.back().Range.value_or(std::array<double, 2>{ 0.0, 1.0 });
    }
  }
  return all;
}

double MeasureRecolorable(vtkPolyData* geometry)
{
  const MappedPoints points = FindMappedPoints(geometry);
  double mapped = 0.0;
  double all = 0.0;
  vtkNew<vtkIdList> corners;
  for (vtkIdType i = 0; i < geometry->GetNumberOfPolys(); ++i)
  {
    geometry->GetPolys()->GetCellAtId(i, corners);
    double places[3][3];
    std::set<int> maps;
    for (vtkIdType k = 0; k < 3; ++k)
    {
      const vtkIdType point = corners->GetId(k);
      geometry->GetPoint(point, places[k]);
      maps.insert(points.Numbers.empty() ? 0 : points.Numbers[static_cast<std::size_t>(point)]);
    }
    const double area = vtkTriangle::TriangleArea(places[0], places[1], places[2]);
    mapped += maps.size() == 1 && *maps.begin() > 0 ? area : 0.0;
    all += area;
  }
  return all > 0.0 ? mapped / all : 0.0;
}

std::string ListLabels(const std::vector<FieldScalars>& scalars)
{
  std::set<std::string> labels;
  for (const FieldScalars& each : scalars)
  {
    labels.insert(each.GetLabel());
  }
  return Join(labels);
}

nlohmann::json Summarize(const FieldScalars& scalars)
{
  nlohmann::json json = { { "array", scalars.Array }, { "points", scalars.Points },
    { "range", nullptr }, { "map_range", nullptr }, { "logarithmic", scalars.IsLogarithmic } };
  if (!scalars.Component.empty())
  {
    json["component"] = scalars.Component;
  }
  if (scalars.HasMap)
  {
    json["map_range"] = scalars.MapRange;
  }
  if (scalars.Range)
  {
    json["range"] = *scalars.Range;
  }
  return json;
}

std::string Describe(const FieldScalars& scalars)
{
  std::ostringstream text;
  text << scalars.GetLabel() << ", " << scalars.Points << " points";
  if (scalars.Range)
  {
    text << " from " << ToText((*scalars.Range)[0]) << " to " << ToText((*scalars.Range)[1]);
  }
  if (scalars.HasMap)
  {
    text << ", colour map from " << scalars.MapRange[0] << " to " << scalars.MapRange[1]
         << (scalars.IsLogarithmic ? ", logarithmic" : "");
  }
  return text.str();
}
}
