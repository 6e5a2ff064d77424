// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPointColors.h"

#include "Pipeline/cslfParallelFor.h"
#include "cslfSameSurface.h"

#include <vtkType.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cslf
{
namespace
{
/// A viewpoint sees a point if it sees something as near as this to its plane, in texels at the
/// cube's centre.
constexpr double SeenTexels = 1.5;

/// The most steps of triangles over which a colour is passed on.
constexpr int MostSteps = 64;

/// Reads the colour of a strip at a place, from the texels around it that see the same surface.
glm::vec4 ReadColor(int resolution, const ViewpointSamples& samples, const StripPlace& place)
{
  const auto* bytes = samples.Get<unsigned char>(KnownChannel::Color);
  const auto* floats = samples.Get<float>(KnownChannel::Color);
  const auto* numbers = samples.Get<unsigned short>(KnownChannel::Depth);
  const auto* depths = samples.Get<float>(KnownChannel::Depth);
  const int last = resolution - 1;
  const int left = std::clamp(static_cast<int>(std::floor(place.X)), 0, std::max(last - 1, 0));
  const int top = std::clamp(static_cast<int>(std::floor(place.Y)), 0, std::max(last - 1, 0));
  glm::vec4 sum(0.0f);
  for (int k = 0; k < 4; ++k)
  {
    const int x = std::min(left + k % 2, last);
    const int y = std::min(top + k / 2, last);
    const std::size_t texel =
      (static_cast<std::size_t>(y) * TileCount + place.Tile) * resolution + x;
    const double depth = numbers ? numbers[texel] / 65535.0 : depths[texel];
    if (!AreOnOneSurface(1.0 / place.InverseDepth, depth, 1.0))
    {
      continue;
    }
    const double share =
      std::max(1.0 - std::abs(place.X - x), 0.01) * std::max(1.0 - std::abs(place.Y - y), 0.01);
    for (int component = 0; component < 4; ++component)
    {
      const std::size_t value = 4 * texel + component;
      sum[component] += static_cast<float>(share * (bytes ? bytes[value] / 255.0 : floats[value]));
    }
  }
  return sum;
}

bool IsColored(const glm::vec4& color)
{
  return color.w > 0.0f && std::isfinite(color.x + color.y + color.z + color.w);
}
}

PointColors::PointColors(const DepthViews& views, const SurfaceMesh& mesh)
  : Mesh(mesh)
  , Places(mesh.Points.size())
  , PointsOf(views.GetCount())
  , Colors(mesh.Points.size(), glm::vec4(0.0f))
{
  const std::vector<glm::vec3> normals = FindNormals(mesh);
  std::vector<int> chosen(mesh.Points.size(), -1);
  const double distance = SeenTexels * views.GetTexel();
  ParallelFor(0, static_cast<vtkIdType>(chosen.size()), 0,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const SurfacePlane plane = { glm::dvec3(mesh.Points[i]) / views.GetScale(),
          glm::dvec3(normals[i]) * views.GetScale() };
        double best = 0.0;
        for (int view = 0; view < views.GetCount(); ++view)
        {
          const PlaneSight sight = views.See(view, plane, distance);
          if (sight.IsSeen && sight.Cosine > best)
          {
            best = sight.Cosine;
            chosen[i] = view;
            this->Places[i] = sight.Place;
          }
        }
      }
    });
  for (std::size_t i = 0; i < chosen.size(); ++i)
  {
    if (chosen[i] >= 0)
    {
      this->PointsOf[chosen[i]].push_back(static_cast<unsigned>(i));
      // In parts of a tile, which all resolutions have.
      StripPlace& place = this->Places[i];
      place.X = (place.X + 0.5) / views.GetGrid().GetResolution();
      place.Y = (place.Y + 0.5) / views.GetGrid().GetResolution();
    }
  }
}

void PointColors::Read(int view, int resolution, const ViewpointSamples& samples)
{
  for (const unsigned point : this->PointsOf[view])
  {
    StripPlace place = this->Places[point];
    place.X = place.X * resolution - 0.5;
    place.Y = place.Y * resolution - 0.5;
    this->Colors[point] = ReadColor(resolution, samples, place);
  }
}

vtkSmartPointer<vtkDataArray> PointColors::MakeArray(int type)
{
  for (int step = 0; step < MostSteps; ++step)
  {
    const std::vector<glm::vec4> before = this->Colors;
    bool isChanged = false;
    for (const glm::uvec3& corners : this->Mesh.Triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const unsigned from = corners[k];
        const unsigned to = corners[(k + 1) % 3];
        if (IsColored(before[from]) != IsColored(before[to]))
        {
          (IsColored(before[to]) ? this->Colors[from] : this->Colors[to]) =
            IsColored(before[to]) ? before[to] : before[from];
          isChanged = true;
        }
      }
    }
    if (!isChanged)
    {
      break;
    }
  }
  auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
  array->SetName(ColorName);
  array->SetNumberOfComponents(4);
  array->SetNumberOfTuples(static_cast<vtkIdType>(this->Colors.size()));
  const double scale = type == VTK_UNSIGNED_CHAR ? 255.0 : 1.0;
  for (std::size_t i = 0; i < this->Colors.size(); ++i)
  {
    const glm::vec4& color = this->Colors[i];
    glm::dvec3 shown =
      IsColored(color) ? glm::dvec3(color) / static_cast<double>(color.w) : glm::dvec3(0.5);
    if (type == VTK_UNSIGNED_CHAR)
    {
      shown = glm::floor(glm::clamp(shown, 0.0, 1.0) * scale + 0.5);
    }
    array->SetTuple4(static_cast<vtkIdType>(i), shown.x, shown.y, shown.z, scale);
  }
  return array;
}
}
