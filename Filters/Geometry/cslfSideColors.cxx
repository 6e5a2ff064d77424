// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSideColors.h"

#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfChannel.h"
#include "cslfColor.h"

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace cslf
{
namespace
{
/// Light is that of a colour divided by the base colour, which is at least that.
constexpr double MinimumBase = 0.02;

/// The most steps of triangles over which a colour is passed on.
constexpr int MaximumSteps = 64;

bool IsColored(const glm::vec4& color)
{
  return color.w > 0.0f && std::isfinite(color.x + color.y + color.z + color.w);
}

/// Of each point the first one at its place, with the same map: creases have several.
std::vector<unsigned int> FindPlaces(const SurfaceMesh& mesh, const MappedPoints& mapped)
{
  const auto mapOf = [&mapped](unsigned int point)
  { return mapped.IsEmpty() ? 0 : int(mapped.Numbers[point]); };
  std::vector<unsigned int> order(mesh.Points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
    [&](unsigned int a, unsigned int b)
    {
      const glm::vec3& one = mesh.Points[a];
      const glm::vec3& other = mesh.Points[b];
      return std::make_tuple(one.x, one.y, one.z, mapOf(a), a) <
        std::make_tuple(other.x, other.y, other.z, mapOf(b), b);
    });
  std::vector<unsigned int> places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool isSame = i > 0 && mesh.Points[order[i]] == mesh.Points[order[i - 1]] &&
      mapOf(order[i]) == mapOf(order[i - 1]);
    places[order[i]] = isSame ? places[order[i - 1]] : order[i];
  }
  return places;
}

/// Points without colour take the mean of those next to them, or at the same place, step by step.
void PassOn(const SurfaceMesh& mesh, const MappedPoints& mapped, std::vector<glm::vec4>& colors)
{
  const std::vector<unsigned int> places = FindPlaces(mesh, mapped);
  std::vector<glm::vec4> sums;
  for (int step = 0; step < MaximumSteps; ++step)
  {
    sums.assign(colors.size(), glm::vec4(0.0f));
    bool isChanged = false;
    for (const glm::uvec3& corners : mesh.Triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const glm::vec4& from = colors[corners[k]];
        for (const unsigned to : { corners[(k + 1) % 3], corners[(k + 2) % 3] })
        {
          if (from.w > 0.0f)
          {
            sums[places[to]] += from / from.w;
            isChanged = isChanged || colors[to].w == 0.0f;
          }
        }
      }
    }
    if (!isChanged)
    {
      break;
    }
    for (std::size_t i = 0; i < colors.size(); ++i)
    {
      const glm::vec4& sum = sums[places[i]];
      if (colors[i].w == 0.0f && sum.w > 0.0f)
      {
        colors[i] = sum / sum.w;
      }
    }
  }
}

vtkSmartPointer<vtkDataArray> MakeColors(
  const char* name, const std::vector<glm::vec4>& colors, int type)
{
  vtkSmartPointer<vtkDataArray> array =
    MakeArray(MakeChannel(KnownChannel::Color, type), static_cast<vtkIdType>(colors.size()));
  array->SetName(name);
  for (std::size_t i = 0; i < colors.size(); ++i)
  {
    SetColor(array, static_cast<vtkIdType>(i), colors[i]);
  }
  return array;
}
}

glm::vec4 SideColors::ToLight(std::size_t point, const glm::vec4& color) const
{
  if (!this->Mapped.Has(point))
  {
    return color;
  }
  const glm::dvec3 base(this->Mapped.GetMap(point).GetColor(this->Mapped.GetPlace(point)));
  const glm::dvec3 shown = SRGBToLinear(glm::dvec3(color));
  glm::vec4 light(color);
  for (int c = 0; c < 3; ++c)
  {
    light[c] = static_cast<float>(EncodeLight(shown[c] / std::max(base[c], MinimumBase)));
  }
  return light;
}

glm::vec4 SideColors::ToColor(std::size_t point, const glm::vec4& light) const
{
  return this->Mapped.Has(point)
    ? glm::vec4(
        ShowLight(glm::dvec3(light), this->Mapped.GetMap(point), this->Mapped.GetPlace(point)),
        light.w)
    : light;
}

void SideColors::DropMaps()
{
  for (std::vector<glm::vec4>& side : this->Sides)
  {
    for (std::size_t point = 0; point < side.size(); ++point)
    {
      side[point] = this->ToColor(point, side[point]);
    }
  }
  this->Mapped = {};
}

void AddSideColors(const SurfaceMesh& mesh, SideColors colors, int type, vtkPolyData* geometry)
{
  bool isColored[2];
  auto& [fronts, backs] = colors.Sides;
  for (std::size_t side = 0; side < colors.Sides.size(); ++side)
  {
    isColored[side] = false;
    for (glm::vec4& color : colors.Sides[side])
    {
      color = IsColored(color) ? color / color.w : glm::vec4(0.0f);
      isColored[side] = isColored[side] || color.w > 0.0f;
    }
    PassOn(mesh, colors.Mapped, colors.Sides[side]);
  }
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    glm::vec4& front = fronts[i];
    glm::vec4& back = backs[i];
    if (front.w == 0.0f)
    {
      front = back.w > 0.0f ? back : glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    }
    if (back.w == 0.0f)
    {
      back = front;
    }
  }
  for (std::size_t side = 0; side < colors.Sides.size() && !colors.Mapped.IsEmpty(); ++side)
  {
    const std::vector<glm::vec4>& lights = colors.Sides[side];
    colors.Mapped.Light[side].assign(lights.begin(), lights.end());
  }
  AddMappedPoints(colors.Mapped, geometry);
  colors.DropMaps();
  geometry->GetPointData()->SetScalars(MakeColors(ColorName, fronts, type));
  if (isColored[1])
  {
    geometry->GetPointData()->AddArray(MakeColors(BackColorName, backs, type));
  }
  const auto& exact = colors.Exact;
  if (std::any_of(exact.begin(), exact.end(),
        [](const std::vector<unsigned char>& side)
        { return std::any_of(side.begin(), side.end(), [](int code) { return code != 0; }); }))
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(ExactColorName);
    array->SetNumberOfComponents(2);
    array->SetNumberOfTuples(static_cast<vtkIdType>(mesh.Points.size()));
    for (std::size_t i = 0; i < mesh.Points.size(); ++i)
    {
      for (const int side : { 0, 1 })
      {
        array->SetTypedComponent(static_cast<vtkIdType>(i), side, exact[side][i]);
      }
    }
    geometry->GetPointData()->AddArray(array);
  }
}
}
