// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneArrays.h"

#include "Pipeline/cslfColorMap.h"

#include <vtkMath.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace cslf
{
namespace
{
/// Values that are so near to an integer are that, if all values of the scene are integers; and
/// those that are a share of the range from it, which is that of rounding.
constexpr double SnapDistance = 0.01;
constexpr double SnapShare = 1e-6;

/// Whether an array is what a mesh's own map shows.
bool IsOfMap(const Mesh& mesh, const std::string& name)
{
  const ColorMap* map = mesh.FindMap();
  return map && !map->IsOneColor && map->GetScalarName() == name;
}
}

SceneArrays::SceneArrays(const Scene& scene, const std::vector<std::uint8_t>& maps)
  : Meshes(&scene.GetMeshes())
{
  const std::vector<Mesh>& meshes = scene.GetMeshes();
  for (std::size_t i = 0; i < meshes.size(); ++i)
  {
    if (maps[i] > 0)
    {
      this->Add(meshes[i], i);
    }
  }
  const auto isUseless = [&meshes](const Entry& entry)
  {
    for (std::size_t i = 0; i < meshes.size(); ++i)
    {
      if (entry.OfMeshes[i] >= 0 && !IsOfMap(meshes[i], entry.Name))
      {
        return false;
      }
    }
    return true;
  };
  this->Entries.erase(
    std::remove_if(this->Entries.begin(), this->Entries.end(), isUseless), this->Entries.end());
  for (Entry& entry : this->Entries)
  {
    for (std::size_t i = 0; i < meshes.size(); ++i)
    {
      entry.HasHoles = entry.HasHoles || (maps[i] > 0 && entry.OfMeshes[i] < 0);
    }
    entry.First = this->Values;
    this->Values += entry.Components.size() + (entry.HasHoles ? 1 : 0);
  }
}

void SceneArrays::Add(const Mesh& mesh, std::size_t number)
{
  for (std::size_t i = 0; i < mesh.GetNumberOfArrays(); ++i)
  {
    const SurfaceArray& array = mesh.GetArray(i);
    auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
      [&array](const Entry& entry) { return entry.Name == array.Name; });
    if (found == this->Entries.end())
    {
      constexpr double most = std::numeric_limits<double>::max();
      Entry& entry = this->Entries.emplace_back();
      entry.Name = array.Name;
      for (const SurfaceArray::Component& component : array.Components)
      {
        entry.Components.push_back(component.Name);
      }
      entry.Ranges.assign(array.Components.size(), { most, -most });
      entry.OfMeshes.assign(this->Meshes->size(), -1);
      found = std::prev(this->Entries.end());
    }
    // Arrays of one name with other components are not the same.
    if (found->Components.size() == array.Components.size())
    {
      found->OfMeshes[number] = static_cast<int>(i);
      found->IsInteger = found->IsInteger && array.IsInteger;
      for (std::size_t c = 0; c < array.Components.size(); ++c)
      {
        this->AddRange(array.Components[c].Values, *found, c);
      }
    }
  }
}

void SceneArrays::AddRange(const std::vector<double>& values, Entry& entry, std::size_t component)
{
  auto& [first, last] = entry.Ranges[component];
  for (const double value : values)
  {
    entry.HasHoles = entry.HasHoles || std::isnan(value);
    // What is infinite is at the ends of the range.
    first = std::isfinite(value) ? std::min(first, value) : first;
    last = std::isfinite(value) ? std::max(last, value) : last;
  }
}

void SceneArrays::Get(
  std::uint32_t mesh, const TrianglePoint& point, std::vector<glm::vec3>& values) const
{
  for (const Entry& entry : this->Entries)
  {
    const Mesh& own = (*this->Meshes)[mesh];
    const int number = entry.OfMeshes[mesh];
    bool isKnown = number >= 0;
    for (std::size_t c = 0; isKnown && c < entry.Components.size(); ++c)
    {
      const double value = own.GetArrayValue(static_cast<std::size_t>(number), c, point);
      const auto& [first, last] = entry.Ranges[c];
      const std::size_t place = entry.First + c;
      isKnown = !std::isnan(value);
      if (isKnown)
      {
        values[place / 3][static_cast<int>(place % 3)] = static_cast<float>(
          last > first ? std::clamp((value - first) / (last - first), 0.0, 1.0) : 0.0);
      }
    }
    if (entry.HasHoles)
    {
      const std::size_t place = entry.First + entry.Components.size();
      values[place / 3][static_cast<int>(place % 3)] = isKnown ? 1.0f : 0.0f;
    }
  }
}

std::vector<SurfaceArray> SceneArrays::MakeArrays(
  const std::vector<std::vector<glm::vec3>>& values) const
{
  std::vector<SurfaceArray> arrays;
  for (const Entry& entry : this->Entries)
  {
    SurfaceArray& array = arrays.emplace_back();
    array.Name = entry.Name;
    array.IsInteger = entry.IsInteger;
    const auto get = [&values](std::size_t place, std::size_t point)
    { return values[place / 3][point][static_cast<int>(place % 3)]; };
    for (std::size_t c = 0; c < entry.Components.size(); ++c)
    {
      SurfaceArray::Component& component = array.Components.emplace_back();
      component.Name = entry.Components[c];
      const auto& [first, last] = entry.Ranges[c];
      for (std::size_t i = 0; i < values.front().size(); ++i)
      {
        const bool isKnown =
          !entry.HasHoles || get(entry.First + entry.Components.size(), i) > 0.5f;
        const double share = std::clamp<double>(get(entry.First + c, i), 0.0, 1.0);
        double value = first + share * (last - first);
        const double whole = std::round(value);
        if (entry.IsInteger && std::abs(value - whole) < SnapDistance + SnapShare * (last - first))
        {
          value = whole;
        }
        component.Values.push_back(isKnown ? value : vtkMath::Nan());
      }
    }
  }
  return arrays;
}
}
