// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLatticeBuilder.h"

#include <vtkSMPTools.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
// The finest splits of a triangle's edges, as a binary logarithm: what a key has room for.
constexpr int LargestDepth = 12;

// The most corners of bricks in a scene; beyond, the spacing grows.
constexpr std::size_t MaximumBricks = std::size_t(1) << 23;

// Bricks that are worked on together: enough for all threads, and of bounded memory.
constexpr std::size_t BatchBricks = std::size_t(1) << 13;

// How far points keep off a triangle's edges, in parts of the spacing, lest they lie on the surface
// that meets it there and see what is behind.
constexpr float Inset = 0.05f;
constexpr float LargestInset = 0.1f;

// Where the key's parts begin: which triangle and side, and the two coordinates.
constexpr int SideShift = 26;
constexpr int RowShift = 13;
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
  int I; // its cell in the triangle
  int J;
  bool Flipped;
  int Levels; // of its finest points
  int Level;
  int LastLevel; // that is allowed
  bool IsConstant;
  bool IsOpen = true;
  std::vector<std::uint32_t> Points;

  std::uint32_t GetPoint(int i, int j) const
  {
    return this->Points[PointIndex(i, j, 1 << this->Level)];
  }
};

LatticeBuilder::LatticeBuilder(const Scene& scene, LatticeSettings settings, Estimator estimate)
  : World(scene)
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
      for (const glm::uvec3& triangle : mesh.Triangles)
      {
        const float ratio = LongestEdge(mesh, triangle) / this->Settings.Spacing;
        const int depth =
          std::clamp(static_cast<int>(std::ceil(std::log2(ratio))), 0, LargestDepth);
        const int split = std::max(0, depth - LatticeSettings::BrickLevels);
        this->Depths.push_back(static_cast<std::uint8_t>(depth));
        splits.push_back(static_cast<std::uint8_t>(split));
        bricks += std::size_t(2) << (2 * split);
      }
    }
    this->Settings.Spacing *= 1.5f;
  } while (bricks > MaximumBricks && bricks > 2 * splits.size());
  this->Settings.Spacing /= 1.5f;
  this->Lattice = SurfaceLattice(splits);
}

bool LatticeBuilder::IsSmall(std::uint32_t mesh, std::uint32_t triangle) const
{
  const std::size_t index = this->World.GetTriangleIndex(mesh, triangle);
  return this->Depths[index] == 0 && this->World.GetMeshes()[mesh].Normals.empty();
}

bool LatticeBuilder::Build(const std::function<bool(double)>& goOn)
{
  const std::vector<Mesh>& meshes = this->World.GetMeshes();
  std::size_t done = 0;
  for (std::uint32_t mesh = 0; mesh < meshes.size(); ++mesh)
  {
    for (std::uint32_t triangle = 0; triangle < meshes[mesh].Triangles.size(); ++triangle, ++done)
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
  const int levels = std::min<int>(this->Depths[index], LatticeSettings::BrickLevels);
  Patch patch;
  patch.Mesh = mesh;
  patch.Triangle = triangle;
  patch.Levels = levels;
  patch.LastLevel = std::min(levels, this->Settings.LastLevel);
  patch.Level = std::min(patch.LastLevel, this->Settings.FirstLevel);
  patch.IsConstant = this->IsSmall(mesh, triangle);
  for (const bool back : { false, true })
  {
    patch.Back = back;
    for (patch.J = 0; patch.J < splits; ++patch.J)
    {
      for (patch.I = 0; patch.I < splits - patch.J; ++patch.I)
      {
        for (const bool flipped : { false, true })
        {
          if (!flipped || patch.I + patch.J < splits - 1)
          {
            patch.Flipped = flipped;
            patch.Brick = this->Lattice.GetBrickIndex(
              index, back, CellIndex(patch.I, patch.J, flipped, splits));
            this->Patches.push_back(patch);
          }
        }
      }
    }
  }
}

void LatticeBuilder::BuildBatch()
{
  bool isOpen = true;
  while (isOpen)
  {
    for (Patch& patch : this->Patches)
    {
      if (patch.IsOpen)
      {
        this->RequestAll(patch);
      }
    }
    this->EvaluateRequests();
    isOpen = false;
    for (Patch& patch : this->Patches)
    {
      patch.IsOpen = patch.IsOpen && patch.Level < patch.LastLevel && this->NeedsMore(patch);
      patch.Level += patch.IsOpen ? 1 : 0;
      isOpen = isOpen || patch.IsOpen;
    }
  }
  for (const Patch& patch : this->Patches)
  {
    this->Store(patch);
  }
  this->Estimates += this->Points.size();
  this->Patches.clear();
  this->Points.clear();
  this->Index.clear();
  this->Evaluated = 0;
}

void LatticeBuilder::RequestAll(Patch& patch)
{
  patch.Points.clear();
  if (patch.IsConstant)
  {
    patch.Points.push_back(this->Request(patch, 0, 0, 0));
    return;
  }
  const int splits = 1 << patch.Level;
  for (int j = 0; j <= splits; ++j)
  {
    for (int i = 0; i <= splits - j; ++i)
    {
      patch.Points.push_back(this->Request(patch, i, j, patch.Level));
    }
  }
}

std::uint32_t LatticeBuilder::Request(const Patch& patch, int i, int j, int level)
{
  // Where is the point among the triangle's finest ones?
  const std::size_t triangle = this->World.GetTriangleIndex(patch.Mesh, patch.Triangle);
  const int depth = this->Depths[triangle];
  const int size = 1 << patch.Levels;
  const int step = size >> level;
  const int flip = patch.Flipped ? -1 : 1;
  const int row = (patch.J + (patch.Flipped ? 1 : 0)) * size + flip * j * step;
  const int column = (patch.I + (patch.Flipped ? 1 : 0)) * size + flip * i * step;

  // The corners of smooth triangles are their neighbours', too.
  const Mesh& mesh = this->World.GetMeshes()[patch.Mesh];
  const int last = 1 << depth;
  std::uint64_t key = ((std::uint64_t(2 * triangle + (patch.Back ? 1 : 0)) << SideShift) |
    (std::uint64_t(row) << RowShift) | std::uint64_t(column));
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

  Point point;
  point.Key = key;
  point.Place.Mesh = patch.Mesh;
  point.Place.Triangle = patch.Triangle;
  point.Place.Back = patch.Back;
  constexpr float third = 1.0f / 3.0f;
  point.Place.U = third;
  point.Place.V = third;
  if (!patch.IsConstant)
  {
    const float edge = LongestEdge(mesh, mesh.Triangles[patch.Triangle]);
    const float keep = 1.0f - std::min(LargestInset, Inset * this->Settings.Spacing / edge);
    point.Place.U += keep * (static_cast<float>(column) / last - third);
    point.Place.V += keep * (static_cast<float>(row) / last - third);
  }
  this->Points.push_back(point);
  return entry->second;
}

void LatticeBuilder::EvaluateRequests()
{
  vtkSMPTools::For(static_cast<vtkIdType>(this->Evaluated),
    static_cast<vtkIdType>(this->Points.size()), 1,
    [this](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType index = begin; index < end; ++index)
      {
        Point& point = this->Points[index];
        point.Estimate = this->Estimate(point.Place, point.Key);
      }
    });
  this->Evaluated = this->Points.size();
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
      float error = 0.0f;
      if (i % 2 == 1 && j % 2 == 0)
      {
        error = this->InterpolationError(patch, i, j, 1, 0);
      }
      else if (i % 2 == 0 && j % 2 == 1)
      {
        error = this->InterpolationError(patch, i, j, 0, 1);
      }
      else if (i % 2 == 1 && j % 2 == 1)
      {
        error = this->InterpolationError(patch, i, j, 1, -1);
      }
      if (error > this->Settings.Tolerance)
      {
        return true;
      }
    }
  }
  return false;
}

float LatticeBuilder::InterpolationError(
  const Patch& patch, int i, int j, int sideI, int sideJ) const
{
  const Point& point = this->Points[patch.GetPoint(i, j)];
  const glm::vec3 mean = 0.5f *
    (this->Points[patch.GetPoint(i - sideI, j - sideJ)].Estimate.Value +
      this->Points[patch.GetPoint(i + sideI, j + sideJ)].Estimate.Value);
  const glm::vec3 color = this->World.GetBaseColor(point.Place);
  return Largest(
    this->Settings.Display(point.Estimate.Value, color) - this->Settings.Display(mean, color));
}

bool LatticeBuilder::VariesWithin(const Patch& patch) const
{
  const Mesh& mesh = this->World.GetMeshes()[patch.Mesh];
  const float size = LongestEdge(mesh, mesh.Triangles[patch.Triangle]) /
    static_cast<float>(
      this->Lattice.GetSplits(this->World.GetTriangleIndex(patch.Mesh, patch.Triangle)));
  const Point& first = this->Points[patch.Points[0]];
  const glm::vec3 color = this->World.GetBaseColor(first.Place);
  const glm::vec3 seen = this->Settings.Display(first.Estimate.Value, color);
  for (std::uint32_t index : patch.Points)
  {
    const SurfaceEstimate& estimate = this->Points[index].Estimate;
    if (estimate.Reach < size ||
      Largest(this->Settings.Display(estimate.Value, color) - seen) > this->Settings.Tolerance)
    {
      return true;
    }
  }
  return false;
}

void LatticeBuilder::Store(const Patch& patch)
{
  std::vector<glm::vec3> values;
  bool varies = false;
  for (std::uint32_t index : patch.Points)
  {
    values.push_back(this->Points[index].Estimate.Value);
    varies = varies || values.back() != values.front();
  }
  if (!varies)
  {
    values.resize(1);
  }
  this->Lattice.SetBrick(patch.Brick,
    varies ? static_cast<std::uint32_t>(patch.Level) : SurfaceLattice::Constant, values);
}
}
