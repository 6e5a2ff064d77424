// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSeenPlaces.h"

#include "Pipeline/cslfParallelFor.h"
#include "Quality/cslfTexelChoice.h"
#include "cslfLayout.h"

#include <vtkType.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace cslf
{
namespace
{
/// The most cells along the longest side.
constexpr float MaximumCells = 512.0f;

/// The most points of a triangle that are checked, besides its corners.
constexpr int MaximumPoints = 4096;

/// Rays pass what the geometry does not have: all that is not opaque, but for rounding.
constexpr float MinimumOpacity = 0.999f;

constexpr int BlockSide = 4; // a packet has one ray for each texel of a block

/// Tiles with at least this number of texels along each side need a ray for one of four texels
/// only: other viewpoints have theirs for the other ones.
constexpr int MinimumTexels = 16;

/// Between the hits of neighbouring rays, at most this number of cells is seen, too: rays meet
/// surfaces that they graze far apart.
constexpr int MaximumBetween = 16;
}

SeenPlaces::SeenPlaces(const Scene& scene, float edge)
  : World(scene)
{
  const Box bounds = scene.GetBounds();
  const glm::vec3 size = bounds.High - bounds.Low;
  this->Edge = std::max(edge, std::max({ size.x, size.y, size.z }) / MaximumCells);
  this->Low = bounds.Low;
  this->Cells = glm::ivec3(glm::floor(size / this->Edge)) + 1;
  const std::size_t count = std::size_t(this->Cells.x) * this->Cells.y * this->Cells.z;
  this->Marks = std::make_unique<std::atomic<std::uint8_t>[]>(count);
}

glm::ivec3 SeenPlaces::FindCell(const glm::vec3& point) const
{
  return glm::clamp(
    glm::ivec3(glm::floor((point - this->Low) / this->Edge)), glm::ivec3(0), this->Cells - 1);
}

bool SeenPlaces::IsMarked(const glm::ivec3& cell) const
{
  if (glm::any(glm::lessThan(cell, glm::ivec3(0))) ||
    glm::any(glm::greaterThanEqual(cell, this->Cells)))
  {
    return false;
  }
  return this->Marks[this->FindPlace(cell)].load(std::memory_order_relaxed) != 0;
}

bool SeenPlaces::IsNear(const glm::vec3& point) const
{
  const glm::ivec3 cell = this->FindCell(point);
  for (int i = 0; i < 27; ++i)
  {
    if (this->IsMarked(cell + glm::ivec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)))
    {
      return true;
    }
  }
  return false;
}

bool SeenPlaces::IsNear(const glm::vec3 corners[3]) const
{
  const glm::vec3 edges[2] = { corners[1] - corners[0], corners[2] - corners[0] };
  const float area = 0.5f * glm::length(glm::cross(edges[0], edges[1]));
  const float length =
    std::max({ glm::length(edges[0]), glm::length(edges[1]), glm::length(edges[1] - edges[0]) });
  // Slivers need points for their length.
  const float wanted = std::max(area / (this->Edge * this->Edge), length / this->Edge);
  const int points = static_cast<int>(std::min(2.0f * wanted, float(MaximumPoints)));
  for (int i = 0; i < 3; ++i)
  {
    if (this->IsNear(corners[i]))
    {
      return true;
    }
  }
  for (int i = 0; i < points; ++i)
  {
    auto u = static_cast<float>(RobertsNumber(i, 0));
    auto v = static_cast<float>(RobertsNumber(i, 1));
    if (u + v > 1.0f)
    {
      u = 1.0f - u;
      v = 1.0f - v;
    }
    if (this->IsNear(corners[0] + u * edges[0] + v * edges[1]))
    {
      return true;
    }
  }
  return false;
}

void SeenPlaces::LookAlong(const RayGrid& rays, int texels, int stride, const glm::ivec2& first)
{
  const int side = (texels + stride - 1) / stride;
  const glm::ivec3 none(-1);
  std::vector<glm::ivec3> cells(std::size_t(side) * side, none);
  RayPacket packet;
  packet.MinimumOpacity = MinimumOpacity;
  PacketScale scale;
  float x[RayPacket::Size];
  float y[RayPacket::Size];
  for (int row = 0; row < side; row += BlockSide)
  {
    for (int column = 0; column < side; column += BlockSide)
    {
      for (int lane = 0; lane < RayPacket::Size; ++lane)
      {
        x[lane] = static_cast<float>(stride * (column + lane % BlockSide) + first.x) + 0.5f;
        y[lane] = static_cast<float>(stride * (row + lane / BlockSide) + first.y) + 0.5f;
      }
      SetRays(rays, x, y, packet, scale);
      this->World.Intersect(packet);
      for (int lane = 0; lane < RayPacket::Size; ++lane)
      {
        const int atX = column + lane % BlockSide;
        const int atY = row + lane / BlockSide;
        const bool isInside = stride * atX + first.x < texels && stride * atY + first.y < texels;
        if (packet.Active[lane] && packet.IsHit(lane) && isInside)
        {
          const Ray ray = packet.GetRay(lane);
          cells[std::size_t(atY) * side + atX] =
            this->FindCell(ray.Origin + packet.GetHit(lane).Distance * ray.Direction);
        }
      }
    }
  }
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    if (cells[k] != none)
    {
      this->Mark(cells[k]);
      if (k % side > 0 && cells[k - 1] != none)
      {
        this->MarkBetween(cells[k - 1], cells[k]);
      }
      if (k >= std::size_t(side) && cells[k - side] != none)
      {
        this->MarkBetween(cells[k - side], cells[k]);
      }
    }
  }
}

void SeenPlaces::MarkBetween(const glm::ivec3& first, const glm::ivec3& last)
{
  const glm::ivec3 way = last - first;
  const int steps = std::max({ std::abs(way.x), std::abs(way.y), std::abs(way.z) });
  for (int step = 1; step < steps && steps <= MaximumBetween; ++step)
  {
    this->Mark(first + way * step / steps);
  }
}

void SeenPlaces::Mark(const glm::ivec3& cell)
{
  this->Marks[this->FindPlace(cell)].store(1, std::memory_order_relaxed);
}

std::size_t SeenPlaces::FindPlace(const glm::ivec3& cell) const
{
  return (std::size_t(cell.z) * this->Cells.y + cell.y) * this->Cells.x + cell.x;
}

void SeenPlaces::Look(
  int tiles, int side, const std::function<RayGrid(int tile)>& rays, const Progress& progress)
{
  const int stride = side < MinimumTexels ? 1 : 2;
  ParallelFor(0, tiles, OrAbort(progress),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType tile = begin; tile < end; ++tile)
      {
        const vtkIdType viewpoint = tile / TileCount;
        const glm::ivec2 first(viewpoint % stride, viewpoint / 2 % stride);
        this->LookAlong(rays(static_cast<int>(tile)), side, stride, first);
      }
    });
}

SeenPlaces SeenPlaces::Widen(int factor) const
{
  SeenPlaces wide(this->World, static_cast<float>(factor) * this->Edge);
  glm::ivec3 cell;
  for (cell.z = 0; cell.z < this->Cells.z; ++cell.z)
  {
    for (cell.y = 0; cell.y < this->Cells.y; ++cell.y)
    {
      for (cell.x = 0; cell.x < this->Cells.x; ++cell.x)
      {
        if (this->IsMarked(cell))
        {
          wide.Mark(glm::min(cell / factor, wide.Cells - 1));
        }
      }
    }
  }
  return wide;
}

void SeenPlaces::KeepSeen(std::vector<glm::vec3>& points) const
{
  points.erase(std::remove_if(points.begin(), points.end(),
                 [this](const glm::vec3& point) { return !this->IsNear(point); }),
    points.end());
}

void SeenPlaces::KeepSeen(SurfaceMesh& mesh, const Progress& progress) const
{
  std::vector<char> isKept(mesh.Triangles.size(), 0);
  ParallelFor(0, static_cast<vtkIdType>(mesh.Triangles.size()), OrAbort(progress),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const glm::uvec3& triangle = mesh.Triangles[i];
        const glm::vec3 corners[3] = { mesh.Points[triangle.x], mesh.Points[triangle.y],
          mesh.Points[triangle.z] };
        isKept[i] = this->IsNear(corners) ? 1 : 0;
      }
    });
  Keep(isKept, mesh);
}
}
