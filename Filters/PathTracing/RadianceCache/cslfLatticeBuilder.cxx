// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLatticeBuilder.h"

#include "cslfChartNeighbours.h"
#include "cslfLatticePatch.h"
#include "cslfLatticeSum.h"
#include "cslfSampleNoise.h"

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// The finest lattice of one brick. Finer bricks are split.
constexpr int LeafLevel = 2;

// How often the spacing is halved at the edges of very bright areas, whose errors affect all
// surfaces that they light.
constexpr int ExtraLevels = 5;

// The number of bricks processed together: enough for all threads, with bounded memory.
constexpr std::size_t BatchBricks = std::size_t(1) << 13;

// The distance of points from a triangle's edges, relative to the finest spacing, so that they do
// not lie on an adjacent surface and see what is behind it.
constexpr float Inset = 0.05f;
constexpr float LargestInset = 0.1f;

// The bits where the key's parts begin: the triangle or chart and its side, and the two
// coordinates.
constexpr int RowShift = LatticeLayout::LargestDepth + ExtraLevels + 1;
constexpr int SideShift = 2 * RowShift;
constexpr std::uint64_t VertexKey = std::uint64_t(1) << 63;
constexpr std::uint64_t MeanKey = std::uint64_t(1) << 62;

float LongestEdge(const Mesh& mesh, const glm::uvec3& triangle)
{
  const glm::vec3& a = mesh.Vertices[triangle.x];
  const glm::vec3& b = mesh.Vertices[triangle.y];
  const glm::vec3& c = mesh.Vertices[triangle.z];
  return std::max({ glm::distance(a, b), glm::distance(b, c), glm::distance(c, a) });
}

std::uint64_t MakeKey(std::size_t domain, bool back, int column, int row)
{
  return (std::uint64_t(2 * domain + (back ? 1 : 0)) << SideShift) |
    (std::uint64_t(row) << RowShift) | std::uint64_t(column);
}

// The number of an interpolated point.
constexpr std::uint32_t NotEstimated = 0xffffffffu;

}

LatticeBuilder::LatticeBuilder(const Scene& scene, const OpenSides& sides,
  const LatticeLayout& layout, LatticeSettings settings, SurfaceEstimator& estimator)
  : World(scene)
  , Sides(sides)
  , Layout(layout)
  , Settings(settings)
  , Estimator(&estimator)
  , Lattices{ layout.MakeLattice(), layout.MakeLattice() }
{
}

LatticeBuilder::~LatticeBuilder() = default;

bool LatticeBuilder::Build(const std::function<bool(double)>& goOn)
{
  return this->AddAll(goOn, [this] { this->BuildBatch(); });
}

bool LatticeBuilder::AddAll(
  const std::function<bool(double)>& goOn, const std::function<void()>& useBatch)
{
  const std::vector<Mesh>& meshes = this->World.GetMeshes();
  const std::size_t charts = this->Layout.GetCharts().size();
  const auto all = static_cast<double>(this->Lattices[0].GetNumberOfTriangles() + charts);
  std::size_t done = 0;
  const auto useFullBatch = [&]
  {
    ++done;
    if (this->Patches.size() < BatchBricks)
    {
      return true;
    }
    const bool goesOn = goOn(static_cast<double>(done) / all);
    if (goesOn)
    {
      useBatch();
    }
    return goesOn;
  };
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh)
  {
    // Surfaces that reflect nothing keep the value of an empty brick, which is 0.
    const bool isBuilt = meshes[mesh].CanHoldLattice() && !meshes[mesh].IsBlack();
    const std::size_t triangles = isBuilt ? meshes[mesh].Triangles.size() : 0;
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle)
    {
      this->AddTriangle(mesh, triangle);
      if (!useFullBatch())
      {
        return false;
      }
    }
  }
  for (std::size_t chart = 0; chart < charts; ++chart)
  {
    if (!meshes[this->Layout.GetCharts()[chart].GetMesh()].IsBlack())
    {
      this->AddChart(chart);
    }
    if (!useFullBatch())
    {
      return false;
    }
  }
  useBatch();
  return goOn(1.0);
}

void LatticeBuilder::AddTriangle(std::uint32_t mesh, std::uint32_t triangle)
{
  const std::size_t index = this->World.GetTriangleIndex(mesh, triangle);
  if (this->Layout.IsOnChart(index))
  {
    return;
  }
  const int splits = this->Lattices[0].GetSplits(index);
  const int depth = this->Layout.GetDepth(index);
  const int levels = std::min(depth, LatticeLayout::BrickLevels);
  const Mesh& surface = this->World.GetMeshes()[mesh];
  Patch patch;
  patch.Domain = index;
  patch.Mesh = mesh;
  patch.Triangle = triangle;
  patch.RootEdge = LongestEdge(surface, surface.Triangles[triangle]) / static_cast<float>(splits);
  patch.RootSize = levels + ExtraLevels;
  patch.Size = patch.RootSize;
  patch.Level = std::min({ levels, this->Settings.FirstLevel, LeafLevel });
  patch.IsConstant = depth <= this->Settings.SmallLevels && surface.Normals.empty();
  for (const bool back : { false, true })
  {
    patch.Back = back;
    for (int j = 0; j < splits && this->Sides.Has(index, back); ++j)
    {
      for (int i = 0; i < 2 * (splits - j) - 1; ++i)
      {
        patch.Flipped = i % 2 == 1;
        patch.Column = (i + 1) / 2 << patch.Size;
        patch.Row = (patch.Flipped ? j + 1 : j) << patch.Size;
        patch.Brick =
          this->Lattices[0].GetBrickIndex(index, back, CellIndex(i / 2, j, patch.Flipped, splits));
        if (!this->IsChosen || this->IsChosen(patch.Brick))
        {
          this->AddPatch(patch);
        }
      }
    }
  }
}

void LatticeBuilder::AddChart(std::size_t index)
{
  const SurfaceChart& chart = this->Layout.GetCharts()[index];
  const int levels = this->Layout.GetCellDepth(chart);
  Patch patch;
  patch.Domain = this->Lattices[0].GetNumberOfTriangles() + index;
  patch.Mesh = chart.GetMesh();
  patch.Chart = &chart;
  patch.RootEdge = std::max(chart.GetCellSize().x, chart.GetCellSize().y);
  patch.RootSize = levels + ExtraLevels;
  patch.Size = patch.RootSize;
  patch.Level = std::min({ levels, this->Settings.FirstLevel, LeafLevel });
  patch.IsConstant = levels == 0 && chart.GetBricksOfSide() == 2;
  for (const bool back : { false, true })
  {
    patch.Back = back;
    for (int row = 0; row < chart.GetRows(); ++row)
    {
      for (int column = 0; column < chart.GetColumns(); ++column)
      {
        this->AddChartCell(patch, index, column, row);
      }
    }
  }
}

void LatticeBuilder::AddChartCell(Patch& patch, std::size_t index, int column, int row)
{
  for (const bool flipped : { false, true })
  {
    patch.Flipped = flipped;
    patch.Column = (flipped ? column + 1 : column) << patch.Size;
    patch.Row = (flipped ? row + 1 : row) << patch.Size;
    const int cell = 2 * (row * patch.Chart->GetColumns() + column) + (flipped ? 1 : 0);
    patch.Brick = this->Lattices[0].GetChartBrickIndex(index, patch.Back, cell);
    if (!this->IsEmpty(patch) && (!this->IsChosen || this->IsChosen(patch.Brick)))
    {
      this->AddPatch(patch);
    }
  }
}

void LatticeBuilder::AddPatch(Patch patch)
{
  for (const int half : { 0, 1 })
  {
    patch.Half = half;
    this->Patches.push_back(patch);
  }
}

void LatticeBuilder::BuildPart(const Choice& choice,
  const std::function<void(const Hit& place, const SurfaceEstimate& estimate)>& onEstimate)
{
  this->IsChosen = choice;
  this->OnEstimate = onEstimate;
  this->Build([](double) { return true; });
  this->IsChosen = nullptr;
  this->OnEstimate = nullptr;
}

void LatticeBuilder::FillPart(const Choice& choice, SurfaceEstimator& estimator)
{
  LatticeSettings settings = this->Settings;
  settings.Tolerance = std::numeric_limits<float>::infinity();
  settings.FirstLevel = 0;
  settings.Exposure = 0.0;
  SurfaceEstimator* filling = &estimator;
  std::swap(settings, this->Settings);
  std::swap(filling, this->Estimator);
  this->BuildPart(choice, nullptr);
  std::swap(filling, this->Estimator);
  std::swap(settings, this->Settings);
}

std::size_t LatticeBuilder::CountFirstPoints(const Choice& choice)
{
  std::size_t count = 0;
  this->IsChosen = choice;
  this->AddAll([](double) { return true; },
    [this, &count]
    {
      for (Patch& patch : this->Patches)
      {
        this->RequestAll(patch);
      }
      count += this->Points.size() - this->Means;
      this->ClearBatch();
    });
  this->IsChosen = nullptr;
  return count;
}

void LatticeBuilder::BuildBatch()
{
  bool isFirst = true;
  while (std::any_of(
    this->Patches.begin(), this->Patches.end(), [](const Patch& patch) { return patch.IsOpen; }))
  {
    for (Patch& patch : this->Patches)
    {
      if (patch.IsOpen)
      {
        this->RequestAll(patch);
      }
    }
    this->FirstEstimates += isFirst ? this->Points.size() - this->Means : 0;
    this->EvaluateRequests(isFirst);
    for (std::size_t i = 0; isFirst && i < this->Patches.size(); ++i)
    {
      if (this->Patches[i].Half == 0)
      {
        this->StoreIncident(this->Patches[i]);
      }
    }
    isFirst = false;
    this->Refine();
  }
  for (const Patch& patch : this->Patches)
  {
    this->Store(patch);
  }
  for (const Point& point : this->Points)
  {
    if (this->OnEstimate && !point.IsMean)
    {
      this->OnEstimate(point.Place, point.Estimate);
    }
  }
  this->Estimates += this->Points.size() - this->Means;
  this->ClearBatch();
}

void LatticeBuilder::ClearBatch()
{
  this->Patches.clear();
  this->Points.clear();
  this->Index.clear();
  this->Evaluated = 0;
  this->Means = 0;
}

void LatticeBuilder::Refine()
{
  const std::size_t count = this->Patches.size();
  for (std::size_t index = 0; index < count; ++index)
  {
    Patch& patch = this->Patches[index];
    patch.IsOpen =
      patch.IsOpen && !patch.IsConstant && patch.Level < patch.Size && this->NeedsMore(patch);
    if (patch.IsOpen && patch.Level < LeafLevel)
    {
      ++patch.Level;
    }
    else if (patch.IsOpen)
    {
      this->Split(index);
    }
  }
}

void LatticeBuilder::Split(std::size_t index)
{
  const Patch parent = this->Patches[index];
  const std::size_t first = this->Lattices[parent.Half].SplitBrick(parent.Brick);
  const int half = (parent.Flipped ? -1 : 1) * (1 << (parent.Size - 1));
  bool hasReplaced = false;
  // The cells in order: two on the first row with the flipped one between them, one on the second.
  for (int cell = 0; cell < 4; ++cell)
  {
    Patch child = parent;
    child.Brick = first + cell;
    child.Size = parent.Size - 1;
    child.Flipped = parent.Flipped != (cell == 1);
    child.Column += cell == 1 || cell == 2 ? half : 0;
    child.Row += cell == 1 || cell == 3 ? half : 0;
    child.Points.clear();
    if (parent.Chart && this->IsEmpty(child) && (hasReplaced || cell < 3))
    {
      // There is no triangle.
      const HalfEstimate& value = this->Points[parent.Points[0]].Estimate.Halves[1 - parent.Half];
      this->Lattices[parent.Half].SetBrick(
        child.Brick, SurfaceLattice::Constant, { 0.5f * value.Value });
    }
    else if (!hasReplaced)
    {
      this->Patches[index] = child;
      hasReplaced = true;
    }
    else
    {
      this->Patches.push_back(child);
    }
  }
}

bool LatticeBuilder::IsEmpty(const Patch& patch) const
{
  const float scale = 1.0f / static_cast<float>(1 << patch.RootSize);
  const float size = (patch.Flipped ? -scale : scale) * static_cast<float>(1 << patch.Size);
  const glm::vec2 corner = scale * glm::vec2(patch.Column, patch.Row);
  const glm::vec2 corners[3] = { corner, corner + glm::vec2(size, 0.0f),
    corner + glm::vec2(0.0f, size) };
  return !patch.Chart->Overlaps(patch.Back, corners);
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
  // The corners of smooth triangles are shared with their neighbours.
  const int last = 1 << (this->Layout.GetDepth(patch.Domain) + ExtraLevels);
  const Mesh& mesh = this->World.GetMeshes()[patch.Mesh];
  std::uint64_t key = MakeKey(patch.Domain, patch.Back, column, row);
  const bool isCorner = (row == 0 && column == 0) || row == last || column == last;
  if (isCorner && !mesh.Normals.empty())
  {
    const glm::uvec3& corners = mesh.Triangles[patch.Triangle];
    const std::uint32_t vertex = row == last ? corners.z : column == last ? corners.y : corners.x;
    key = VertexKey | (std::uint64_t(patch.Mesh) << 33) | (std::uint64_t(vertex) << 1) |
      (patch.Back ? 1 : 0);
  }
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
  const std::uint64_t key = weight > 0.0f
    ? MakeKey(patch.Domain, patch.Back, column, row) | MeanKey
    : MakeKey(patch.Domain, patch.Back, columns.Low, rows.Low);
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
  const Mesh& mesh = this->World.GetMeshes()[patch.Mesh];
  const float edge = LongestEdge(mesh, mesh.Triangles[place.Triangle]);
  const float inset = Inset * this->Layout.GetSpacing() / (1 << ExtraLevels);
  const float keep = 1.0f - std::min(LargestInset, inset / edge);
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

void LatticeBuilder::EvaluateRequests(bool isFirst)
{
  SurfaceEstimator::Request request;
  request.WantsIncident = isFirst;
  std::vector<std::uint32_t> numbers; // of new points in the request
  for (std::size_t index = this->Evaluated; index < this->Points.size(); ++index)
  {
    const Point& point = this->Points[index];
    numbers.push_back(
      point.IsMean ? NotEstimated : static_cast<std::uint32_t>(request.Points.size()));
    if (!point.IsMean)
    {
      request.Points.push_back({ point.Place, point.Key });
    }
  }
  for (const int half : { 0, 1 })
  {
    request.Groups[half] = this->MakeGroups(half, numbers);
  }
  const std::vector<SurfaceEstimate> estimates = this->Estimator->Estimate(request);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    if (numbers[i] != NotEstimated)
    {
      this->Points[this->Evaluated + i].Estimate = estimates[numbers[i]];
    }
  }
  for (std::size_t index = this->Evaluated; index < this->Points.size(); ++index)
  {
    Point& point = this->Points[index];
    if (point.IsMean)
    {
      point.Estimate = Interpolate(
        this->Points[point.Before].Estimate, this->Points[point.After].Estimate, point.Weight);
    }
  }
  this->Evaluated = this->Points.size();
}

std::vector<PointGroup> LatticeBuilder::MakeGroups(
  int half, const std::vector<std::uint32_t>& numbers) const
{
  std::vector<PointGroup> groups;
  for (const Patch& patch : this->Patches)
  {
    if (!patch.IsOpen || patch.IsConstant || patch.Half != half)
    {
      continue;
    }
    PointGroup group;
    for (const std::uint32_t point : patch.Points)
    {
      if (point >= this->Evaluated && numbers[point - this->Evaluated] != NotEstimated)
      {
        group.push_back(numbers[point - this->Evaluated]);
      }
    }
    if (group.size() > 1)
    {
      groups.push_back(std::move(group));
    }
  }
  return groups;
}

void LatticeBuilder::StoreIncident(const Patch& patch)
{
  std::vector<IncidentLight> lights;
  std::vector<IncidentLight> pilots;
  for (std::uint32_t index : patch.Points)
  {
    const SurfaceEstimate& estimate = this->Points[index].Estimate;
    if (!estimate.Incident.IsKnown())
    {
      return;
    }
    lights.push_back(estimate.Incident);
    pilots.push_back(estimate.IncidentPilot);
  }
  constexpr float third = 1.0f / 3.0f;
  TrianglePoint middle{ patch.Triangle, third, third };
  if (patch.Chart)
  {
    const float size = patch.Flipped ? -third : third;
    const auto cell = static_cast<float>(1 << patch.RootSize);
    middle =
      patch.Chart->Find(patch.Back, glm::vec2(patch.Column, patch.Row) / cell + glm::vec2(size));
  }
  Hit center = this->Points[patch.Points[0]].Place;
  center.Triangle = middle.Triangle;
  center.U = middle.U;
  center.V = middle.V;
  this->Incident.Resize(this->Lattices[0].GetNumberOfRoots());
  this->Incident.Set(
    patch.Brick, Average(lights, pilots, this->World.GetSurface(center).ShadingNormal));
}

void LatticeBuilder::Store(const Patch& patch)
{
  std::vector<glm::vec3> values;
  for (std::uint32_t index : patch.Points)
  {
    values.push_back(0.5f * this->Points[index].Estimate.Halves[1 - patch.Half].Value);
  }
  const bool varies = std::any_of(values.begin(), values.end(),
    [&values](const glm::vec3& value) { return value != values.front(); });
  values.resize(varies ? values.size() : 1);
  this->Lattices[patch.Half].SetBrick(patch.Brick,
    varies ? static_cast<std::uint32_t>(patch.Level) : SurfaceLattice::Constant, values);
}

SurfaceLattice LatticeBuilder::TakeLattice()
{
  SurfaceLattice sum = AddLattices(this->Lattices[0], this->Lattices[1]);
  for (SurfaceLattice& lattice : this->Lattices)
  {
    lattice = SurfaceLattice();
  }
  return sum;
}
}
