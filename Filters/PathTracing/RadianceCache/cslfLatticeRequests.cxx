// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The points that LatticeBuilder requests, and which of them are the same.
#include "cslfLatticeBuilder.h"

#include "RandomNumbers/cslfSampleStream.h"
#include "cslfLatticePatch.h"

#include <glm/common.hpp>

#include <algorithm>
#include <utility>

namespace cslf
{
namespace
{
// Selects the points of a chart between which a point is interpolated. If cells are much longer
// than wide, points are dense along the length and sparse across it.

/// The points between which a point lies along one side of a chart.
struct ChartNeighbours
{
  int Low;
  int High;
  float Weight; // of the high one
};

/// Points along one side of a chart, `step` finest points apart. They must be at least half as far
/// apart as points along the other side, whose distance in steps is `ratio`. A cell has `cell`
/// finest points, and the whole side `last`.
inline ChartNeighbours FindChartNeighbours(int index, int step, int cell, int last, float ratio)
{
  for (; step < cell && ratio >= 2.0f; ratio *= 0.5f)
  {
    step *= 2;
  }
  if (ratio >= 2.0f && last == cell)
  {
    return { cell / 2, cell / 2, 0.0f };
  }
  const int low = index / step * step;
  return { low, low < index ? low + step : low, static_cast<float>(index - low) / step };
}

// The distance of points from a triangle's edges, relative to the finest spacing, so that they do
// not lie on an adjacent surface and see what is behind it.
constexpr float Inset = 0.05f;
constexpr float MaximumInset = 0.1f;

// The bits where the key's parts begin: the triangle or chart and its side, and the two
// coordinates.
constexpr int RowShift = LatticeLayout::MaximumDepth + ExtraLevels + 1;
constexpr int SideShift = 2 * RowShift;
constexpr std::uint64_t VertexKey = std::uint64_t(1) << 63;
constexpr std::uint64_t MeanKey = std::uint64_t(1) << 62;
constexpr std::uint64_t HashKey = VertexKey | MeanKey;

std::uint64_t MakeSideKey(std::uint32_t mesh, std::uint64_t place, bool back)
{
  return std::uint64_t(mesh) << 33 | place << 1 | (back ? 1 : 0);
}

}

std::uint64_t LatticeBuilder::MakeKey(
  std::size_t domain, bool back, int column, int row, bool isMean)
{
  const std::uint64_t kind = isMean ? MeanKey : 0;
  const std::uint64_t side = 2 * std::uint64_t(domain) + (back ? 1 : 0);
  const std::uint64_t x = static_cast<std::uint32_t>(column);
  const std::uint64_t y = static_cast<std::uint32_t>(row);
  if (side < MeanKey >> SideShift && x >> RowShift == 0 && y >> RowShift == 0)
  {
    return kind | side << SideShift | y << RowShift | x;
  }
  // Of more than 33.5 million triangles, or of a chart that is very long. The points of a batch are
  // so few that two with the same hash are improbable: one in some 100 000 batches has any.
  return HashKey | MixBits(MixBits(side, kind), y << 32 | x);
}

void LatticeBuilder::RequestAll(Patch& patch)
{
  patch.Points.clear();
  const int splits = patch.IsConstant ? 0 : 1 << patch.Level;
  for (int j = 0; j <= splits; ++j)
  {
    for (int i = 0; i <= splits - j; ++i)
    {
      patch.Points.push_back(this->Request(patch, i, j));
    }
  }
}

std::uint32_t LatticeBuilder::Request(const Patch& patch, int i, int j)
{
  // The position of the point among the finest ones.
  const int step = (patch.Flipped ? -1 : 1) * (1 << (patch.Size - patch.Level));
  const int column = patch.Column + i * step;
  const int row = patch.Row + j * step;
  return patch.Chart ? this->RequestOnChart(patch, column, row)
                     : this->RequestOnTriangle(patch, column, row);
}

std::uint32_t LatticeBuilder::RequestOnTriangle(const Patch& patch, int column, int row)
{
  const int last = 1 << (this->Layout.GetDepth(patch.Domain) + ExtraLevels);
  const std::uint64_t key = this->FindSharedKey(patch, column, row);
  const auto known = this->Index.find(key);
  if (known != this->Index.end())
  {
    return known->second;
  }
  constexpr float third = 1.0f / 3.0f;
  TrianglePoint place{ patch.Triangle, third, third };
  if (!patch.IsConstant)
  {
    place.U = static_cast<float>(column) / static_cast<float>(last);
    place.V = static_cast<float>(row) / static_cast<float>(last);
  }
  return this->AddPoint(patch, place, key);
}

/// Smooth triangles share the points of their corners and edges with their neighbours.
std::uint64_t LatticeBuilder::FindSharedKey(const Patch& patch, int column, int row) const
{
  const int depth = this->Layout.GetDepth(patch.Domain) + ExtraLevels;
  const int last = 1 << depth;
  const Mesh& mesh = this->World.GetMeshes()[patch.Mesh];
  const bool isOnEdge = row == 0 || column == 0 || row + column == last;
  if (!isOnEdge || mesh.Normals.empty())
  {
    return MakeKey(patch.Domain, patch.Back, column, row, false);
  }
  // The edge, and the way along it.
  const glm::uvec3& corners = mesh.Triangles[patch.Triangle];
  std::uint64_t first = row == 0 || column == 0 ? corners.x : corners.y;
  std::uint64_t second = row == 0 ? corners.y : corners.z;
  int way = row == 0 ? column : row;
  if (way == 0 || way == last)
  {
    const auto vertex = static_cast<std::uint32_t>(way == 0 ? first : second);
    if (patch.HasOwnVertices)
    {
      return HashKey |
        MixBits(std::uint64_t(vertex) << 32 | vertex, MakeSideKey(patch.Mesh, 0, patch.Back));
    }
    return VertexKey |
      MakeSideKey(patch.Mesh, this->Layout.GetCluster(patch.Mesh, vertex), patch.Back);
  }
  if (first > second)
  {
    std::swap(first, second);
    way = last - way;
  }
  // Adjacent triangles may have different numbers of points along their common edge.
  const std::uint64_t place = std::uint64_t(way) << (RowShift - depth);
  return HashKey | MixBits(first << 32 | second, MakeSideKey(patch.Mesh, place, patch.Back));
}

std::uint32_t LatticeBuilder::RequestOnChart(const Patch& patch, int column, int row)
{
  const SurfaceChart& chart = *patch.Chart;
  const int cell = 1 << patch.RootSize;
  // Points may be much closer along one side than along the other.
  const float scale = 1.0f / static_cast<float>(1 << (patch.RootSize - patch.Size + patch.Level));
  const glm::vec2 distance = scale * chart.GetCellSize();
  const int step = 1 << (patch.Size - patch.Level);
  const ChartNeighbours middle{ cell / 2, cell / 2, 0.0f };
  const ChartNeighbours columns = patch.IsConstant
    ? middle
    : FindChartNeighbours(column, step, cell, chart.GetColumns() * cell, distance.y / distance.x);
  const ChartNeighbours rows = patch.IsConstant
    ? middle
    : FindChartNeighbours(row, step, cell, chart.GetRows() * cell, distance.x / distance.y);
  const float weight = std::max(columns.Weight, rows.Weight);
  const bool isMean = weight > 0.0f;
  const std::uint64_t key = isMean
    ? MakeKey(patch.Domain, patch.Back, column, row, isMean)
    : MakeKey(patch.Domain, patch.Back, columns.Low, rows.Low, isMean);
  const auto known = this->Index.find(key);
  if (known != this->Index.end())
  {
    return known->second;
  }
  if (weight > 0.0f)
  {
    return this->RequestMean(
      patch, { columns.Low, rows.Low }, { columns.High, rows.High }, weight, key);
  }
  const glm::vec2 place = glm::vec2(columns.Low, rows.Low) / static_cast<float>(cell);
  return this->AddPoint(patch, chart.Find(patch.Back, place), key);
}

std::uint32_t LatticeBuilder::RequestMean(const Patch& patch, const glm::ivec2& low,
  const glm::ivec2& high, float weight, std::uint64_t key)
{
  Point point;
  point.Key = key;
  point.IsMean = true;
  point.Before = this->RequestOnChart(patch, low.x, low.y);
  point.After = this->RequestOnChart(patch, high.x, high.y);
  point.Weight = weight;
  point.Place = this->Points[weight < 0.5f ? point.Before : point.After].Place;
  const auto index = static_cast<std::uint32_t>(this->Points.size());
  this->Index.emplace(key, index);
  this->Points.push_back(point);
  ++this->Means;
  return index;
}

std::uint32_t LatticeBuilder::AddPoint(
  const Patch& patch, const TrianglePoint& place, std::uint64_t key)
{
  constexpr float third = 1.0f / 3.0f;
  const float edge = this->World.GetMeshes()[patch.Mesh].GetLongestEdge(place.Triangle);
  const float inset = Inset * this->Layout.GetSpacing() / (1 << ExtraLevels);
  const float keep = 1.0f - std::min(MaximumInset, inset / edge);
  Point point;
  point.Key = key;
  point.Place.Mesh = patch.Mesh;
  point.Place.Triangle = place.Triangle;
  point.Place.Back = patch.Back;
  point.Place.U = third + keep * (place.U - third);
  point.Place.V = third + keep * (place.V - third);
  const auto index = static_cast<std::uint32_t>(this->Points.size());
  this->Index.emplace(key, index);
  this->Points.push_back(point);
  return index;
}
}
