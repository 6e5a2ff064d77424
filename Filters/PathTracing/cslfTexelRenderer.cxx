// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelRenderer.h"

#include "cslfColor.h"

#include <vtkSMPTools.h>
#include <vtkType.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// The samples of a batch: enough to keep many threads busy, about a second's worth on few.
constexpr std::int64_t BatchSamples = 1 << 20;
constexpr std::int64_t SmallestBatch = 64;

// Rays that start further from the scene, whose radius is 1, are moved closer, for a float's sake.
constexpr double FarAway = 8.0;
constexpr double Near = 2.0;

/// How the grid's parameter of a packet's ray depends on its distance.
struct PacketRay
{
  double Start = 0.0;  // the parameter where the packet's ray starts
  double Length = 1.0; // of the grid's direction

  double ToParameter(float distance) const { return this->Start + distance / this->Length; }
};

/// Makes a lane of the packet the ray through a position of the grid: inactive where that cannot
/// meet the scene.
PacketRay SetRay(const RayGrid& grid, const glm::dvec2& position, RayPacket& packet, int lane)
{
  const glm::dvec3 origin = grid.Origin + position.x * grid.OriginX + position.y * grid.OriginY;
  const glm::dvec3 path =
    grid.Direction + position.x * grid.DirectionX + position.y * grid.DirectionY;
  PacketRay ray;
  ray.Length = glm::length(path);
  packet.Active[lane] = ray.Length > 0.0 && std::isfinite(ray.Length);
  if (!packet.Active[lane])
  {
    return ray;
  }
  const glm::dvec3 direction = path / ray.Length;
  double start = 0.0;
  const double distance2 = glm::dot(origin, origin);
  if (distance2 > FarAway * FarAway)
  {
    // Start on a sphere around the scene.
    const double along = -glm::dot(origin, direction);
    const double inside2 = Near * Near - (distance2 - along * along);
    packet.Active[lane] = along > 0.0 && inside2 > 0.0;
    start = along - std::sqrt(std::max(inside2, 0.0));
  }
  ray.Start = start / ray.Length;
  packet.Rays[lane] = { origin + start * direction, direction };
  return ray;
}
}

/// A square of texels in one tile; its lanes run along x first.
struct TexelRenderer::Block
{
  RayGrid Grid;
  int Slice;
  int Tile;
  int X; // of the first texel, in the tile
  int Y;
  bool Inside[RayPacket::Size];          // whether the tile has the lane's texel
  std::uint64_t Hashes[RayPacket::Size]; // of the texels, for their random numbers

  int LaneX(int lane) const { return this->X + lane % BlockSide; }
  int LaneY(int lane) const { return this->Y + lane / BlockSide; }
};

/// What the samples of a texel add up to.
struct TexelRenderer::Sums
{
  glm::dvec3 Radiance{ 0.0 };
  int Covered = 0; // samples that see something
  double Depth = 1.0;
  double DepthOffset = std::numeric_limits<double>::max(); // how far from the centre that was found

  void AddDepth(double depth, double offset)
  {
    if (offset < this->DepthOffset)
    {
      this->Depth = depth;
      this->DepthOffset = offset;
    }
  }
};

TexelRenderer::TexelRenderer(const Scene& scene, const PictureLayout& layout,
  const RenderSettings& settings, std::function<RayGrid(int slice, int tile)> grids,
  const TexelOutput& output)
  : World(scene)
  , Layout(layout)
  , Settings(settings)
  , Grids(std::move(grids))
  , Output(output)
  , Integrator(scene, settings.Paths, settings.Cache)
{
}

bool TexelRenderer::Render(const std::function<bool(double)>& goOn) const
{
  const std::int64_t columns = (this->Layout.TileWidth + BlockSide - 1) / BlockSide;
  const std::int64_t rows = (this->Layout.TileHeight + BlockSide - 1) / BlockSide;
  const std::int64_t blocks = columns * rows * this->Layout.Tiles * this->Layout.Slices;
  const std::int64_t samplesOfBlock =
    std::int64_t(BlockSide) * BlockSide * std::max(this->Settings.Samples, 1);
  const std::int64_t batch = std::max(SmallestBatch, BatchSamples / samplesOfBlock);
  for (std::int64_t first = 0; first < blocks; first += batch)
  {
    if (!goOn(static_cast<double>(first) / static_cast<double>(blocks)))
    {
      return false;
    }
    vtkSMPTools::For(first, std::min(first + batch, blocks),
      [this](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType index = begin; index < end; ++index)
        {
          this->RenderBlock(this->MakeBlock(index));
        }
      });
  }
  return goOn(1.0);
}

TexelRenderer::Block TexelRenderer::MakeBlock(std::int64_t index) const
{
  const int columns = (this->Layout.TileWidth + BlockSide - 1) / BlockSide;
  const int rows = (this->Layout.TileHeight + BlockSide - 1) / BlockSide;
  Block block;
  block.X = static_cast<int>(index % columns) * BlockSide;
  index /= columns;
  block.Y = static_cast<int>(index % rows) * BlockSide;
  index /= rows;
  block.Tile = static_cast<int>(index % this->Layout.Tiles);
  block.Slice = this->Layout.FirstSlice + static_cast<int>(index / this->Layout.Tiles);
  block.Grid = this->Grids(block.Slice, block.Tile);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const int x = block.LaneX(lane);
    const int y = block.LaneY(lane);
    block.Inside[lane] = x < this->Layout.TileWidth && y < this->Layout.TileHeight;
    block.Hashes[lane] = SampleStream::HashTexel(
      this->Settings.Seed, block.Slice, block.Tile * this->Layout.TileWidth + x, y);
  }
  return block;
}

void TexelRenderer::RenderBlock(const Block& block) const
{
  Sums sums[RayPacket::Size];
  for (int index = 0; index < this->Settings.Samples; ++index)
  {
    this->AddSamples(block, static_cast<std::uint32_t>(index), sums);
  }
  if (this->Output.Depth)
  {
    this->FindDepths(block, sums);
  }
  this->Write(block, sums);
}

void TexelRenderer::AddSamples(const Block& block, std::uint32_t index, Sums sums[]) const
{
  // Take one ray of each texel.
  RayPacket packet;
  PacketRay rays[RayPacket::Size];
  double offsets[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const glm::dvec2 place = SampleStream(block.Hashes[lane], index).Get2D(Dimension::Pixel);
    offsets[lane] = glm::length(place - 0.5);
    rays[lane] =
      SetRay(block.Grid, glm::dvec2(block.LaneX(lane), block.LaneY(lane)) + place, packet, lane);
    packet.Active[lane] = packet.Active[lane] && block.Inside[lane];
  }
  this->World.Intersect(packet);

  // Follow each.
  std::uint64_t count = 0;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const Ray& ray = packet.Rays[lane];
    const Hit& hit = packet.Hits[lane];
    Sums& sum = sums[lane];
    count += packet.Active[lane] ? 1 : 0;
    if (hit.IsValid())
    {
      sum.Radiance +=
        this->Integrator.GetRadiance(ray, hit, SampleStream(block.Hashes[lane], index), count);
      ++sum.Covered;
      sum.AddDepth(rays[lane].ToParameter(hit.Distance), offsets[lane]);
    }
    else if (this->Settings.ShowEnvironment)
    {
      sum.Radiance += this->World.GetEnvironment().GetRadiance(ray.Direction);
      ++sum.Covered;
    }
  }
  this->Rays.fetch_add(count, std::memory_order_relaxed);
}

void TexelRenderer::FindDepths(const Block& block, Sums sums[]) const
{
  RayPacket packet;
  PacketRay rays[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const glm::dvec2 center = glm::dvec2(block.LaneX(lane), block.LaneY(lane)) + 0.5;
    rays[lane] = SetRay(block.Grid, center, packet, lane);
    packet.Active[lane] = packet.Active[lane] && block.Inside[lane];
  }
  packet.PassByHalf = true;
  this->World.Intersect(packet);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const Hit& hit = packet.Hits[lane];
    if (hit.IsValid())
    {
      sums[lane].Depth = rays[lane].ToParameter(hit.Distance);
    }
    else if (this->Settings.ShowEnvironment)
    {
      sums[lane].Depth = 1.0;
    }
  }
}

void TexelRenderer::Write(const Block& block, const Sums sums[]) const
{
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (!block.Inside[lane])
    {
      continue;
    }
    const Sums& sum = sums[lane];
    const std::int64_t row =
      std::int64_t(block.Slice - this->Layout.FirstSlice) * this->Layout.TileHeight +
      block.LaneY(lane);
    const std::int64_t texel =
      row * this->Layout.GetWidth() + block.Tile * this->Layout.TileWidth + block.LaneX(lane);
    const glm::dvec3 radiance = sum.Radiance * (this->Settings.Exposure / this->Settings.Samples);
    const double alpha = static_cast<double>(sum.Covered) / this->Settings.Samples;
    if (this->Output.ColorBytes)
    {
      EncodeColor(radiance, alpha, this->Output.ColorBytes + 4 * texel);
    }
    if (this->Output.ColorFloats)
    {
      float* color = this->Output.ColorFloats + 4 * texel;
      color[0] = static_cast<float>(radiance.x);
      color[1] = static_cast<float>(radiance.y);
      color[2] = static_cast<float>(radiance.z);
      color[3] = static_cast<float>(alpha);
    }
    if (this->Output.Depth)
    {
      const double depth = sum.Covered > 0 ? std::clamp(sum.Depth, 0.0, 1.0) : 1.0;
      this->Output.Depth[texel] = static_cast<unsigned short>(std::lround(65535.0 * depth));
    }
  }
}
}
