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

// The most blocks whose paths are followed together.
constexpr int MostBlocks = 64;

// Across the 4 texels of a block's side a colour may change by this many noise targets, for one
// sample to do: between its texel's centre and itself there is a quarter of a texel on average.
constexpr double RangeOfTarget = 8.0;

/// Sequences are best at powers of two.
bool IsPowerOfTwo(int count)
{
  return (count & (count - 1)) == 0;
}

// The samples whose places are found at once; a power of two.
constexpr int SamplesAhead = 4;

/// Where samples lie, one in each of 16 texels.
struct Places
{
  alignas(64) float X[RayPacket::Size]; // in the texel, in [0,1]
  alignas(64) float Y[RayPacket::Size];
  alignas(64) float TileX[RayPacket::Size]; // in the tile
  alignas(64) float TileY[RayPacket::Size];
};

/// Finds those of some samples in a row: together, as each takes long but not much.
CSLF_VECTORIZE void FindPlaces(int first, int count, const std::uint32_t* low,
  const std::uint32_t* high, const float* laneX, const float* laneY, Places* places)
{
  for (int i = 0; i < count; ++i)
  {
    Places& sample = places[i];
    CSLF_LANE_LOOP
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      SampleStream::Get2D(static_cast<std::uint32_t>(first + i), { low[lane], high[lane] },
        sample.X[lane], sample.Y[lane]);
      sample.TileX[lane] = laneX[lane] + sample.X[lane];
      sample.TileY[lane] = laneY[lane] + sample.Y[lane];
    }
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
  Places Ahead[SamplesAhead]; // of samples that are next, by their number
  bool IsExact = true;        // whether all samples are without noise
};

/// Paths that wait to be followed together, those of some blocks of a row: which they are depends
/// on the row alone.
struct TexelRenderer::PathQueue
{
  /// Where a path started.
  struct Source
  {
    TexelSums* Sums;
    int Lane;
  };

  PathBatch Batch;
  std::vector<Source> Sources; // of the batch's paths
  std::uint64_t Rays = 0;      // of all paths so far
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
  Block first;
  first.Y = static_cast<int>(index % rows) * BlockSide;
  index /= rows;
  first.Tile = static_cast<int>(index % this->Layout.Tiles);
  first.Slice = this->Layout.FirstSlice + static_cast<int>(index / this->Layout.Tiles);
  first.Grid = this->Grids(first.Slice, first.Tile);
  std::vector<Block> blocks(this->GetBlocksAtOnce());
  PathQueue queue;
  int count = 0;
  for (int column = 0; column < this->Layout.TileWidth; column += BlockSide)
  {
    blocks[count] = first;
    this->SetTexels(blocks[count], column);
    if (++count == static_cast<int>(blocks.size()))
    {
      this->RenderBlocks(blocks.data(), count, queue);
      count = 0;
    }
  }
  this->RenderBlocks(blocks.data(), count, queue);
  this->Rays.fetch_add(queue.Rays, std::memory_order_relaxed);
}

std::size_t TexelRenderer::GetBlocksAtOnce() const
{
  // As many as fill a batch of paths before it must be followed.
  const int samples =
    this->Settings.NoiseTarget > 0.0 ? FewestSamples : std::max(this->Settings.Samples, 1);
  const int filling = PathBatch::Capacity / (RayPacket::Size * samples);
  const int all = (this->Layout.TileWidth + BlockSide - 1) / BlockSide;
  return static_cast<std::size_t>(std::clamp(filling, 1, std::min(all, MostBlocks)));
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

void TexelRenderer::RenderBlocks(Block* blocks, int count, PathQueue& queue) const
{
  std::vector<Block*> unfinished;
  for (int i = 0; i < count; ++i)
  {
    unfinished.push_back(blocks + i);
  }
  for (int samples = 1; samples <= this->Settings.Samples && !unfinished.empty(); ++samples)
  {
    for (Block* block : unfinished)
    {
      this->AddSamples(*block, queue);
      if (queue.Batch.GetSize() + RayPacket::Size > PathBatch::Capacity)
      {
        this->FollowPaths(queue);
      }
    }
    if (this->Settings.NoiseTarget > 0.0 && IsPowerOfTwo(samples))
    {
      this->FollowPaths(queue);
      const auto isGood = [this, &queue](const Block* block)
      { return this->IsGoodEnough(*block, queue.Rays); };
      unfinished.erase(
        std::remove_if(unfinished.begin(), unfinished.end(), isGood), unfinished.end());
    }
  }
  this->FollowPaths(queue);
  for (int i = 0; i < count; ++i)
  {
    if (this->Output.Depth)
    {
      this->FindDepths(blocks[i]);
    }
    this->Write(blocks[i]);
  }
}

bool TexelRenderer::IsGoodEnough(const Block& block, std::uint64_t& rays) const
{
  // A few samples tell of noise only where there is none: then where in its texel a sample lies
  // matters as much as texels differ from their neighbours.
  const auto exposure = static_cast<float>(this->Settings.Exposure);
  if (block.Sums.Samples < FewestSamples)
  {
    return block.IsExact &&
      block.Sums.GetRange(exposure, block.Inside) < RangeOfTarget * this->Settings.NoiseTarget &&
      this->IsInOnePiece(block, rays);
  }
  return block.Sums.GetNoise(exposure) <= this->Settings.NoiseTarget;
}

bool TexelRenderer::IsInOnePiece(const Block& block, std::uint64_t& rays) const
{
  // An outline that runs along the block's border is missed by samples within the texels.
  constexpr float step = static_cast<float>(BlockSide) / (BlockSide - 1);
  float x[RayPacket::Size];
  float y[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    x[lane] = static_cast<float>(block.X) + step * static_cast<float>(lane % BlockSide);
    y[lane] = static_cast<float>(block.Y) + step * static_cast<float>(lane / BlockSide);
  }
  RayPacket packet;
  PacketScale scale;
  SetRays(block.Grid, x, y, packet, scale);
  rays += RayPacket::Size;
  this->World.Intersect(packet);
  const bool covered = this->Settings.ShowEnvironment ? packet.IsHit(0) : block.Sums.Covered[0] > 0;
  int same = 0;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    same += packet.IsHit(lane) == covered ? 1 : 0;
  }
  return same == RayPacket::Size;
}

void TexelRenderer::AddSamples(Block& block, PathQueue& queue) const
{
  // Take one ray of each texel. With a noise target, the first may be the last.
  const int sample = block.Sums.Samples;
  const bool stopsEarly = this->Settings.NoiseTarget > 0.0;
  if (sample % SamplesAhead == 0 || (sample == 1 && stopsEarly))
  {
    const bool isAlone = sample == 0 && stopsEarly;
    const int left =
      std::min(this->Settings.Samples - sample, SamplesAhead - sample % SamplesAhead);
    FindPlaces(sample, isAlone ? 1 : left, block.Low, block.High, block.LaneX, block.LaneY,
      block.Ahead + sample % SamplesAhead);
  }
  const Places& places = block.Ahead[sample % SamplesAhead];
  RayPacket packet;
  PacketScale scale;
  SetRays(block.Grid, places.TileX, places.TileY, packet, scale);
  queue.Rays += KeepInside(block.Inside, packet);
  this->World.Intersect(packet);

  // Find what they see.
  PacketRadiance radiance;
  alignas(64) int covered[RayPacket::Size];
  if (!this->Known.Get(packet, radiance, covered))
  {
    this->Follow(packet, block, queue, radiance, covered);
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

void TexelRenderer::Follow(const RayPacket& packet, Block& block, PathQueue& queue,
  PacketRadiance& radiance, int covered[]) const
{
  const auto index = static_cast<std::uint32_t>(block.Sums.Samples);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (!packet.IsHit(lane) || covered[lane])
    {
      continue;
    }
    const Ray ray = packet.GetRay(lane);
    const Hit hit = packet.GetHit(lane);
    glm::vec3 known;
    if (this->Integrator.LookUp(ray, hit, known))
    {
      radiance.Set(lane, known);
      covered[lane] = -1;
    }
    else
    {
      queue.Batch.Add({ ray, block.Hashes[lane], index }, hit);
      queue.Sources.push_back({ &block.Sums, lane });
      block.IsExact = false;
    }
  }
}

void TexelRenderer::FollowPaths(PathQueue& queue) const
{
  this->Integrator.Follow(queue.Batch, queue.Rays);
  for (int path = 0; path < queue.Batch.GetSize(); ++path)
  {
    const PathQueue::Source& source = queue.Sources[path];
    source.Sums->AddPath(source.Lane, queue.Batch.GetRadiance(path));
  }
  queue.Batch.Clear();
  queue.Sources.clear();
}

void TexelRenderer::AddEnvironment(
  const RayPacket& packet, const Block& block, PacketRadiance& radiance, int covered[]) const
{
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (block.Inside[lane] && !packet.IsHit(lane))
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
