// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDepthSurfaces.h"

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
/// Neighbours are parts of one surface if the step between them along the ray is at most this
/// number of widths of a texel there.
constexpr double LinkedWidths = 1.5;

/// Or if the step is at most the second number, and differs from the step before or behind it by at
/// most the first one.
constexpr double ContinuedWidths = 0.5;
constexpr double MaximumWidths = 12.0;

/// How a line of texels goes on, with inverse depths.
struct Line
{
  float Before; ///< 0 if there is none
  float First;
  float Second;
  float Behind;
};

bool AreLinked(const Line& line, double width)
{
  if (line.First <= 0.0f || line.Second <= 0.0f)
  {
    return false;
  }
  const double step = line.Second - line.First;
  if (std::abs(step) <= LinkedWidths * width)
  {
    return true;
  }
  const bool goesOn =
    line.Before > 0.0f && std::abs(step - (line.First - line.Before)) <= ContinuedWidths * width;
  const bool comesFrom =
    line.Behind > 0.0f && std::abs(step - (line.Behind - line.Second)) <= ContinuedWidths * width;
  return std::abs(step) <= MaximumWidths * width && (goesOn || comesFrom);
}

float FindSlope(float before, float here, float behind, bool hasBefore, bool hasBehind)
{
  return hasBefore && hasBehind ? 0.5f * (behind - before)
    : hasBefore                 ? here - before
    : hasBehind                 ? behind - here
                                : 0.0f;
}
}

DepthSurfaces::DepthSurfaces(const DepthViews& views, int view, int tile)
  : Frame(views.GetGrid(), views.GetSlice(view), tile)
  , Resolution(views.GetGrid().GetResolution())
{
  const std::size_t count = static_cast<std::size_t>(this->Resolution) * this->Resolution;
  this->Inverse.reserve(count);
  for (int y = 0; y < this->Resolution; ++y)
  {
    for (int x = 0; x < this->Resolution; ++x)
    {
      this->Inverse.push_back(views.GetInverseDepth(view, tile, x, y));
    }
  }
  this->Right.assign(count, 0);
  this->Down.assign(count, 0);
  this->Slopes.assign(count, glm::vec2(0.0f));
  this->Link();
  this->FindSlopes();
}

void DepthSurfaces::Link()
{
  const int last = this->Resolution - 1;
  const auto read = [&](int x, int y)
  { return x < 0 || y < 0 || x > last || y > last ? 0.0f : this->Inverse[this->IndexOf(x, y)]; };
  for (int y = 0; y <= last; ++y)
  {
    for (int x = 0; x <= last; ++x)
    {
      const std::size_t texel = this->IndexOf(x, y);
      // A step of a texel's width along the ray, as a change of inverse depth.
      const double width =
        this->Inverse[texel] * this->Frame.Step / glm::length(this->Frame.GetRay(x, y));
      this->Right[texel] =
        AreLinked({ read(x - 1, y), read(x, y), read(x + 1, y), read(x + 2, y) }, width) ? 1 : 0;
      this->Down[texel] =
        AreLinked({ read(x, y - 1), read(x, y), read(x, y + 1), read(x, y + 2) }, width) ? 1 : 0;
    }
  }
}

void DepthSurfaces::FindSlopes()
{
  const int last = this->Resolution - 1;
  for (int y = 0; y <= last; ++y)
  {
    for (int x = 0; x <= last; ++x)
    {
      const std::size_t texel = this->IndexOf(x, y);
      const std::size_t left = x > 0 ? texel - 1 : texel;
      const std::size_t right = x < last ? texel + 1 : texel;
      const std::size_t up = y > 0 ? texel - this->Resolution : texel;
      const std::size_t down = y < last ? texel + this->Resolution : texel;
      const float here = this->Inverse[texel];
      this->Slopes[texel] = { FindSlope(this->Inverse[left], here, this->Inverse[right],
                                x > 0 && this->Right[left] != 0, this->Right[texel] != 0),
        FindSlope(this->Inverse[up], here, this->Inverse[down], y > 0 && this->Down[up] != 0,
          this->Down[texel] != 0) };
    }
  }
}

bool DepthSurfaces::IsInside(int x, int y) const
{
  const int last = this->Resolution - 1;
  const std::size_t texel = this->IndexOf(x, y);
  return (x == 0 || this->Right[texel - 1] != 0) && (x == last || this->Right[texel] != 0) &&
    (y == 0 || this->Down[texel - this->Resolution] != 0) && (y == last || this->Down[texel] != 0);
}

glm::dvec3 DepthSurfaces::GetNormal(int x, int y) const
{
  // The scalar product of the normal with a ray is the inverse depth.
  const std::size_t texel = this->IndexOf(x, y);
  const glm::dvec3 ray = this->Frame.GetRay(x, y);
  const glm::dvec2 change = glm::dvec2(this->Slopes[texel]) / this->Frame.Step;
  const double rest = this->Inverse[texel] - change.x * ray.x - change.y * ray.y;
  return this->Frame.VectorToCube({ change.x, change.y, rest / ray.z });
}

SurfacePlane DepthSurfaces::GetPlane(int x, int y) const
{
  const glm::dvec3 ray = this->Frame.VectorToCube(this->Frame.GetRay(x, y));
  return { this->Frame.From + ray / static_cast<double>(this->Inverse[this->IndexOf(x, y)]),
    -this->GetNormal(x, y) };
}
}
