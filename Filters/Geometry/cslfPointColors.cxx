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
constexpr double ColoredTexels = 1.5;

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
}

PointColors::PointColors(const DepthViews& views, const SurfaceMesh& mesh, const Progress& progress)
  : SightsOf(views.GetCount())
{
  struct Choice
  {
    int View = -1;
    StripPlace Place;
  };
  const std::vector<glm::vec3> normals = FindNormals(mesh);
  const double distance = ColoredTexels * views.GetTexel();
  const int resolution = views.GetGrid().GetResolution();
  for (int side = 0; side < 2; ++side)
  {
    this->Colors.Sides[side].resize(mesh.Points.size());
    std::vector<Choice> choices(mesh.Points.size());
    ParallelFor(0, static_cast<vtkIdType>(choices.size()),
      OrAbort(Within(progress, 0.5 * side, 0.5 * side + 0.5)),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const SurfacePlane plane = { glm::dvec3(mesh.Points[i]) / views.GetScale(),
            (side == 0 ? 1.0 : -1.0) * glm::dvec3(normals[i]) * views.GetScale() };
          double best = 0.0;
          for (int view = 0; view < views.GetCount(); ++view)
          {
            const PlaneSight sight = views.See(view, plane, distance);
            if (sight.IsSeen && sight.Cosine > best)
            {
              best = sight.Cosine;
              choices[i] = { view, sight.Place };
            }
          }
        }
      });
    for (std::size_t i = 0; i < choices.size(); ++i)
    {
      if (choices[i].View >= 0)
      {
        StripPlace& place = choices[i].Place;
        place.X = (place.X + 0.5) / resolution;
        place.Y = (place.Y + 0.5) / resolution;
        this->SightsOf[choices[i].View].push_back({ static_cast<unsigned>(i), side, place });
      }
    }
  }
}

void PointColors::Read(int view, int resolution, const ViewpointSamples& samples)
{
  for (const Sight& sight : this->SightsOf[view])
  {
    StripPlace place = sight.Place;
    place.X = place.X * resolution - 0.5;
    place.Y = place.Y * resolution - 0.5;
    this->Colors.Sides[sight.Side][sight.Point] = ReadColor(resolution, samples, place);
  }
}
}
