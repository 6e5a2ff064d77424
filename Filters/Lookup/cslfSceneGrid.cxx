// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lookup/cslfSceneGrid.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace cslf
{
using namespace lookup;

namespace
{
/// The margin of the scene's bounds, in CC.
constexpr double SceneMargin = 0.01;
/// A surface's cells begin at least this share of a cell in front of it.
constexpr double MinimumReach = 0.35;
/// The number of viewpoints along a side of a face that is enough to see everything visible.
constexpr int ViewpointLimit = 17;
/// The most small cells of a geometry along the scene's longest side.
constexpr double MaximumSmallCells = 256.0;
/// The most of their rows that a triangle crosses; more lie outside of the scene's bounds.
constexpr int MaximumRows = 512;
/// The value of unmarked cells.
constexpr std::uint8_t NoRing = 255;

constexpr int CountCells()
{
  return SceneGrid::Cells * SceneGrid::Cells * SceneGrid::Cells;
}

int IndexOf(const glm::ivec3& cell)
{
  return (cell.z * SceneGrid::Cells + cell.y) * SceneGrid::Cells + cell.x;
}

/// What a viewpoint sees at a texel.
struct Sight
{
  glm::dvec3 PointCC;
  double Reach; ///< the distance to the next one, in CC
  double Close; ///< how far from the point the surface may be, in CC
};

/// Whether a texel and those around it lie on one surface.
template <typename DepthValue>
bool IsSmooth(const DepthValue* depths, int width, int resolution, int p, int q, vtkIdType texel)
{
  if (std::min(p, q) < 1 || std::max(p, q) > resolution - 2)
  {
    return false;
  }
  const double depth = depths[texel];
  const vtkIdType around[] = { -1, 1, -width, width };
  return std::all_of(std::begin(around), std::end(around),
    [&](vtkIdType way)
    { return std::abs(double(depths[texel + way]) - depth) <= SurfaceStep * depth; });
}

/// Calls `see` with what a viewpoint sees at regularly spaced texels of a tile.
template <typename ColorValue, typename DepthValue, typename See>
void LookThrough(const Layout& grid, const Viewpoint& viewpoint, int tile, const ColorValue* colors,
  const DepthValue* depths, double depthScale, const See& see)
{
  const glm::dvec3 eye = grid.ViewpointPosition(viewpoint);
  const int face = ExitFaceOf(viewpoint.Face, tile);
  const int resolution = grid.GetResolution();
  const int stride = std::max(1, resolution / SceneGrid::Cells);
  const double texel = 2.0 / resolution;
  for (int q = stride / 2; q < resolution; q += stride)
  {
    const vtkIdType row = static_cast<vtkIdType>(q) * grid.GetStripWidth() + tile * resolution;
    for (int p = stride / 2; p < resolution; p += stride)
    {
      if (colors[4 * (row + p) + 3] > 0)
      {
        const glm::dvec3 exit =
          FaceToCube(face, { grid.TexelCoordinate(p), grid.TexelCoordinate(q) });
        // Floats may be outside [0,1], or not be numbers.
        const double stored = depthScale * depths[row + p];
        const double depth = stored >= 0.0 ? std::min(stored, 1.0) : 0.0;
        const bool isSmooth = IsSmooth(depths, grid.GetStripWidth(), resolution, p, q, row + p);
        see(Sight{ eye + depth * (exit - eye), depth * texel * stride,
          depth * texel * (isSmooth ? 1.0 : CloseTexels) });
      }
    }
  }
}

/// The viewpoints that are used: all, or regularly spaced ones.
std::vector<vtkIdType> ChoosePlaces(const Layout& grid, const std::vector<int>& slices)
{
  const int stride = std::max(1, (grid.GetViewpoints() - 1) / (ViewpointLimit - 1));
  const bool whole = static_cast<int>(slices.size()) == grid.GetSlices();
  std::vector<vtkIdType> places;
  for (std::size_t place = 0; place < slices.size(); ++place)
  {
    const Viewpoint viewpoint = grid.ViewpointOf(slices[place]);
    if (!whole || (viewpoint.I % stride == 0 && viewpoint.J % stride == 0))
    {
      places.push_back(static_cast<vtkIdType>(place));
    }
  }
  return places;
}
}

SurfaceCells::SurfaceCells(const Description& description, const std::vector<glm::vec3>& pointsCC,
  const std::vector<std::uint32_t>& corners)
  : Minimum(description.GetSceneMinimumCC())
{
  const glm::dvec3 size = description.GetSceneMaximumCC() - this->Minimum;
  this->Edge = std::max(1.0 / description.Grid.GetResolution(),
    std::max({ size.x, size.y, size.z }) / MaximumSmallCells);
  this->Cells = glm::ivec3(glm::floor(size / this->Edge)) + 1;
  this->Marks.resize(std::size_t(this->Cells.x) * this->Cells.y * this->Cells.z, false);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
  {
    glm::dvec3 points[3] = { pointsCC[corners[i]], pointsCC[corners[i + 1]],
      pointsCC[corners[i + 2]] };
    // The last point lies opposite the shortest edge, so slivers have few rows.
    for (int turn = 0; turn < 2; ++turn)
    {
      if (glm::distance(points[0], points[1]) > glm::distance(points[1], points[2]))
      {
        std::rotate(std::begin(points), std::begin(points) + 1, std::end(points));
      }
    }
    const auto count = [this](const glm::dvec3& a, const glm::dvec3& b)
    {
      return std::clamp(
        static_cast<int>(std::ceil(glm::distance(a, b) / this->Edge)), 1, MaximumRows);
    };
    const int rows = count(points[0], points[1]);
    const int columns = std::max(count(points[0], points[2]), count(points[1], points[2]));
    for (int row = 0; row <= rows; ++row)
    {
      const glm::dvec3 start = glm::mix(points[0], points[1], double(row) / rows);
      for (int column = 0; column <= columns; ++column)
      {
        this->Mark(glm::mix(start, points[2], double(column) / columns));
      }
    }
  }
}

glm::ivec3 SurfaceCells::FindCell(const glm::dvec3& pointCC) const
{
  return glm::ivec3(glm::floor((pointCC - this->Minimum) / this->Edge));
}

bool SurfaceCells::IsInside(const glm::ivec3& cell) const
{
  return glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) &&
    glm::all(glm::lessThan(cell, this->Cells));
}

std::size_t SurfaceCells::IndexOf(const glm::ivec3& cell) const
{
  return (std::size_t(cell.z) * this->Cells.y + cell.y) * this->Cells.x + cell.x;
}

void SurfaceCells::Mark(const glm::dvec3& pointCC)
{
  const glm::ivec3 middle = this->FindCell(pointCC);
  for (int i = 0; i < 27; ++i)
  {
    const glm::ivec3 cell = middle + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (this->IsInside(cell))
    {
      this->Marks[this->IndexOf(cell)] = true;
    }
  }
}

bool SurfaceCells::AreNear(const glm::dvec3& pointCC, double reach) const
{
  const glm::ivec3 middle = this->FindCell(pointCC);
  // The cells around the geometry are marked, too.
  const int rings = static_cast<int>(std::ceil(reach / this->Edge)) - 1;
  const auto isMarked = [this](const glm::ivec3& cell)
  { return this->IsInside(cell) && this->Marks[this->IndexOf(cell)]; };
  if (isMarked(middle))
  {
    return true;
  }
  glm::ivec3 way;
  for (way.z = -rings; way.z <= rings; ++way.z)
  {
    for (way.y = -rings; way.y <= rings; ++way.y)
    {
      for (way.x = -rings; way.x <= rings; ++way.x)
      {
        if (isMarked(middle + way))
        {
          return true;
        }
      }
    }
  }
  return false;
}

SceneGrid::SceneGrid(const Description& description, std::shared_ptr<const SurfaceCells> known)
  : Known(std::move(known))
  , Field(description.Grid)
  , Minimum(description.GetSceneMinimumCC() - SceneMargin)
  , Maximum(description.GetSceneMaximumCC() + SceneMargin)
  , Rings(CountCells(), description.FindChannel(KnownChannel::Depth) ? NoRing : 0)
  , Added(description.Grid.GetSlices(), 0)
{
}

SceneGrid::SceneGrid(
  const Description& description, vtkImageData* image, const std::vector<int>& slices)
  : SceneGrid(description)
{
  const ViewpointSamples samples(image);
  const auto texels = static_cast<vtkIdType>(description.Grid.GetStripTexels());
  for (vtkIdType place : ChoosePlaces(description.Grid, slices))
  {
    this->Add(slices[place], samples.At(place * texels));
  }
  this->Spread();
}

void SceneGrid::Add(int slice, const ViewpointSamples& samples, int tiles)
{
  tiles &= ~this->Added[slice];
  if (!samples.GetArray(KnownChannel::Depth) || tiles == 0)
  {
    return;
  }
  this->Added[slice] |= tiles;
  const Viewpoint viewpoint = this->Field.ViewpointOf(slice);
  const glm::dvec3 scale = static_cast<double>(Cells) / (this->Maximum - this->Minimum);
  const auto see = [&](const Sight& sight)
  {
    if (!this->Known || !this->Known->AreNear(sight.PointCC, sight.Close))
    {
      this->Mark((sight.PointCC - this->Minimum) * scale, sight.Reach * scale);
    }
  };
  const auto look = [&](const auto* colors, const auto* depths, double depthScale)
  {
    for (int tile = 0; tile < TileCount; ++tile)
    {
      if (tiles >> tile & 1)
      {
        LookThrough(this->Field, viewpoint, tile, colors, depths, depthScale, see);
      }
    }
  };
  const auto lookAtDepth = [&](const auto* colors)
  {
    if (const auto* depths = samples.Get<unsigned short>(KnownChannel::Depth))
    {
      look(colors, depths, 1.0 / 65535.0);
    }
    else
    {
      look(colors, samples.Get<float>(KnownChannel::Depth), 1.0);
    }
  };
  if (const auto* bytes = samples.Get<unsigned char>(KnownChannel::Color))
  {
    lookAtDepth(bytes);
  }
  else
  {
    lookAtDepth(samples.Get<float>(KnownChannel::Color));
  }
}

// Marks the cells around a position, up to `reach` from it or a share of a cell.
void SceneGrid::Mark(const glm::dvec3& position, const glm::dvec3& reach)
{
  const glm::dvec3 around = glm::max(reach, MinimumReach);
  const double most = Cells - 1;
  const glm::ivec3 first(glm::clamp(glm::floor(position - around), 0.0, most));
  const glm::ivec3 last(glm::clamp(glm::floor(position + around), 0.0, most));
  for (int z = first.z; z <= last.z; ++z)
  {
    for (int y = first.y; y <= last.y; ++y)
    {
      for (int x = first.x; x <= last.x; ++x)
      {
        std::uint8_t& ring = this->Rings[IndexOf({ x, y, z })];
        if (ring != 0)
        {
          ring = 0;
          this->New.emplace_back(x, y, z);
        }
      }
    }
  }
}

// Marked cells have 0. Others get their distance to these in the maximum norm, ring by ring around
// new ones, as far as these are nearer than known ones.
bool SceneGrid::Spread()
{
  const bool isAnyNew = !this->New.empty();
  for (int ring = 1; !this->New.empty(); ++ring)
  {
    std::vector<glm::ivec3> next;
    for (const glm::ivec3& cell : this->New)
    {
      const glm::ivec3 least = glm::max(cell - 1, 0);
      const glm::ivec3 most = glm::min(cell + 1, Cells - 1);
      for (int z = least.z; z <= most.z; ++z)
      {
        for (int y = least.y; y <= most.y; ++y)
        {
          for (int x = least.x; x <= most.x; ++x)
          {
            std::uint8_t& known = this->Rings[IndexOf({ x, y, z })];
            if (known > ring)
            {
              known = static_cast<std::uint8_t>(ring);
              next.emplace_back(x, y, z);
            }
          }
        }
      }
    }
    this->New.swap(next);
  }
  return isAnyNew;
}

SceneGrid::Ray SceneGrid::CastGridRay(const glm::dvec3& entryCC, const glm::dvec3& chordCC) const
{
  const glm::dvec3 scale = static_cast<double>(Cells) / (this->Maximum - this->Minimum);
  Ray ray{ (entryCC - this->Minimum) * scale, chordCC * scale, this };
  for (int a = 0; a < 3; ++a)
  {
    ray.Chord[a] = std::abs(ray.Chord[a]) < MinimumChord ? MinimumChord : ray.Chord[a];
  }
  return ray;
}

glm::dvec2 SceneGrid::ClipToScene(const Ray& ray)
{
  glm::dvec2 range(0.0, 1.0);
  for (int a = 0; a < 3; ++a)
  {
    const double t0 = -ray.Entry[a] / ray.Chord[a];
    const double t1 = (Cells - ray.Entry[a]) / ray.Chord[a];
    range.x = std::max(range.x, std::min(t0, t1));
    range.y = std::min(range.y, std::max(t0, t1));
  }
  return range;
}

glm::ivec3 SceneGrid::FindCell(const Ray& ray, double t)
{
  return glm::ivec3(
    glm::clamp(glm::floor(ray.Entry + t * ray.Chord), 0.0, static_cast<double>(Cells - 1)));
}

bool SceneGrid::IsOccupied(const Ray& ray, double w) const
{
  return this->Rings[IndexOf(FindCell(ray, 1.0 / w))] == 0;
}

double SceneGrid::SkipEmpty(const Ray& ray, double w, double last) const
{
  double t = 1.0 / w;
  const double end = 1.0 / last;
  for (int i = 0; i < MaximumSkips && t < end; ++i)
  {
    const glm::ivec3 cell = FindCell(ray, t);
    const int rings = this->Rings[IndexOf(cell)];
    if (rings == 0)
    {
      break;
    }
    double wall = 1.0e30;
    for (int a = 0; a < 3; ++a)
    {
      const int plane = cell[a] + (ray.Chord[a] >= 0.0 ? rings : 1 - rings);
      wall = std::min(wall, (plane - ray.Entry[a]) / ray.Chord[a]);
    }
    t = std::max(t, wall) + SkipMargin;
  }
  return t >= end ? 0.0 : 1.0 / t;
}
}
