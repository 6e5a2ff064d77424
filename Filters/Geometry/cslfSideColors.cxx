// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSideColors.h"

#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "cslfChannel.h"

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
/// The most steps of triangles over which a colour is passed on.
constexpr int MaximumSteps = 64;

bool IsColored(const glm::vec4& color)
{
  return color.w > 0.0f && std::isfinite(color.x + color.y + color.z + color.w);
}

/// Of each point the first one at its place: creases have several.
std::vector<unsigned int> FindPlaces(const SurfaceMesh& mesh)
{
  std::vector<unsigned int> order(mesh.Points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
    [&](unsigned int a, unsigned int b)
    {
      const glm::vec3& one = mesh.Points[a];
      const glm::vec3& other = mesh.Points[b];
      return std::tie(one.x, one.y, one.z, a) < std::tie(other.x, other.y, other.z, b);
    });
  std::vector<unsigned int> places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool isSame = i > 0 && mesh.Points[order[i]] == mesh.Points[order[i - 1]];
    places[order[i]] = isSame ? places[order[i - 1]] : order[i];
  }
  return places;
}

/// Points without colour take the mean of those next to them, or at the same place, step by step.
void PassOn(const SurfaceMesh& mesh, std::vector<glm::vec4>& colors)
{
  const std::vector<unsigned int> places = FindPlaces(mesh);
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
    PassOn(mesh, colors.Sides[side]);
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
