// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfVolume.h"

#include "PathTracing/Rays/cslfRayGrid.h"
#include "Pipeline/cslfParallelFor.h"
#include "SIMD/cslfVectorize.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// The nodes along the edge of a brick.
constexpr int BrickSide = 8;

// The largest opacity over the unit distance. The extinction of an opaque medium would be infinite;
// this one lets 1e-8 of the light through.
constexpr double MaximumOpacity = 1.0 - 1e-8;

// The largest optical depth over the longest distance of nodes of a volume that scatters light: so
// opaque media need no more collisions than that. Less than 1e-13 of the light passes one.
constexpr double MaximumCellDepth = 32.0;

// A step along a ray, in the distance of nodes. The first one has a random length.
constexpr float StepOfNodes = 1.0f;

/// The largest of values from one index to another: a table of the largest values of all runs whose
/// lengths are powers of two.
class RunMaximum
{
public:
  explicit RunMaximum(const std::vector<float>& values)
    : Levels{ values }
  {
    for (std::size_t run = 1; 2 * run <= values.size(); run *= 2)
    {
      const std::vector<float>& shorter = this->Levels.back();
      std::vector<float> longer(values.size() - 2 * run + 1);
      for (std::size_t i = 0; i < longer.size(); ++i)
      {
        longer[i] = std::max(shorter[i], shorter[i + run]);
      }
      this->Levels.push_back(std::move(longer));
    }
  }

  float Find(int first, int last) const
  {
    int level = 0;
    while ((2 << level) <= last - first + 1)
    {
      ++level;
    }
    const std::vector<float>& runs = this->Levels[level];
    return std::max(runs[first], runs[last + 1 - (1 << level)]);
  }

private:
  std::vector<std::vector<float>> Levels;
};

/// The part of a line between two planes of an axis.
inline void Cut(float low, float high, float origin, float step, float& near, float& far)
{
  const float inverse = 1.0f / step;
  const float a = (low - origin) * inverse;
  const float b = (high - origin) * inverse;
  // Along the planes, one of them may be NaN: comparisons with it are false.
  const float first = a < b ? a : b;
  const float last = a < b ? b : a;
  near = first > near ? first : near;
  far = last < far ? last : far;
}

/// The place between the nodes of an axis whose coordinates are not even, in nodes.
float FindNode(const std::vector<float>& axis, float coordinate)
{
  const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, coordinate);
  const float low = *(above - 1);
  return static_cast<float>(above - 1 - axis.begin()) + (coordinate - low) / (*above - low);
}
}

/// The arithmetic of points, in the space of nodes.
struct VolumeKernel
{
  const float* Values;
  int Size[3];
  int Brick[3];
  const float* Majorants;
  float Low;
  float Scale;
  bool IsNearest;

  explicit VolumeKernel(const Volume& volume)
    : Values(volume.Data.Values)
    , Size{ volume.Data.Size[0], volume.Data.Size[1], volume.Data.Size[2] }
    , Brick{ volume.Bricks[0], volume.Bricks[1], volume.Bricks[2] }
    , Majorants(volume.Majorants.data())
    , Low(volume.Data.Range[0])
    , Scale(volume.TableScale)
    , IsNearest(volume.Data.IsNearest)
  {
  }

  static float Clamp(float place, int size)
  {
    const float last = static_cast<float>(size - 1);
    return place > 0.0f ? (place < last ? place : last) : 0.0f;
  }

  /// The node below, so that there is one above it.
  static int Below(float place, int size)
  {
    const int node = static_cast<int>(place);
    return node < size - 2 ? node : size - 2;
  }

  int GetBrick(float x, float y, float z) const
  {
    const int i = Below(Clamp(x, this->Size[0]), this->Size[0]) / BrickSide;
    const int j = Below(Clamp(y, this->Size[1]), this->Size[1]) / BrickSide;
    const int k = Below(Clamp(z, this->Size[2]), this->Size[2]) / BrickSide;
    return (k * this->Brick[1] + j) * this->Brick[0] + i;
  }

  float GetNearest(float x, float y, float z) const
  {
    const int i = static_cast<int>(Clamp(x, this->Size[0]) + 0.5f);
    const int j = static_cast<int>(Clamp(y, this->Size[1]) + 0.5f);
    const int k = static_cast<int>(Clamp(z, this->Size[2]) + 0.5f);
    return this->Values[(k * this->Size[1] + j) * this->Size[0] + i];
  }

  /// The lowest of the eight nodes around a place, and the place between them.
  int GetCell(float x, float y, float z, float& u, float& v, float& w) const
  {
    const float px = Clamp(x, this->Size[0]);
    const float py = Clamp(y, this->Size[1]);
    const float pz = Clamp(z, this->Size[2]);
    const int i = Below(px, this->Size[0]);
    const int j = Below(py, this->Size[1]);
    const int k = Below(pz, this->Size[2]);
    u = px - static_cast<float>(i);
    v = py - static_cast<float>(j);
    w = pz - static_cast<float>(k);
    return (k * this->Size[1] + j) * this->Size[0] + i;
  }

  /// Calls `set(number, value)` for the nodes of a cell: the number has a bit for each axis.
  template <typename Set>
  void GetCorners(int node, const Set& set) const
  {
    const float* values = this->Values + node;
    const std::ptrdiff_t row = this->Size[0];
    const std::ptrdiff_t slice = row * this->Size[1];
    set(0, values[0]);
    set(1, values[1]);
    set(2, values[row]);
    set(3, values[row + 1]);
    set(4, values[slice]);
    set(5, values[slice + 1]);
    set(6, values[slice + row]);
    set(7, values[slice + row + 1]);
  }

  float GetLinear(float x, float y, float z) const
  {
    float u;
    float v;
    float w;
    float corners[8];
    this->GetCorners(
      this->GetCell(x, y, z, u, v, w), [&corners](int i, float value) { corners[i] = value; });
    return Interpolate(corners[0], corners[1], corners[2], corners[3], corners[4], corners[5],
      corners[6], corners[7], u, v, w);
  }

  static float Interpolate(float c0, float c1, float c2, float c3, float c4, float c5, float c6,
    float c7, float u, float v, float w)
  {
    const float a = c0 + u * (c1 - c0);
    const float b = c2 + u * (c3 - c2);
    const float c = c4 + u * (c5 - c4);
    const float d = c6 + u * (c7 - c6);
    const float low = a + v * (b - a);
    const float high = c + v * (d - c);
    return low + w * (high - low);
  }

  // The entry of nothing.
  static constexpr float NoEntry = static_cast<float>(Volume::TableSize);

  /// The entry of the table for a value, as a float.
  float GetPlace(float value) const
  {
    constexpr float last = static_cast<float>(Volume::TableSize - 1);
    const float place = (value - this->Low) * this->Scale + 0.5f;
    const float inside = place > 0.0f ? (place < last ? place : last) : 0.0f;
    return value == value ? inside : NoEntry;
  }
  int GetEntry(float value) const { return static_cast<int>(this->GetPlace(value)); }
};

namespace
{
/// The places of points in grid space, and whether they are in their spans.
CSLF_VECTORIZE void FindPlaces(const VolumeSpans& spans, const Lanes<float>& at,
  const LaneMask& active, Vec3Lanes& places, LaneMask& inside)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const float t = at[i];
    places.Set(i, spans.Origin.Get(i) + t * spans.Step.Get(i));
    const bool isInside = t >= spans.Near[i] && t <= spans.Far[i];
    inside[i] = isInside ? active[i] : 0;
  }
}

/// Whether the bricks of points inside contain anything.
CSLF_VECTORIZE bool IsAnything(
  const VolumeKernel& given, const Vec3Lanes& places, const LaneMask& inside)
{
  const VolumeKernel kernel = given;
  const float* x = places.X.Values;
  const float* y = places.Y.Values;
  const float* z = places.Z.Values;
  const std::int32_t* mask = inside.Values;
  float majorants[LaneCount];
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const float majorant = kernel.Majorants[kernel.GetBrick(x[i], y[i], z[i])];
    majorants[i] = mask[i] != 0 ? majorant : 0.0f;
  }
  float sum = 0.0f;
  for (float majorant : majorants)
  {
    sum += majorant;
  }
  return sum > 0.0f;
}

/// The values of points. Only the loads, whose addresses are anywhere, are not vectorised.
struct CellLanes
{
  alignas(64) std::int32_t Node[LaneCount];
  alignas(64) float U[LaneCount];
  alignas(64) float V[LaneCount];
  alignas(64) float W[LaneCount];
  alignas(64) float Corners[8][LaneCount];
};

CSLF_VECTORIZE void FindCells(const VolumeKernel& given, const Vec3Lanes& places, CellLanes& cells)
{
  const VolumeKernel kernel = given;
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    float u;
    float v;
    float w;
    cells.Node[i] = kernel.GetCell(places.X[i], places.Y[i], places.Z[i], u, v, w);
    cells.U[i] = u;
    cells.V[i] = v;
    cells.W[i] = w;
  }
}

CSLF_VECTORIZE void InterpolateCells(const CellLanes& cells, Lanes<float>& values)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    values[i] = VolumeKernel::Interpolate(cells.Corners[0][i], cells.Corners[1][i],
      cells.Corners[2][i], cells.Corners[3][i], cells.Corners[4][i], cells.Corners[5][i],
      cells.Corners[6][i], cells.Corners[7][i], cells.U[i], cells.V[i], cells.W[i]);
  }
}

void GetLinear(const VolumeKernel& kernel, const Vec3Lanes& places, Lanes<float>& values)
{
  CellLanes cells;
  FindCells(kernel, places, cells);
  for (int i = 0; i < LaneCount; ++i)
  {
    kernel.GetCorners(
      cells.Node[i], [&cells, i](int corner, float value) { cells.Corners[corner][i] = value; });
  }
  InterpolateCells(cells, values);
}

CSLF_VECTORIZE void FindEntries(const VolumeKernel& given, const Lanes<float>& values,
  const LaneMask& inside, Lanes<std::int32_t>& entries)
{
  const VolumeKernel kernel = given;
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const float place = kernel.GetPlace(values[i]);
    entries[i] = static_cast<std::int32_t>(inside[i] != 0 ? place : VolumeKernel::NoEntry);
  }
}

/// Adds entries of the table, whose last component is an extinction for a unit of length in the
/// coordinates of the data set.
CSLF_VECTORIZE void AddEntries(const Vec3Lanes& colors, const Lanes<float>& extinctions,
  const Lanes<float>& rates, MediumLanes& medium)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const float extinction = rates[i] * extinctions[i];
    medium.Extinction[i] += extinction;
    medium.Light.X[i] += extinction * colors.X[i];
    medium.Light.Y[i] += extinction * colors.Y[i];
    medium.Light.Z[i] += extinction * colors.Z[i];
  }
}
}

Volume::Volume(VolumeData data, const SceneFrame& frame)
  : Data(std::move(data))
{
  if (!this->Data.Converted.empty())
  {
    this->Data.Values = this->Data.Converted.data();
  }
  const glm::dmat4 fromWorld = glm::inverse(this->Data.GetToWorld());
  glm::dmat4 toWorld(frame.Radius);
  toWorld[3] = glm::dvec4(frame.Center, 1.0);
  this->FromScene = glm::mat4(fromWorld * toWorld);
  this->DataFromScene = glm::mat3(frame.Radius * glm::inverse(glm::dmat3(this->Data.Placement)));
  for (const glm::dvec4& plane : this->Data.Planes)
  {
    this->Planes.emplace_back(
      glm::dvec3(plane), (glm::dot(glm::dvec3(plane), frame.Center) + plane.w) / frame.Radius);
  }
  this->MakeTable();
  this->MakeBricks();
  this->FindBox();

  const glm::dvec3 distances = this->FindDistances(this->Data.GetToWorld());
  const double smallest = std::min({ distances.x, distances.y, distances.z });
  this->StepLength = static_cast<float>(StepOfNodes * smallest / frame.Radius);
}

// Those of nodes, on average along each axis, after a transformation of grid space.
glm::dvec3 Volume::FindDistances(const glm::dmat4& matrix) const
{
  glm::dvec3 distances;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<float>& nodes = this->Data.Axes[axis];
    const double spacing =
      nodes.empty() ? 1.0 : double(nodes.back() - nodes.front()) / double(nodes.size() - 1);
    distances[axis] = spacing * glm::length(glm::dvec3(matrix[axis]));
  }
  return distances;
}

void Volume::MakeTable()
{
  const glm::dvec3 distances = this->FindDistances(this->Data.ToData);
  const double most = this->Data.IsLit
    ? MaximumCellDepth / std::max({ distances.x, distances.y, distances.z })
    : std::numeric_limits<double>::infinity();
  const std::vector<glm::vec4>& table = this->Data.Table;
  const double entries = static_cast<double>(table.size() - 1);
  for (int i = 0; i < TableSize; ++i)
  {
    const double place = entries * i / (TableSize - 1);
    const auto low = std::min(static_cast<std::size_t>(place), table.size() - 2);
    const auto share = static_cast<float>(place - static_cast<double>(low));
    const glm::vec4 entry = glm::clamp(glm::mix(table[low], table[low + 1], share), 0.0f, 1.0f);
    const double opacity = std::min<double>(entry.w, MaximumOpacity);
    const double extinction = -std::log1p(-opacity) / this->Data.UnitDistance;
    this->Table.emplace_back(glm::vec3(entry), static_cast<float>(std::min(extinction, most)));
  }
  this->Table.emplace_back(0.0f);
  const float range = this->Data.Range[1] - this->Data.Range[0];
  this->TableScale = range > 0.0f ? (TableSize - 1) / range : 0.0f;
}

void Volume::MakeBricks()
{
  const int* size = this->Data.Size;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<float>& nodes = this->Data.Axes[axis];
    this->Bricks[axis] = (size[axis] - 2) / BrickSide + 1;
    for (int brick = 0; brick < this->Bricks[axis]; ++brick)
    {
      const int node = brick * BrickSide;
      this->BrickEdges[axis].push_back(nodes.empty() ? static_cast<float>(node) : nodes[node]);
    }
    // Beyond the outer nodes, values are those of the nodes.
    this->BrickEdges[axis].front() = static_cast<float>(this->Data.Low[axis]);
    this->BrickEdges[axis].push_back(static_cast<float>(this->Data.High[axis]));
  }
  const vtkIdType bricks = vtkIdType(this->Bricks[0]) * this->Bricks[1] * this->Bricks[2];
  this->Majorants.assign(static_cast<std::size_t>(bricks), 0.0f);
  std::vector<float> extinctions(TableSize);
  std::transform(this->Table.begin(), this->Table.end() - 1, extinctions.begin(),
    [](const glm::vec4& entry) { return entry.w; });
  const RunMaximum largest(extinctions);
  const VolumeKernel kernel(*this);
  ParallelFor(0, bricks, 0,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType brick = begin; brick < end; ++brick)
      {
        int first[3] = { static_cast<int>(brick % this->Bricks[0]),
          static_cast<int>(brick / this->Bricks[0] % this->Bricks[1]),
          static_cast<int>(brick / this->Bricks[0] / this->Bricks[1]) };
        int last[3];
        for (int axis = 0; axis < 3; ++axis)
        {
          first[axis] *= BrickSide;
          last[axis] = std::min(first[axis] + BrickSide, size[axis] - 1);
        }
        int low = TableSize;
        int high = -1;
        for (int z = first[2]; z <= last[2]; ++z)
        {
          for (int y = first[1]; y <= last[1]; ++y)
          {
            const float* row = this->Data.Values + (std::size_t(z) * size[1] + y) * size[0];
            for (int x = first[0]; x <= last[0]; ++x)
            {
              const int entry = kernel.GetEntry(row[x]);
              low = std::min(low, entry);
              high = entry < TableSize ? std::max(high, entry) : high;
            }
          }
        }
        this->Majorants[brick] = high >= 0 ? largest.Find(low, high) : 0.0f;
      }
    });
}

void Volume::FindBox()
{
  int low[3] = { this->Bricks[0], this->Bricks[1], this->Bricks[2] };
  int high[3] = { -1, -1, -1 };
  for (std::size_t brick = 0; brick < this->Majorants.size(); ++brick)
  {
    if (this->Majorants[brick] > 0.0f)
    {
      const int place[3] = { static_cast<int>(brick % this->Bricks[0]),
        static_cast<int>(brick / this->Bricks[0] % this->Bricks[1]),
        static_cast<int>(brick / this->Bricks[0] / this->Bricks[1]) };
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], place[axis]);
        high[axis] = std::max(high[axis], place[axis] + 1);
      }
    }
  }
  this->Empty = high[0] < 0;
  for (int axis = 0; axis < 3 && !this->Empty; ++axis)
  {
    this->Low[axis] = this->BrickEdges[axis][low[axis]];
    this->High[axis] = this->BrickEdges[axis][high[axis]];
  }
}

glm::vec3 Volume::ToGrid(const glm::vec3& point) const
{
  return glm::vec3(this->FromScene * glm::vec4(point, 1.0f));
}

glm::dvec3 Volume::GetCorner(int corner) const
{
  const glm::vec4 point((corner & 1) != 0 ? this->High.x : this->Low.x,
    (corner & 2) != 0 ? this->High.y : this->Low.y, (corner & 4) != 0 ? this->High.z : this->Low.z,
    1.0f);
  return glm::dvec3(glm::inverse(glm::dmat4(this->FromScene)) * glm::dvec4(point));
}

bool Volume::FindSpan(const Ray& ray, float far, float& near, float& end) const
{
  near = 0.0f;
  end = this->Empty ? -1.0f : far;
  const glm::vec3 origin = this->ToGrid(ray.Origin);
  const glm::vec3 step = glm::mat3(this->FromScene) * ray.Direction;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (step[axis] == 0.0f)
    {
      end = origin[axis] < this->Low[axis] || origin[axis] > this->High[axis] ? -1.0f : end;
      continue;
    }
    Cut(this->Low[axis], this->High[axis], origin[axis], step[axis], near, end);
  }
  for (const glm::vec4& plane : this->Planes)
  {
    const float height = glm::dot(glm::vec3(plane), ray.Origin) + plane.w;
    const float slope = glm::dot(glm::vec3(plane), ray.Direction);
    const float crossing = -height / slope;
    near = slope > 0.0f ? std::max(near, crossing) : near;
    end = slope < 0.0f ? std::min(end, crossing) : slope == 0.0f && height < 0.0f ? -1.0f : end;
  }
  return near < end;
}

void Volume::FindSpans(const Vec3Lanes& origins, const Vec3Lanes& directions,
  const Lanes<float>& far, const LaneMask& active, VolumeSpans& spans) const
{
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const Ray ray{ origins.Get(lane), directions.Get(lane) };
    const bool isMet =
      active[lane] != 0 && this->FindSpan(ray, far[lane], spans.Near[lane], spans.Far[lane]);
    if (!isMet)
    {
      spans.Near[lane] = std::numeric_limits<float>::max();
      spans.Far[lane] = 0.0f;
    }
    spans.Origin.Set(lane, this->ToGrid(ray.Origin));
    spans.Step.Set(lane, glm::mat3(this->FromScene) * ray.Direction);
    spans.Rate[lane] = this->GetRate(ray.Direction);
  }
}

void Volume::AddMedium(const VolumeSpans& spans, const Lanes<float>& at, const LaneMask& active,
  MediumLanes& medium) const
{
  Vec3Lanes places;
  LaneMask inside;
  FindPlaces(spans, at, active, places, inside);
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const auto toNodes = [&](int axis, Lanes<float>& coordinates)
    {
      const std::vector<float>& nodes = this->Data.Axes[axis];
      coordinates[lane] = nodes.empty() ? coordinates[lane] : FindNode(nodes, coordinates[lane]);
    };
    if (!this->Data.Axes[0].empty())
    {
      toNodes(0, places.X);
      toNodes(1, places.Y);
      toNodes(2, places.Z);
    }
  }
  const VolumeKernel kernel(*this);
  if (IsAnything(kernel, places, inside))
  {
    Lanes<float> values;
    if (kernel.IsNearest)
    {
      for (int lane = 0; lane < LaneCount; ++lane)
      {
        values[lane] = kernel.GetNearest(places.X[lane], places.Y[lane], places.Z[lane]);
      }
    }
    else
    {
      GetLinear(kernel, places, values);
    }
    Lanes<std::int32_t> entries;
    FindEntries(kernel, values, inside, entries);
    Vec3Lanes colors;
    Lanes<float> extinctions;
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      const glm::vec4& entry = this->Table[entries[lane]];
      colors.X[lane] = entry.x;
      colors.Y[lane] = entry.y;
      colors.Z[lane] = entry.z;
      extinctions[lane] = entry.w;
    }
    AddEntries(colors, extinctions, spans.Rate, medium);
  }
}

float Volume::Get(const glm::vec3& point, glm::vec3& color) const
{
  glm::vec3 place = this->ToGrid(point);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::vector<float>& nodes = this->Data.Axes[axis];
    place[axis] = nodes.empty() ? place[axis] : FindNode(nodes, place[axis]);
  }
  const VolumeKernel kernel(*this);
  const int entry =
    kernel.GetEntry(this->Data.IsNearest ? kernel.GetNearest(place.x, place.y, place.z)
                                         : kernel.GetLinear(place.x, place.y, place.z));
  color = glm::vec3(this->Table[entry]);
  return this->Table[entry].w;
}
}
