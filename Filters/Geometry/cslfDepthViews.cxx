// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDepthViews.h"

#include "cslfSameSurface.h"
#include "cslfTileFrame.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
constexpr int Codes = 65536;
constexpr unsigned short UnknownCode = 0;
constexpr unsigned short NothingCode = 65535;

/// Planes that are seen more obliquely than this, as a cosine, are not seen.
constexpr double MinimumCosine = 0.02;

/// Depth also exists where the centre of a texel sees nothing, but a part of it a surface. Texels
/// that are covered by less than half lie beyond outlines, unless the surface is thinner.
constexpr int HalfCoverage = 128;

/// Depth as it is kept.
unsigned short ToCode(double depth)
{
  if (!(depth > 0.0))
  {
    return UnknownCode; // also NaN
  }
  return static_cast<unsigned short>(std::clamp(65535.0 * depth + 0.5, 1.0, 65535.0));
}

/// The depths of a viewpoint's samples.
class StoredDepths
{
public:
  StoredDepths(int resolution, const ViewpointSamples& samples)
    : Resolution(resolution)
    , Numbers(samples.Get<unsigned short>(KnownChannel::Depth))
    , Floats(samples.Get<float>(KnownChannel::Depth))
    , Colors(samples)
    , HasColors(samples.GetArray(KnownChannel::Color) != nullptr)
  {
  }

  unsigned short Get(int tile, int x, int y) const
  {
    const std::size_t texel =
      (static_cast<std::size_t>(y) * TileCount + tile) * this->Resolution + x;
    const int coverage = this->GetCoverage(texel);
    if (coverage == 0 || (coverage < HalfCoverage && this->IsBesideCovered(tile, x, y)))
    {
      return NothingCode;
    }
    return this->Numbers ? this->Numbers[texel] : ToCode(this->Floats[texel]);
  }

  /// The depth at a place between texels: interpolated, if the four texels around see one surface,
  /// as inverse depth, which is linear over planes; otherwise that of the nearest.
  unsigned short Read(int tile, double x, double y) const
  {
    const int last = this->Resolution - 1;
    const int left = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(last - 1, 0));
    const int top = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(last - 1, 0));
    const int right = std::min(left + 1, last);
    const int bottom = std::min(top + 1, last);
    const double alongX = std::clamp(x - left, 0.0, 1.0);
    const double alongY = std::clamp(y - top, 0.0, 1.0);
    const unsigned short nearest =
      this->Get(tile, alongX < 0.5 ? left : right, alongY < 0.5 ? top : bottom);
    const unsigned short codes[4] = { this->Get(tile, left, top), this->Get(tile, right, top),
      this->Get(tile, left, bottom), this->Get(tile, right, bottom) };
    const double shares[4] = { (1.0 - alongX) * (1.0 - alongY), alongX * (1.0 - alongY),
      (1.0 - alongX) * alongY, alongX * alongY };
    double inverse = 0.0;
    for (int k = 0; k < 4; ++k)
    {
      if (codes[k] == UnknownCode || codes[k] == NothingCode ||
        !AreOnOneSurface(codes[k], codes[0], 1.0))
      {
        return nearest;
      }
      inverse += shares[k] / codes[k];
    }
    return static_cast<unsigned short>(std::clamp(1.0 / inverse + 0.5, 1.0, NothingCode - 1.0));
  }

private:
  int GetCoverage(std::size_t texel) const
  {
    return this->HasColors ? this->Colors.GetCoverage(texel) : 255;
  }

  /// Whether one of the eight texels around is covered by half.
  bool IsBesideCovered(int tile, int x, int y) const
  {
    const int last = this->Resolution - 1;
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, last); ++row)
    {
      for (int column = std::max(x - 1, 0); column <= std::min(x + 1, last); ++column)
      {
        const std::size_t texel =
          (static_cast<std::size_t>(row) * TileCount + tile) * this->Resolution + column;
        if (this->GetCoverage(texel) >= HalfCoverage)
        {
          return true;
        }
      }
    }
    return false;
  }

  int Resolution;
  const unsigned short* Numbers;
  const float* Floats;
  ColorTexels Colors;
  bool HasColors;
};
}

DepthViews::DepthViews(const Layout& grid, const Cube& box)
  : Grid(grid)
  , Scale(box.Edges / std::max({ box.Edges.x, box.Edges.y, box.Edges.z }))
  , Inverse(Codes)
{
  for (int code = 1; code < Codes; ++code)
  {
    this->Inverse[code] = 65535.0f / static_cast<float>(code);
  }
  this->Inverse[UnknownCode] = Unknown;
  this->Inverse[NothingCode] = Nothing;
}

void DepthViews::Add(int slice, int resolution, const ViewpointSamples& samples)
{
  const int side = this->Grid.GetResolution();
  const StoredDepths stored(resolution, samples);
  std::vector<unsigned short> depths;
  depths.reserve(this->Grid.GetStripTexels());
  const double step = static_cast<double>(resolution) / side;
  for (int y = 0; y < side; ++y)
  {
    for (int tile = 0; tile < TileCount; ++tile)
    {
      for (int x = 0; x < side; ++x)
      {
        depths.push_back(resolution == side
            ? stored.Get(tile, x, y)
            : stored.Read(tile, (x + 0.5) * step - 0.5, (y + 0.5) * step - 0.5));
      }
    }
  }
  this->Slices.push_back(slice);
  this->Viewpoints.push_back(this->Grid.ViewpointOf(slice));
  this->Positions.push_back(this->Grid.ViewpointPosition(this->Viewpoints.back()));
  this->Depths.push_back(std::move(depths));
}

bool DepthViews::Project(int view, const glm::dvec3& point, StripPlace& place) const
{
  const Viewpoint& viewpoint = this->Viewpoints[view];
  const glm::dvec3& from = this->Positions[view];
  const glm::dvec3 way = point - from;
  int exit = -1;
  place.InverseDepth = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double sign = way[axis] < 0.0 ? -1.0 : 1.0;
    const double length = (sign - from[axis]) / way[axis];
    if (way[axis] != 0.0 && length < place.InverseDepth)
    {
      place.InverseDepth = length;
      exit = FaceOf(axis, sign);
    }
  }
  if (exit < 0 || exit == viewpoint.Face || !(place.InverseDepth >= 1.0))
  {
    return false;
  }
  const glm::dvec2 coordinates = CubeToFace(exit, from + place.InverseDepth * way);
  const double half = 0.5 * this->Grid.GetResolution();
  place.Tile = TileOf(viewpoint.Face, exit);
  place.X = half * (coordinates.x + 1.0) - 0.5;
  place.Y = half * (coordinates.y + 1.0) - 0.5;
  return true;
}

bool DepthViews::SeesThrough(int view, const glm::dvec3& point, double distance) const
{
  StripPlace place;
  if (!this->Project(view, point, place))
  {
    return false;
  }
  const glm::dvec3 way = this->Scale * (point - this->Positions[view]);
  const double most = place.InverseDepth / (1.0 + distance / glm::length(way));
  const int last = this->Grid.GetResolution() - 1;
  const int left = std::clamp(static_cast<int>(std::floor(place.X)), 0, last);
  const int top = std::clamp(static_cast<int>(std::floor(place.Y)), 0, last);
  for (int k = 0; k < 4; ++k)
  {
    const float inverse = this->GetInverseDepth(
      view, place.Tile, std::min(left + k % 2, last), std::min(top + k / 2, last));
    if (inverse == Unknown || inverse >= most)
    {
      return false;
    }
  }
  return true;
}

PlaneSight DepthViews::See(int view, const SurfacePlane& plane, double distance) const
{
  PlaneSight sight;
  StripPlace& place = sight.Place;
  const Viewpoint& viewpoint = this->Viewpoints[view];
  const glm::dvec3& from = this->Positions[view];
  const glm::dvec3 way = plane.Point - from;
  const double height = glm::dot(plane.Normal, way);
  if (height >= 0.0 || !this->Project(view, plane.Point, place))
  {
    return sight;
  }
  const int last = this->Grid.GetResolution() - 1;
  const int x = std::clamp(static_cast<int>(std::lround(place.X)), 0, last);
  const int y = std::clamp(static_cast<int>(std::lround(place.Y)), 0, last);
  const float stored = this->GetInverseDepth(view, place.Tile, x, y);
  if (stored <= 0.0f)
  {
    return sight;
  }
  // The plane is that of the points with dot(normal, point) = 1.
  const glm::dvec3 normal = plane.Normal / height;
  const double length = glm::length(normal / this->Scale);
  sight.Cosine = 1.0 / (length * glm::length(way * this->Scale));
  const TileFrame frame(this->Grid, viewpoint, place.Tile);
  const double expected = glm::dot(normal, frame.VectorToCube(frame.GetRay(x, y)));
  sight.IsSeen =
    sight.Cosine > MinimumCosine && std::abs(stored / expected - 1.0) <= distance * length;
  sight.Footprint = this->FindFootprint(frame, normal, place.InverseDepth);
  return sight;
}

// The pyramid of a texel's rays has the volume of its base times its height, and so does the part
// before the plane.
double DepthViews::FindFootprint(
  const TileFrame& frame, const glm::dvec3& normal, double inverse) const
{
  const double volume = this->Scale.x * this->Scale.y * this->Scale.z;
  return volume * frame.Step * frame.Step * frame.Distance * glm::length(normal / this->Scale) /
    (inverse * inverse * inverse);
}
}
