// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelRenderer.h"

#include "cslfColor.h"
#include "cslfVectorize.h"

#include <vtkSMPTools.h>
#include <vtkType.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// The samples of a batch: enough to keep many threads busy, about a second's worth on few.
constexpr std::int64_t BatchSamples = 1 << 20;
constexpr std::int64_t SmallestBatch = 16;

// The fewest samples whose differences are taken for their noise.
constexpr int FewestSamples = 4;

// Across the 4 texels of a block's side a colour may change by this many noise targets, for one
// sample to do: between its texel's centre and itself there is a quarter of a texel on average.
constexpr double RangeOfTarget = 8.0;

/// Where samples lie, one in each of 16 texels.
struct Places
{
  alignas(64) float X[RayPacket::Size]; // in the texel, in [0,1]
  alignas(64) float Y[RayPacket::Size];
  alignas(64) float TileX[RayPacket::Size]; // in the tile
  alignas(64) float TileY[RayPacket::Size];
};

CSLF_VECTORIZE void FindPlaces(std::uint32_t sample, const std::uint32_t* low,
  const std::uint32_t* high, const float* laneX, const float* laneY, Places& places)
{
  CSLF_LANES
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    SampleStream::Get2D(sample, { low[lane], high[lane] }, places.X[lane], places.Y[lane]);
    places.TileX[lane] = laneX[lane] + places.X[lane];
    places.TileY[lane] = laneY[lane] + places.Y[lane];
  }
}

/// Leaves out the rays of texels that are not inside. Returns the number of those left.
int KeepInside(const int* inside, RayPacket& packet)
{
  int rays = 0;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    packet.Active[lane] &= inside[lane];
    rays -= packet.Active[lane];
  }
  return rays;
}
}

/// A square of texels in one tile; its lanes run along x first.
struct TexelRenderer::Block
{
  RayGrid Grid;
  int Slice;
  int Tile;
  int Y; // of the first texel, in the tile
  int X;
  alignas(64) int Inside[RayPacket::Size];  // -1 where the tile has the lane's texel, else 0
  alignas(64) float LaneX[RayPacket::Size]; // of the texels, in the tile
  alignas(64) float LaneY[RayPacket::Size];
  std::uint64_t Hashes[RayPacket::Size];          // of the texels, for their random numbers
  alignas(64) std::uint32_t Low[RayPacket::Size]; // the scramble of their samples' places
  alignas(64) std::uint32_t High[RayPacket::Size];
  TexelSums Sums;
  std::uint64_t Rays = 0;
  bool IsExact = false; // whether all samples are without noise
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
  , Known(scene, settings.Cache)
{
}

std::int64_t TexelRenderer::GetRowsOfTile() const
{
  return (this->Layout.TileHeight + BlockSide - 1) / BlockSide;
}

bool TexelRenderer::Render(const std::function<bool(double)>& goOn) const
{
  const std::int64_t rows = this->GetRowsOfTile() * this->Layout.Tiles * this->Layout.Slices;
  const std::int64_t samplesOfRow =
    std::int64_t(BlockSide) * this->Layout.TileWidth * std::max(this->Settings.Samples, 1);
  const std::int64_t batch = std::max(SmallestBatch, BatchSamples / samplesOfRow);
  for (std::int64_t first = 0; first < rows; first += batch)
  {
    if (!goOn(static_cast<double>(first) / static_cast<double>(rows)))
    {
      return false;
    }
    vtkSMPTools::For(first, std::min(first + batch, rows),
      [this](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType index = begin; index < end; ++index)
        {
          this->RenderRow(index);
        }
      });
  }
  return goOn(1.0);
}

void TexelRenderer::RenderRow(std::int64_t index) const
{
  const std::int64_t rows = this->GetRowsOfTile();
  Block block;
  block.Y = static_cast<int>(index % rows) * BlockSide;
  index /= rows;
  block.Tile = static_cast<int>(index % this->Layout.Tiles);
  block.Slice = this->Layout.FirstSlice + static_cast<int>(index / this->Layout.Tiles);
  block.Grid = this->Grids(block.Slice, block.Tile);
  for (int column = 0; column < this->Layout.TileWidth; column += BlockSide)
  {
    this->SetTexels(block, column);
    this->RenderBlock(block);
  }
  this->Rays.fetch_add(block.Rays, std::memory_order_relaxed);
}

void TexelRenderer::SetTexels(Block& block, int column) const
{
  block.X = column;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const int x = block.X + lane % BlockSide;
    const int y = block.Y + lane / BlockSide;
    block.LaneX[lane] = static_cast<float>(x);
    block.LaneY[lane] = static_cast<float>(y);
    block.Inside[lane] = x < this->Layout.TileWidth && y < this->Layout.TileHeight ? -1 : 0;
    block.Hashes[lane] = SampleStream::HashTexel(
      this->Settings.Seed, block.Slice, block.Tile * this->Layout.TileWidth + x, y);
    const auto scramble = SampleStream::MakeScramble(block.Hashes[lane], Dimension::Pixel);
    block.Low[lane] = scramble.Low;
    block.High[lane] = scramble.High;
  }
}

void TexelRenderer::RenderBlock(Block& block) const
{
  block.Sums = TexelSums();
  block.IsExact = true;
  while (block.Sums.Samples < this->Settings.Samples)
  {
    this->AddSamples(block);
    if (this->Settings.NoiseTarget > 0.0 && this->IsGoodEnough(block))
    {
      break;
    }
  }
  if (this->Output.Depth)
  {
    this->FindDepths(block);
  }
  this->Write(block);
}

bool TexelRenderer::IsGoodEnough(const Block& block) const
{
  // Sequences are best at powers of two. A few samples tell of noise only where there is none:
  // then where in its texel a sample lies matters as much as texels differ from their neighbours.
  const int count = block.Sums.Samples;
  if ((count & (count - 1)) != 0)
  {
    return false;
  }
  const auto exposure = static_cast<float>(this->Settings.Exposure);
  if (count < FewestSamples)
  {
    return block.IsExact &&
      block.Sums.GetRange(exposure, block.Inside) < RangeOfTarget * this->Settings.NoiseTarget;
  }
  return block.Sums.GetNoise(exposure) <= this->Settings.NoiseTarget;
}

void TexelRenderer::AddSamples(Block& block) const
{
  // Take one ray of each texel.
  Places places;
  FindPlaces(static_cast<std::uint32_t>(block.Sums.Samples), block.Low, block.High, block.LaneX,
    block.LaneY, places);
  RayPacket packet;
  PacketScale scale;
  SetRays(block.Grid, places.TileX, places.TileY, packet, scale);
  block.Rays += KeepInside(block.Inside, packet);
  this->World.Intersect(packet);

  // Find what they see.
  PacketRadiance radiance;
  alignas(64) int covered[RayPacket::Size];
  if (!this->Known.Get(packet, radiance, covered))
  {
    this->Follow(packet, block, radiance, covered);
  }
  if (this->Settings.ShowEnvironment)
  {
    this->AddEnvironment(packet, block, radiance, covered);
  }
  block.Sums.Add(radiance, covered);
  if (this->Settings.NoiseTarget > 0.0)
  {
    block.Sums.AddSquares(radiance);
  }
  if (this->Output.Depth)
  {
    block.Sums.AddDepths(packet, scale, places.X, places.Y);
  }
}

void TexelRenderer::Follow(
  const RayPacket& packet, Block& block, PacketRadiance& radiance, int covered[]) const
{
  const auto index = static_cast<std::uint32_t>(block.Sums.Samples);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (packet.IsHit(lane) && !covered[lane])
    {
      const Ray ray = packet.GetRay(lane);
      const Hit hit = packet.GetHit(lane);
      glm::vec3 seen;
      if (!this->Integrator.LookUp(ray, hit, seen))
      {
        block.IsExact = false;
        seen = this->Integrator.GetRadiance(
          ray, hit, SampleStream(block.Hashes[lane], index), block.Rays);
      }
      radiance.Set(lane, seen);
      covered[lane] = -1;
    }
  }
}

void TexelRenderer::AddEnvironment(
  const RayPacket& packet, const Block& block, PacketRadiance& radiance, int covered[]) const
{
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (block.Inside[lane] && !covered[lane])
    {
      radiance.Set(lane, this->World.GetEnvironment().GetRadiance(packet.GetRay(lane).Direction));
      covered[lane] = -1;
    }
  }
}

void TexelRenderer::FindDepths(Block& block) const
{
  // A ray to the centre beats all samples.
  Places places;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    places.X[lane] = 0.5f;
    places.Y[lane] = 0.5f;
    places.TileX[lane] = block.LaneX[lane] + 0.5f;
    places.TileY[lane] = block.LaneY[lane] + 0.5f;
  }
  RayPacket packet;
  packet.PassByHalf = true;
  PacketScale scale;
  SetRays(block.Grid, places.TileX, places.TileY, packet, scale);
  KeepInside(block.Inside, packet);
  this->World.Intersect(packet);
  std::fill_n(block.Sums.DepthOffset, RayPacket::Size, std::numeric_limits<float>::max());
  block.Sums.AddDepths(packet, scale, places.X, places.Y);
  if (this->Settings.ShowEnvironment)
  {
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      block.Sums.Depth[lane] = packet.IsHit(lane) ? block.Sums.Depth[lane] : 1.0f;
    }
  }
}

void TexelRenderer::Write(const Block& block) const
{
  const TexelSums& sums = block.Sums;
  const double scale = this->Settings.Exposure / sums.Samples;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (!block.Inside[lane])
    {
      continue;
    }
    const std::int64_t row =
      std::int64_t(block.Slice - this->Layout.FirstSlice) * this->Layout.TileHeight + block.Y +
      lane / BlockSide;
    const std::int64_t texel = row * this->Layout.GetWidth() + block.Tile * this->Layout.TileWidth +
      block.X + lane % BlockSide;
    const glm::dvec3 radiance =
      scale * glm::dvec3(sums.Red[lane], sums.Green[lane], sums.Blue[lane]);
    const double alpha = static_cast<double>(sums.Covered[lane]) / sums.Samples;
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
      const float depth = sums.Covered[lane] > 0 ? std::clamp(sums.Depth[lane], 0.0f, 1.0f) : 1.0f;
      this->Output.Depth[texel] = static_cast<unsigned short>(65535.0f * depth + 0.5f);
    }
  }
}
}
