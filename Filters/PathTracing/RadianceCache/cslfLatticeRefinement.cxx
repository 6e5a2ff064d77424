// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The points that LatticeBuilder requests, which of them are the same, and where it adds points.
#include "RandomNumbers/cslfSampleStream.h"
#include "cslfLatticeBuilder.h"
#include "cslfSampleNoise.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
// The largest width of the interpolation between white and black, in spacings. It is half as large
// for twice the brightness, and so on.
constexpr double BrightEdge = 2.0;

// Points at most this far apart, in spacings, are close enough: half of that would be closer than
// requested.
constexpr float CoarseSpacings = 1.5f;

// The number of standard errors by which a difference must exceed the known error to be no noise.
constexpr float SureErrors = 3.0f;

// A neighbour continues the line between two points if it lies in the opposite direction, up to 60
// degrees, and at least at this share of their distance.
constexpr float StraightCosine = 0.5f;
constexpr float ShortestBack = 0.25f;
constexpr float MinimumLength = 1e-30f;

/// The largest component's size.
float MaximumSize(const glm::vec3& difference)
{
  const glm::vec3 size = glm::abs(difference);
  return std::max({ size.x, size.y, size.z });
}
}

float LatticeBuilder::GetDistance(const Patch& patch) const
{
  return patch.RootEdge / static_cast<float>(1 << (patch.RootSize - patch.Size + patch.Level));
}

bool LatticeBuilder::NeedsMore(const Patch& patch) const
{
  if (this->IsCoarse(this->GetDistance(patch)) && this->MeetsBody(patch))
  {
    return true;
  }
  if (patch.Level > 0 && this->CountHidden(patch) == patch.Points.size())
  {
    // Some have the light of other bricks, others have none.
    return false;
  }
  if (patch.Level == 0)
  {
    return patch.IsSmooth && !patch.HasOwnVertices ? this->BendsWithin(patch)
                                                   : this->VariesWithin(patch);
  }
  // The points that the last level added lie in the middle of edges of the level before.
  const int splits = 1 << patch.Level;
  for (int j = 0; j <= splits; ++j)
  {
    for (int i = 0; i <= splits - j; ++i)
    {
      const bool isMissed = i % 2 == 1 ? this->IsMissed(patch, i, j, 1, j % 2 == 1 ? -1 : 0)
                                       : j % 2 == 1 && this->IsMissed(patch, i, j, 0, 1);
      if (isMissed)
      {
        return true;
      }
    }
  }
  return false;
}

std::size_t LatticeBuilder::CountHidden(const Patch& patch) const
{
  return static_cast<std::size_t>(std::count_if(patch.Points.begin(), patch.Points.end(),
    [this](std::uint32_t index) { return this->Points[index].Estimate.IsHidden; }));
}

/// Whether some of a brick's points are hidden in another body, and others are not.
bool LatticeBuilder::MeetsBody(const Patch& patch) const
{
  const std::size_t hidden = this->CountHidden(patch);
  return hidden > 0 && hidden < patch.Points.size();
}

const HalfEstimate& LatticeBuilder::GetPilot(const Patch& patch, std::uint32_t point) const
{
  return this->Points[point].Estimate.Halves[patch.Half];
}

bool LatticeBuilder::IsMissed(const Patch& patch, int i, int j, int sideI, int sideJ) const
{
  const std::uint32_t point = patch.GetPoint(i, j);
  const HalfEstimate& here = this->GetPilot(patch, point);
  const HalfEstimate& before = this->GetPilot(patch, patch.GetPoint(i - sideI, j - sideJ));
  const HalfEstimate& after = this->GetPilot(patch, patch.GetPoint(i + sideI, j + sideJ));
  const glm::vec3 interpolated = 0.5f * (before.Pilot + after.Pilot);
  const glm::vec3 variance = here.Variance + 0.25f * (before.Variance + after.Variance);
  // Areas brighter than white light other places, even if they are narrow.
  const float distance = this->GetDistance(patch);
  if (this->IsBright(here.Pilot - interpolated, variance, distance))
  {
    return true;
  }
  if (!this->IsCoarse(distance))
  {
    return false;
  }
  const glm::vec3 color = this->World.GetBaseColor(this->Points[point].Place);
  const glm::vec3 seen = this->Settings.Display(interpolated, color);
  const float error = MaximumSize(this->Settings.Display(here.Pilot, color) - seen);
  if (error <= this->Settings.Tolerance)
  {
    return false;
  }
  const float noise = GetDisplayedError(
    this->Settings.Display, interpolated, SureErrors * glm::sqrt(variance), color);
  return error > this->Settings.Tolerance + noise;
}

bool LatticeBuilder::VariesWithin(const Patch& patch) const
{
  const HalfEstimate& first = this->GetPilot(patch, patch.Points[0]);
  const glm::vec3 color = this->World.GetBaseColor(this->Points[patch.Points[0]].Place);
  const glm::vec3 seen = this->Settings.Display(first.Pilot, color);
  const float size = this->GetDistance(patch);
  const bool isCoarse = this->IsCoarse(size);
  return std::any_of(patch.Points.begin(), patch.Points.end(),
    [&](std::uint32_t index)
    {
      const HalfEstimate& pilot = this->GetPilot(patch, index);
      const bool varies = pilot.Reach < size ||
        MaximumSize(this->Settings.Display(pilot.Pilot, color) - seen) > this->Settings.Tolerance;
      return (isCoarse && varies) ||
        this->IsBright(pilot.Pilot - first.Pilot, pilot.Variance + first.Variance, size);
    });
}

bool LatticeBuilder::BendsWithin(const Patch& patch) const
{
  const float size = this->GetDistance(patch);
  const HalfEstimate& first = this->GetPilot(patch, patch.Points[0]);
  const bool isCoarse = this->IsCoarse(size);
  for (int corner = 0; corner < 3; ++corner)
  {
    const std::uint32_t here = patch.Points[corner];
    const std::uint32_t next = patch.Points[(corner + 1) % 3];
    if (here == next)
    {
      continue;
    }
    const HalfEstimate& pilot = this->GetPilot(patch, here);
    const HalfEstimate& other = this->GetPilot(patch, next);
    if (this->IsBright(pilot.Pilot - first.Pilot, pilot.Variance + first.Variance, size))
    {
      return true;
    }
    if (!isCoarse)
    {
      continue;
    }
    Bend bends[2];
    const bool isKnown = this->FindBend(patch.Half, here, next, bends[0]);
    const bool isKnownThere = this->FindBend(patch.Half, next, here, bends[1]);
    if (!(isKnown || isKnownThere))
    {
      // A line that ends here may bend as much as it rises.
      bends[0].Middle = 0.5f * (other.Pilot - pilot.Pilot);
      bends[0].Variance = 0.25f * (other.Variance + pilot.Variance);
    }
    if (pilot.Reach < size)
    {
      return true;
    }
    // The lines beyond both ends show how the light between them bends.
    const float weight = isKnown && isKnownThere ? 0.5f : 1.0f;
    const glm::vec3 bend = weight * (bends[0].Middle + bends[1].Middle);
    const glm::vec3 variance = weight * weight * (bends[0].Variance + bends[1].Variance);
    const glm::vec3 mean = 0.5f * (pilot.Pilot + other.Pilot);
    const glm::vec3 color = this->World.GetBaseColor(this->Points[here].Place);
    const glm::vec3 seen = this->Settings.Display(mean, color);
    const float error = MaximumSize(this->Settings.Display(mean + bend, color) - seen);
    const float noise =
      GetDisplayedError(this->Settings.Display, mean, SureErrors * glm::sqrt(variance), color);
    if (error > this->Settings.Tolerance + noise)
    {
      return true;
    }
  }
  return false;
}

bool LatticeBuilder::FindBend(int half, std::uint32_t from, std::uint32_t to, Bend& bend) const
{
  const glm::vec3 place = this->GetPosition(this->Points[from]);
  const glm::vec3 way = this->GetPosition(this->Points[to]) - place;
  const float length = glm::length(way);
  float best = StraightCosine;
  float bestLength = 0.0f;
  std::uint32_t opposite = from;
  const std::uint32_t number = this->FirstNumbers[from];
  for (const std::uint32_t* other = this->FirstGraph.Begin(number);
       other != this->FirstGraph.End(number); ++other)
  {
    const std::uint32_t candidate = this->FirstPoints[*other];
    const glm::vec3 back = this->GetPosition(this->Points[candidate]) - place;
    const float backLength = glm::length(back);
    const float cosine = -glm::dot(way, back) / std::max(length * backLength, MinimumLength);
    if (cosine > best && backLength > ShortestBack * length)
    {
      best = cosine;
      bestLength = backLength;
      opposite = candidate;
    }
  }
  if (opposite == from)
  {
    return false;
  }
  // The second derivative by divided differences, times a quarter of the length, squared, over two.
  const auto& getPilot = [&](std::uint32_t point) -> const HalfEstimate&
  { return this->Points[point].Estimate.Halves[half]; };
  const HalfEstimate& a = getPilot(opposite);
  const HalfEstimate& b = getPilot(from);
  const HalfEstimate& c = getPilot(to);
  const float scale = 0.25f * length * length / (length + bestLength);
  const float before = scale / bestLength;
  const float after = scale / length;
  bend.Middle = -(after * (c.Pilot - b.Pilot) + before * (a.Pilot - b.Pilot));
  bend.Variance = after * after * c.Variance + before * before * a.Variance +
    (after + before) * (after + before) * b.Variance;
  return true;
}

glm::vec3 LatticeBuilder::GetPosition(const Point& point) const
{
  const Mesh& mesh = this->World.GetMeshes()[point.Place.Mesh];
  return mesh.Interpolate(mesh.Vertices, point.Place.GetPlace());
}

bool LatticeBuilder::IsCoarse(float distance) const
{
  return distance > CoarseSpacings * this->Layout.GetSpacing() && !this->Settings.OnlyBright;
}

bool LatticeBuilder::IsBright(
  const glm::vec3& error, const glm::vec3& variance, float distance) const
{
  const glm::vec3 sure = glm::abs(error) - SureErrors * glm::sqrt(variance);
  const double radiance = this->Settings.Exposure * std::max({ sure.x, sure.y, sure.z, 0.0f });
  return radiance * distance > BrightEdge * this->Layout.GetSpacing();
}

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

// The normals of a cluster differ by up to about this size in each component.
constexpr float ClusterNormalStep = 0.5f;

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
  constexpr float third = 1.0f / 3.0f;
  TrianglePoint place{ patch.Triangle, third, third };
  if (!patch.IsConstant)
  {
    place.U = static_cast<float>(column) / static_cast<float>(last);
    place.V = static_cast<float>(row) / static_cast<float>(last);
  }
  const std::uint64_t key = this->IsClustered(patch) ? this->FindClusterKey(patch, place)
                                                     : this->FindSharedKey(patch, column, row);
  const auto known = this->Index.find(key);
  return known != this->Index.end() ? known->second : this->AddPoint(patch, place, key);
}

bool LatticeBuilder::IsClustered(const Patch& patch) const
{
  return patch.MayShare && patch.Level == 0 && patch.Size == patch.RootSize &&
    patch.RootEdge < this->Settings.ClusterSize * this->Layout.GetSpacing();
}

std::uint64_t LatticeBuilder::FindClusterKey(const Patch& patch, const TrianglePoint& place) const
{
  const Mesh& mesh = this->World.GetMeshes()[patch.Mesh];
  const float edge = this->Settings.ClusterSize * this->Layout.GetSpacing();
  const glm::vec3 position = mesh.Interpolate(mesh.Vertices, place);
  const glm::uvec3& corners = mesh.Triangles[place.Triangle];
  const glm::vec3 across = mesh.Normals.empty()
    ? glm::cross(mesh.Vertices[corners.y] - mesh.Vertices[corners.x],
        mesh.Vertices[corners.z] - mesh.Vertices[corners.x])
    : mesh.Interpolate(mesh.Normals, place);
  const float length = glm::length(across);
  const glm::vec3 normal =
    length > 0.0f ? glm::round(across / (ClusterNormalStep * length)) : glm::vec3(0.0f);
  return HashKey |
    HashCell(normal, HashCell(glm::floor(position / edge), MakeSideKey(patch.Mesh, 0, patch.Back)));
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
  const glm::vec2 chosen = glm::vec2(columns.Low, rows.Low) / static_cast<float>(cell);
  const std::uint64_t key = isMean ? MakeKey(patch.Domain, patch.Back, column, row, isMean)
    : this->IsClustered(patch)     ? this->FindClusterKey(patch, chart.Find(patch.Back, chosen))
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
  return this->AddPoint(patch, chart.Find(patch.Back, chosen), key);
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
