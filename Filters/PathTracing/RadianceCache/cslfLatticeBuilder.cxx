// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLatticeBuilder.h"

#include <vtkSMPTools.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// The size of a brick, as the binary logarithm of spacings.
constexpr int BrickLevels = 4;

// The finest lattice of one brick: beyond, it is split.
constexpr int LeafLevel = 2;

// How often the spacing is halved where something very bright ends: the error of a point's light is
// carried far by all surfaces that it lights.
constexpr int ExtraLevels = 5;

// The finest spacings along a triangle's edges, as a binary logarithm: with the extra levels, what
// a key has room for.
constexpr int LargestDepth = 12;

// How many spacings wide the interpolation between white and black may be; half as many between
// twice as bright and black, and so on.
constexpr double BrightEdge = 2.0;

// Points of this distance, in spacings, or less are close enough: half of it would be closer than
// was asked for.
constexpr float CoarseSpacings = 1.5f;

// How the spacing grows where bricks are too many.
constexpr float SpacingGrowth = 1.5f;

// The most bricks of a scene; beyond, the spacing grows.
constexpr std::size_t MaximumBricks = std::size_t(1) << 23;

// Bricks that are worked on together: enough for all threads, and of bounded memory.
constexpr std::size_t BatchBricks = std::size_t(1) << 13;

// How far points keep off a triangle's edges, in parts of the finest spacing, lest they lie on the
// surface that meets it there and see what is behind.
constexpr float Inset = 0.05f;
constexpr float LargestInset = 0.1f;

// Where the key's parts begin: which triangle and side, and the two coordinates.
constexpr int RowShift = LargestDepth + ExtraLevels + 1;
constexpr int SideShift = 2 * RowShift;
constexpr std::uint64_t VertexKey = std::uint64_t(1) << 63;

float LongestEdge(const Mesh& mesh, const glm::uvec3& triangle)
{
  const glm::vec3& a = mesh.Vertices[triangle.x];
  const glm::vec3& b = mesh.Vertices[triangle.y];
  const glm::vec3& c = mesh.Vertices[triangle.z];
  return std::max({ glm::distance(a, b), glm::distance(b, c), glm::distance(c, a) });
}

float Largest(const glm::vec3& difference)
{
  const glm::vec3 size = glm::abs(difference);
  return std::max({ size.x, size.y, size.z });
}
}

struct LatticeBuilder::Point
{
  Hit Place;
  std::uint64_t Key;
  SurfaceEstimate Estimate;
};

/// A brick at work, and the points of its lattice, row by row.
struct LatticeBuilder::Patch
{
  std::size_t Brick;
  std::uint32_t Mesh;
  std::uint32_t Triangle;
  bool Back;
  bool Flipped;
  int Column; // of its first corner among the triangle's finest points
  int Row;
  int Size; // of its edges, in finest points, as a binary logarithm
  int Level = 0;
  bool IsConstant;
  bool IsOpen = true;
  std::vector<std::uint32_t> Points;

  std::uint32_t GetPoint(int i, int j) const
  {
    return this->Points[PointIndex(i, j, 1 << this->Level)];
  }
};

LatticeBuilder::LatticeBuilder(
  const Scene& scene, const OpenSides& sides, LatticeSettings settings, Estimator estimate)
  : World(scene)
  , Sides(sides)
  , Settings(std::move(settings))
  , Estimate(std::move(estimate))
{
  this->ChooseSplits();
}

LatticeBuilder::~LatticeBuilder() = default;

void LatticeBuilder::ChooseSplits()
{
  std::vector<std::uint8_t> splits;
  std::size_t bricks = 0;
  do
  {
    bricks = 0;
    splits.clear();
    this->Depths.clear();
    for (const Mesh& mesh : this->World.GetMeshes())
    {
      for (std::size_t i = 0; mesh.CanHoldLattice() && i < mesh.Triangles.size(); ++i)
      {
        const glm::uvec3& triangle = mesh.Triangles[i];
        const float ratio = LongestEdge(mesh, triangle) / this->Settings.Spacing;
        const int depth =
          std::clamp(static_cast<int>(std::ceil(std::log2(ratio))), 0, LargestDepth);
        const int split = std::max(0, depth - BrickLevels);
        this->Depths.push_back(static_cast<std::uint8_t>(depth));
        splits.push_back(static_cast<std::uint8_t>(split));
        bricks += std::size_t(2) << (2 * split);
      }
    }
    this->Settings.Spacing *= SpacingGrowth;
  } while (bricks > MaximumBricks && bricks > 2 * splits.size());
  this->Settings.Spacing /= SpacingGrowth;
  this->Lattice = SurfaceLattice(splits);
}

bool LatticeBuilder::IsSmall(std::uint32_t mesh, std::uint32_t triangle) const
{
  const std::size_t index = this->World.GetTriangleIndex(mesh, triangle);
  return this->Depths[index] <= this->Settings.SmallLevels &&
    this->World.GetMeshes()[mesh].Normals.empty();
}

bool LatticeBuilder::Build(const std::function<bool(double)>& goOn)
{
  const std::vector<Mesh>& meshes = this->World.GetMeshes();
  std::size_t done = 0;
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh)
  {
    const std::size_t triangles = meshes[mesh].CanHoldLattice() ? meshes[mesh].Triangles.size() : 0;
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle, ++done)
    {
      this->AddTriangle(mesh, triangle);
      if (this->Patches.size() >= BatchBricks)
      {
        if (!goOn(static_cast<double>(done) / this->Lattice.GetNumberOfTriangles()))
        {
          return false;
        }
        this->BuildBatch();
      }
    }
  }
  this->BuildBatch();
  return goOn(1.0);
}

void LatticeBuilder::AddTriangle(std::uint32_t mesh, std::uint32_t triangle)
{
  const std::size_t index = this->World.GetTriangleIndex(mesh, triangle);
  const int splits = this->Lattice.GetSplits(index);
  const int levels = std::min<int>(this->Depths[index], BrickLevels);
  Patch patch;
  patch.Mesh = mesh;
  patch.Triangle = triangle;
  patch.Size = levels + ExtraLevels;
  patch.Level = std::min({ levels, this->Settings.FirstLevel, LeafLevel });
  patch.IsConstant = this->IsSmall(mesh, triangle);
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
          this->Lattice.GetBrickIndex(index, back, CellIndex(i / 2, j, patch.Flipped, splits));
        if (!this->IsChosen || this->IsChosen(patch.Brick))
        {
          this->Patches.push_back(patch);
        }
      }
    }
  }
}

void LatticeBuilder::BuildPart(const Choice& choice,
  const std::function<void(const Hit& place, const SurfaceEstimate& estimate)>& tell)
{
  this->IsChosen = choice;
  this->Tell = tell;
  this->Build([](double) { return true; });
  this->IsChosen = nullptr;
  this->Tell = nullptr;
}

void LatticeBuilder::FillPart(const Choice& choice, const Estimator& estimate)
{
  LatticeSettings settings = this->Settings;
  settings.Tolerance = std::numeric_limits<float>::infinity();
  settings.FirstLevel = 0;
  settings.Exposure = 0.0;
  settings.Share = nullptr;
  Estimator filling = estimate;
  std::swap(settings, this->Settings);
  std::swap(filling, this->Estimate);
  this->BuildPart(choice, nullptr);
  std::swap(filling, this->Estimate);
  std::swap(settings, this->Settings);
}

std::size_t LatticeBuilder::CountFirstPoints(const Choice& choice)
{
  std::size_t count = 0;
  this->IsChosen = choice;
  const std::vector<Mesh>& meshes = this->World.GetMeshes();
  const auto countBatch = [this, &count]
  {
    for (Patch& patch : this->Patches)
    {
      this->RequestAll(patch);
    }
    count += this->Points.size();
    this->ClearBatch();
  };
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh)
  {
    const std::size_t triangles = meshes[mesh].CanHoldLattice() ? meshes[mesh].Triangles.size() : 0;
    for (std::uint32_t triangle = 0; triangle < triangles; ++triangle)
    {
      this->AddTriangle(mesh, triangle);
      if (this->Patches.size() >= BatchBricks)
      {
        countBatch();
      }
    }
  }
  countBatch();
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
    this->FirstEstimates += isFirst ? this->Points.size() : 0;
    this->EvaluateRequests();
    for (std::size_t i = 0; isFirst && i < this->Patches.size(); ++i)
    {
      this->StoreIncident(this->Patches[i]);
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
    if (this->Tell)
    {
      this->Tell(point.Place, point.Estimate);
    }
  }
  this->Estimates += this->Points.size();
  this->ClearBatch();
}

void LatticeBuilder::ClearBatch()
{
  this->Patches.clear();
  this->Points.clear();
  this->Index.clear();
  this->Evaluated = 0;
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
  const std::size_t first = this->Lattice.SplitBrick(parent.Brick);
  const int half = (parent.Flipped ? -1 : 1) * (1 << (parent.Size - 1));
  // The cells in their order: two on the first row and the flipped one between, one on the second.
  for (int cell = 0; cell < 4; ++cell)
  {
    Patch child = parent;
    child.Brick = first + cell;
    child.Size = parent.Size - 1;
    child.Flipped = parent.Flipped != (cell == 1);
    child.Column += cell == 1 || cell == 2 ? half : 0;
    child.Row += cell == 1 || cell == 3 ? half : 0;
    child.Points.clear();
    if (cell == 0)
    {
      this->Patches[index] = child;
    }
    else
    {
      this->Patches.push_back(child);
    }
  }
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
  // Where is the point among the triangle's finest ones?
  const std::size_t triangle = this->World.GetTriangleIndex(patch.Mesh, patch.Triangle);
  const int last = 1 << (this->Depths[triangle] + ExtraLevels);
  const int step = (patch.Flipped ? -1 : 1) * (1 << (patch.Size - patch.Level));
  const int column = patch.Column + i * step;
  const int row = patch.Row + j * step;

  // The corners of smooth triangles are their neighbours', too.
  const Mesh& mesh = this->World.GetMeshes()[patch.Mesh];
  std::uint64_t key = (std::uint64_t(2 * triangle + (patch.Back ? 1 : 0)) << SideShift) |
    (std::uint64_t(row) << RowShift) | std::uint64_t(column);
  const bool isCorner = (row == 0 && column == 0) || row == last || column == last;
  if (isCorner && !mesh.Normals.empty())
  {
    const glm::uvec3& corners = mesh.Triangles[patch.Triangle];
    const std::uint32_t vertex = row == last ? corners.z : column == last ? corners.y : corners.x;
    key = VertexKey | (std::uint64_t(patch.Mesh) << 33) | (std::uint64_t(vertex) << 1) |
      (patch.Back ? 1 : 0);
  }
  const auto [entry, isNew] =
    this->Index.emplace(key, static_cast<std::uint32_t>(this->Points.size()));
  if (!isNew)
  {
    return entry->second;
  }

  constexpr float third = 1.0f / 3.0f;
  Point point;
  point.Key = key;
  point.Place.Mesh = patch.Mesh;
  point.Place.Triangle = patch.Triangle;
  point.Place.Back = patch.Back;
  point.Place.U = third;
  point.Place.V = third;
  if (!patch.IsConstant)
  {
    const float edge = LongestEdge(mesh, mesh.Triangles[patch.Triangle]);
    const float inset = Inset * this->Settings.Spacing / (1 << ExtraLevels);
    const float keep = 1.0f - std::min(LargestInset, inset / edge);
    point.Place.U += keep * (static_cast<float>(column) / static_cast<float>(last) - third);
    point.Place.V += keep * (static_cast<float>(row) / static_cast<float>(last) - third);
  }
  this->Points.push_back(point);
  return entry->second;
}

void LatticeBuilder::EvaluateRequests()
{
  const CacheShare* share = this->Settings.Share;
  vtkSMPTools::For(static_cast<vtkIdType>(this->Evaluated),
    static_cast<vtkIdType>(this->Points.size()), 1,
    [this, share](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType index = begin; index < end; ++index)
      {
        if (!share || share->GetOwner(index) == share->GetRank())
        {
          Point& point = this->Points[index];
          point.Estimate = this->Estimate(point.Place, point.Key);
        }
      }
    });
  this->ExchangeEstimates();
  this->Evaluated = this->Points.size();
}

void LatticeBuilder::ExchangeEstimates()
{
  if (!this->Settings.Share)
  {
    return;
  }
  std::vector<SurfaceEstimate> estimates;
  for (std::size_t index = this->Evaluated; index < this->Points.size(); ++index)
  {
    estimates.push_back(this->Points[index].Estimate);
  }
  this->Settings.Share->Complete(estimates, this->Evaluated);
  for (std::size_t index = this->Evaluated; index < this->Points.size(); ++index)
  {
    this->Points[index].Estimate = estimates[index - this->Evaluated];
  }
}

float LatticeBuilder::GetDistance(const Patch& patch) const
{
  const Mesh& mesh = this->World.GetMeshes()[patch.Mesh];
  const std::size_t triangle = this->World.GetTriangleIndex(patch.Mesh, patch.Triangle);
  const int points = 1 << (this->Depths[triangle] + ExtraLevels - patch.Size + patch.Level);
  return LongestEdge(mesh, mesh.Triangles[patch.Triangle]) / static_cast<float>(points);
}

bool LatticeBuilder::NeedsMore(const Patch& patch) const
{
  if (patch.Level == 0)
  {
    return this->VariesWithin(patch);
  }
  // The points that the last level added lie in the middle of edges of the one before.
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

bool LatticeBuilder::IsMissed(const Patch& patch, int i, int j, int sideI, int sideJ) const
{
  const Point& point = this->Points[patch.GetPoint(i, j)];
  const SurfaceEstimate& here = point.Estimate;
  const SurfaceEstimate& before = this->Points[patch.GetPoint(i - sideI, j - sideJ)].Estimate;
  const SurfaceEstimate& after = this->Points[patch.GetPoint(i + sideI, j + sideJ)].Estimate;
  const glm::vec3 interpolated = 0.5f * (before.Value + after.Value);
  // What is brighter than white lights other places, however narrow it is.
  const float distance = this->GetDistance(patch);
  if (this->IsBright(here.Value - interpolated, distance))
  {
    return true;
  }
  if (!this->IsCoarse(distance))
  {
    return false;
  }
  const glm::vec3 color = this->World.GetBaseColor(point.Place);
  const float error = Largest(
    this->Settings.Display(here.Value, color) - this->Settings.Display(interpolated, color));
  return error > this->Settings.Tolerance + here.Noise + 0.5f * (before.Noise + after.Noise);
}

bool LatticeBuilder::VariesWithin(const Patch& patch) const
{
  const Point& first = this->Points[patch.Points[0]];
  const glm::vec3 color = this->World.GetBaseColor(first.Place);
  const glm::vec3 seen = this->Settings.Display(first.Estimate.Value, color);
  const float size = this->GetDistance(patch);
  const bool isCoarse = this->IsCoarse(size);
  return std::any_of(patch.Points.begin(), patch.Points.end(),
    [&](std::uint32_t index)
    {
      const SurfaceEstimate& estimate = this->Points[index].Estimate;
      const bool varies = estimate.Reach < size ||
        Largest(this->Settings.Display(estimate.Value, color) - seen) > this->Settings.Tolerance;
      return (isCoarse && varies) || this->IsBright(estimate.Value - first.Estimate.Value, size);
    });
}

bool LatticeBuilder::IsCoarse(float distance) const
{
  return distance > CoarseSpacings * this->Settings.Spacing && !this->Settings.OnlyBright;
}

bool LatticeBuilder::IsBright(const glm::vec3& error, float distance) const
{
  const double radiance = this->Settings.Exposure * Largest(error);
  return radiance * distance > BrightEdge * this->Settings.Spacing;
}

void LatticeBuilder::StoreIncident(const Patch& patch)
{
  std::vector<IncidentLight> lights;
  for (std::uint32_t index : patch.Points)
  {
    const IncidentLight& light = this->Points[index].Estimate.Incident;
    if (!light.IsKnown())
    {
      return;
    }
    lights.push_back(light);
  }
  Hit center = this->Points[patch.Points[0]].Place;
  center.Mesh = patch.Mesh;
  center.Triangle = patch.Triangle;
  center.U = 1.0f / 3.0f;
  center.V = 1.0f / 3.0f;
  this->Incident.Resize(this->Lattice.GetNumberOfRoots());
  this->Incident.Set(patch.Brick, Average(lights, this->World.GetSurface(center).ShadingNormal));
}

void LatticeBuilder::Store(const Patch& patch)
{
  std::vector<glm::vec3> values;
  for (std::uint32_t index : patch.Points)
  {
    values.push_back(this->Points[index].Estimate.Value);
  }
  const bool varies = std::any_of(values.begin(), values.end(),
    [&values](const glm::vec3& value) { return value != values.front(); });
  values.resize(varies ? values.size() : 1);
  this->Lattice.SetBrick(patch.Brick,
    varies ? static_cast<std::uint32_t>(patch.Level) : SurfaceLattice::Constant, values);
}
}
