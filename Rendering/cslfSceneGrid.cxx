// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneGrid.h"

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkSMPThreadLocal.h>
#include <vtkSMPTools.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
/// The scene's bounds are widened by this, in CC.
constexpr double SceneMargin = 0.01;
/// A surface's cells begin at least this share of a cell before it.
constexpr double LeastReach = 0.35;
/// Viewpoints along a side of a face that are enough to see all there is to see.
constexpr int MostViewpoints = 17;
// These stand in cslfSceneGrid.glsl too.
constexpr int MostSkips = 64;
constexpr double SkipMargin = 1.0e-4;
constexpr double LeastChord = 1.0e-5;

constexpr int CountCells()
{
  return SceneGrid::Cells * SceneGrid::Cells * SceneGrid::Cells;
}

int IndexOf(const glm::ivec3& cell)
{
  return (cell.z * SceneGrid::Cells + cell.y) * SceneGrid::Cells + cell.x;
}

/// What marks the cells that a slice's texels see.
template <typename ColorValue, typename DepthValue>
class Marker
{
public:
  Marker(const Layout& grid, const glm::dvec3& minimum, const glm::dvec3& maximum,
    const ColorValue* colors, const DepthValue* depths, double depthScale)
    : Grid(grid)
    , Minimum(minimum)
    , Scale(static_cast<double>(SceneGrid::Cells) / (maximum - minimum))
    , Colors(colors)
    , Depths(depths)
    , DepthScale(depthScale)
  {
  }

  void Mark(int slice, vtkIdType place, std::vector<std::uint8_t>& cells) const
  {
    const Viewpoint viewpoint = this->Grid.ViewpointOf(slice);
    const glm::dvec3 eye = this->Grid.ViewpointPosition(viewpoint);
    const int resolution = this->Grid.GetResolution();
    const int stride = std::max(1, resolution / SceneGrid::Cells);
    const double texel = 2.0 * stride / resolution;
    for (int tile = 0; tile < TileCount; ++tile)
    {
      const int face = ExitFaceOf(viewpoint.Face, tile);
      for (int q = stride / 2; q < resolution; q += stride)
      {
        const vtkIdType row =
          (place * resolution + q) * this->Grid.GetStripWidth() + tile * resolution;
        for (int p = stride / 2; p < resolution; p += stride)
        {
          if (this->Colors[4 * (row + p) + 3] > 0)
          {
            const glm::dvec3 exit =
              FaceToCube(face, { this->Grid.TexelCoordinate(p), this->Grid.TexelCoordinate(q) });
            const double depth = this->DepthScale * this->Depths[row + p];
            this->MarkPoint(eye + depth * (exit - eye), depth * texel, cells);
          }
        }
      }
    }
  }

private:
  // Marks the cells around a point, up to `reach` from it in CC or a share of a cell.
  void MarkPoint(const glm::dvec3& pointCC, double reach, std::vector<std::uint8_t>& cells) const
  {
    const glm::dvec3 position = (pointCC - this->Minimum) * this->Scale;
    const glm::dvec3 around = glm::max(reach * this->Scale, LeastReach);
    const double most = SceneGrid::Cells - 1;
    const glm::ivec3 first(glm::clamp(glm::floor(position - around), 0.0, most));
    const glm::ivec3 last(glm::clamp(glm::floor(position + around), 0.0, most));
    for (int z = first.z; z <= last.z; ++z)
    {
      for (int y = first.y; y <= last.y; ++y)
      {
        for (int x = first.x; x <= last.x; ++x)
        {
          cells[IndexOf({ x, y, z })] = 1;
        }
      }
    }
  }

  const Layout& Grid;
  glm::dvec3 Minimum;
  glm::dvec3 Scale;
  const ColorValue* Colors;
  const DepthValue* Depths;
  double DepthScale;
};

template <typename ColorValue, typename DepthValue>
void MarkAll(const Marker<ColorValue, DepthValue>& marker, const std::vector<int>& slices,
  const std::vector<vtkIdType>& places, std::vector<std::uint8_t>& cells)
{
  vtkSMPThreadLocal<std::vector<std::uint8_t>> local;
  vtkSMPTools::For(0, static_cast<vtkIdType>(places.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<std::uint8_t>& mine = local.Local();
      mine.resize(CountCells(), 0);
      for (vtkIdType i = begin; i < end; ++i)
      {
        marker.Mark(slices[places[i]], places[i], mine);
      }
    });
  for (const std::vector<std::uint8_t>& part : local)
  {
    std::transform(part.begin(), part.end(), cells.begin(), cells.begin(),
      [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
  }
}

/// The viewpoints that are looked through: all, or every so many.
std::vector<vtkIdType> ChoosePlaces(const Layout& grid, const std::vector<int>& slices)
{
  const int stride = std::max(1, (grid.GetViewpoints() - 1) / (MostViewpoints - 1));
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

SceneGrid::SceneGrid(
  const Description& description, vtkImageData* image, const std::vector<int>& slices)
  : Minimum(description.GetSceneMinimumCC() - SceneMargin)
  , Maximum(description.GetSceneMaximumCC() + SceneMargin)
  , Rings(CountCells(), 0)
{
  if (image->GetPointData()->GetArray(DepthName))
  {
    this->MarkSurfaces(description, image, slices);
    this->CountRings();
  }
}

void SceneGrid::MarkSurfaces(
  const Description& description, vtkImageData* image, const std::vector<int>& slices)
{
  const Layout& grid = description.Grid;
  const std::vector<vtkIdType> places = ChoosePlaces(grid, slices);
  vtkDataArray* colors = image->GetPointData()->GetArray(ColorName);
  vtkDataArray* depths = image->GetPointData()->GetArray(DepthName);
  const auto mark = [&](const auto* color, const auto* depth, double scale)
  {
    MarkAll(
      Marker(grid, this->Minimum, this->Maximum, color, depth, scale), slices, places, this->Rings);
  };
  const auto markDepth = [&](const auto* color)
  {
    if (depths->GetDataType() == VTK_UNSIGNED_SHORT)
    {
      mark(color, static_cast<const unsigned short*>(depths->GetVoidPointer(0)), 1.0 / 65535.0);
    }
    else
    {
      mark(color, static_cast<const float*>(depths->GetVoidPointer(0)), 1.0);
    }
  };
  if (colors->GetDataType() == VTK_UNSIGNED_CHAR)
  {
    markDepth(static_cast<const unsigned char*>(colors->GetVoidPointer(0)));
  }
  else
  {
    markDepth(static_cast<const float*>(colors->GetVoidPointer(0)));
  }
}

// Marked cells get 0, others their distance to those in the maximum norm: one more than the least
// of their neighbours, which a sweep upwards and one downwards settle.
void SceneGrid::CountRings()
{
  for (std::uint8_t& cell : this->Rings)
  {
    cell = cell ? 0 : Cells;
  }
  for (int cell = 0; cell < CountCells(); ++cell)
  {
    this->UpdateRings(cell, -1);
  }
  for (int cell = CountCells() - 1; cell >= 0; --cell)
  {
    this->UpdateRings(cell, 1);
  }
}

// Takes over from the neighbours that come before (direction -1) or after (1) a cell.
void SceneGrid::UpdateRings(int cell, int direction)
{
  const glm::ivec3 centre(cell % Cells, cell / Cells % Cells, cell / (Cells * Cells));
  std::uint8_t& rings = this->Rings[cell];
  for (int neighbour = 0; neighbour < 13 && rings > 0; ++neighbour)
  {
    const glm::ivec3 offset(1 - neighbour % 3, 1 - neighbour / 3 % 3, 1 - neighbour / 9);
    const glm::ivec3 other = centre + direction * offset;
    if (std::min({ other.x, other.y, other.z }) >= 0 &&
      std::max({ other.x, other.y, other.z }) < Cells)
    {
      rings = std::min<std::uint8_t>(rings, this->Rings[IndexOf(other)] + 1);
    }
  }
}

SceneGrid::Ray SceneGrid::CastGridRay(const glm::dvec3& entryCC, const glm::dvec3& chordCC) const
{
  const glm::dvec3 scale = static_cast<double>(Cells) / (this->Maximum - this->Minimum);
  Ray ray{ (entryCC - this->Minimum) * scale, chordCC * scale };
  for (int a = 0; a < 3; ++a)
  {
    ray.Chord[a] = std::abs(ray.Chord[a]) < LeastChord ? LeastChord : ray.Chord[a];
  }
  return ray;
}

void SceneGrid::ClipToScene(const Ray& ray, double& first, double& last)
{
  first = 0.0;
  last = 1.0;
  for (int a = 0; a < 3; ++a)
  {
    const double t0 = -ray.Entry[a] / ray.Chord[a];
    const double t1 = (Cells - ray.Entry[a]) / ray.Chord[a];
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  }
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
  for (int i = 0; i < MostSkips && t < end; ++i)
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
