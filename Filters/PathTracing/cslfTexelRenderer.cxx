// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelRenderer.h"

#include "cslfColor.h"

#include <vtkSMPThreadLocal.h>
#include <vtkSMPTools.h>
#include <vtkType.h>

#include <glm/vec3.hpp>

#include <algorithm>
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

/// Leaves out the rays of a group's texels that are not inside. Returns the number of those left.
int KeepInside(const TexelGroup& group, const int* inside, RayPacket& packet)
{
  int rays = 0;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    packet.Active[lane] &= inside[group.GetTexel(lane)];
    rays -= packet.Active[lane];
  }
  return rays;
}
}

/// A square of texels in one tile, a square of 2 x 2 after the other.
struct TexelRenderer::Block
{
  RayGrid Grid;
  int Slice;
  int Tile;
  int Y; // of the first texel, in the tile
  int X;
  std::uint64_t Hash;                      // of the slice
  alignas(64) int Inside[RayPacket::Size]; // -1 where the tile has the texel, else 0
  std::uint64_t Hashes[RayPacket::Size];   // of the texels, for their random numbers
  TexelPlaces Texels;
  TexelSums Sums;
  bool IsExact = true;      // whether all samples are without noise
  bool LacksDepths = false; // whether a depth is to be found by the samples
};

/// Paths that wait to be followed together, those of a run of blocks: which they are depends on the
/// run alone.
struct TexelRenderer::PathQueue
{
  /// Where a path started.
  struct Source
  {
    TexelSums* Sums;
    int Texel;
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
  const std::int64_t runs = std::int64_t(this->GetRunsOfRow()) * this->GetRowsOfTile() *
    this->Layout.Tiles * this->Layout.Slices;
  const std::int64_t samplesOfRun =
    std::int64_t(RayPacket::Size) * this->GetBlocksOfRun() * std::max(this->Settings.Samples, 1);
  const std::int64_t batch = std::max(SmallestBatch, BatchSamples / samplesOfRun);
  vtkSMPThreadLocal<PathQueue> queues;
  for (std::int64_t first = 0; first < runs; first += batch)
  {
    if (!goOn(static_cast<double>(first) / static_cast<double>(runs)))
    {
      return false;
    }
    vtkSMPTools::For(first, std::min(first + batch, runs),
      [this, &queues](vtkIdType begin, vtkIdType end)
      {
        PathQueue& queue = queues.Local();
        for (vtkIdType index = begin; index < end; ++index)
        {
          this->RenderRun(index, queue);
        }
      });
  }
  return goOn(1.0);
}

void TexelRenderer::RenderRun(std::int64_t index, PathQueue& queue) const
{
  const std::int64_t runs = this->GetRunsOfRow();
  const std::int64_t rows = this->GetRowsOfTile();
  const int begin = static_cast<int>(index % runs) * this->GetBlocksOfRun();
  index /= runs;
  Block first;
  first.Y = static_cast<int>(index % rows) * BlockSide;
  index /= rows;
  first.Tile = static_cast<int>(index % this->Layout.Tiles);
  first.Slice = this->Layout.FirstSlice + static_cast<int>(index / this->Layout.Tiles);
  first.Hash = SampleStream::HashSlice(this->Settings.Seed, first.Slice);
  first.Grid = this->Grids(first.Slice, first.Tile);
  const int count = std::min(this->GetBlocksOfRun(), this->GetBlocksOfRow() - begin);
  std::vector<Block> blocks(count, first);
  for (int i = 0; i < count; ++i)
  {
    this->SetTexels(blocks[i], (begin + i) * BlockSide);
  }
  queue.Rays = 0;
  this->RenderBlocks(blocks.data(), count, queue);
  this->Rays.fetch_add(queue.Rays, std::memory_order_relaxed);
}

int TexelRenderer::GetBlocksOfRow() const
{
  return (this->Layout.TileWidth + BlockSide - 1) / BlockSide;
}

int TexelRenderer::GetBlocksOfRun() const
{
  // As many as fill a batch of paths before it must be followed.
  const int samples =
    this->Settings.NoiseTarget > 0.0 ? FewestSamples : std::max(this->Settings.Samples, 1);
  const int filling = PathBatch::Capacity / (RayPacket::Size * samples);
  return std::clamp(filling, 1, std::min(this->GetBlocksOfRow(), MostBlocks));
}

int TexelRenderer::GetRunsOfRow() const
{
  return (this->GetBlocksOfRow() + this->GetBlocksOfRun() - 1) / this->GetBlocksOfRun();
}

void TexelRenderer::SetTexels(Block& block, int column) const
{
  block.X = column;
  std::uint64_t columns[BlockSide];
  for (int i = 0; i < BlockSide; ++i)
  {
    columns[i] =
      SampleStream::HashColumn(block.Hash, block.Tile * this->Layout.TileWidth + block.X + i);
  }
  for (int texel = 0; texel < RayPacket::Size; ++texel)
  {
    const int x = block.X + TexelPlaces::GetColumn(texel);
    const int y = block.Y + TexelPlaces::GetRow(texel);
    block.Inside[texel] = x < this->Layout.TileWidth && y < this->Layout.TileHeight ? -1 : 0;
    block.Hashes[texel] = SampleStream::HashRow(columns[TexelPlaces::GetColumn(texel)], y);
    const auto scramble = SampleStream::MakeScramble(block.Hashes[texel], Dimension::Pixel);
    block.Texels.X[texel] = static_cast<float>(x);
    block.Texels.Y[texel] = static_cast<float>(y);
    block.Texels.Low[texel] = scramble.Low;
    block.Texels.High[texel] = scramble.High;
  }
}

int TexelRenderer::GetSamplesAtOnce(int samples) const
{
  // With a target, it is asked at powers of two whether to go on.
  int left = this->Settings.Samples - samples;
  if (this->Settings.NoiseTarget > 0.0)
  {
    int next = 1;
    while (next <= samples)
    {
      next *= 2;
    }
    left = std::min(left, next - samples);
  }
  return left >= 16 ? 16 : left >= 4 ? 4 : 1;
}

void TexelRenderer::RenderBlocks(Block* blocks, int count, PathQueue& queue) const
{
  std::vector<Block*> unfinished;
  for (int i = 0; i < count; ++i)
  {
    unfinished.push_back(blocks + i);
    if (this->Output.Depth)
    {
      this->FindDepths(blocks[i]);
    }
  }
  for (int samples = 0; samples < this->Settings.Samples && !unfinished.empty();)
  {
    const int added = this->GetSamplesAtOnce(samples);
    samples += added;
    for (Block* block : unfinished)
    {
      this->AddSamples(*block, added, queue);
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
    x[lane] = static_cast<float>(block.X) + step * static_cast<float>(TexelPlaces::GetColumn(lane));
    y[lane] = static_cast<float>(block.Y) + step * static_cast<float>(TexelPlaces::GetRow(lane));
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

void TexelRenderer::AddSamples(Block& block, int count, PathQueue& queue) const
{
  TexelGroup group(RayPacket::Size / count);
  SamplePlaces places[RayPacket::Size];
  FindPlaces(group, count, block.Sums.Samples, block.Texels, places);
  for (int packet = 0; packet < count; ++packet, group.First += group.Size)
  {
    if (queue.Batch.GetSize() + RayPacket::Size > PathBatch::Capacity)
    {
      this->FollowPaths(queue);
    }
    this->AddPacket(block, group, places[packet], queue);
  }
  block.Sums.Samples += count;
}

void TexelRenderer::AddPacket(
  Block& block, const TexelGroup& group, const SamplePlaces& places, PathQueue& queue) const
{
  RayPacket packet;
  PacketScale scale;
  SetRays(block.Grid, places.TileX, places.TileY, packet, scale);
  queue.Rays += KeepInside(group, block.Inside, packet);
  this->World.Intersect(packet);

  // Find what they see.
  PacketRadiance radiance;
  alignas(64) int covered[RayPacket::Size];
  if (!this->Known.Get(packet, radiance, covered))
  {
    this->Follow(packet, block, group, queue, radiance, covered);
  }
  if (this->Settings.ShowEnvironment)
  {
    this->AddEnvironment(packet, block, group, radiance, covered);
  }
  block.Sums.Add(group, radiance, covered);
  if (this->Settings.NoiseTarget > 0.0)
  {
    block.Sums.AddSquares(group, radiance);
  }
  if (block.LacksDepths)
  {
    block.Sums.AddDepths(group, packet, scale, places.X, places.Y);
  }
}

void TexelRenderer::Follow(const RayPacket& packet, Block& block, const TexelGroup& group,
  PathQueue& queue, PacketRadiance& radiance, int covered[]) const
{
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (!packet.IsHit(lane) || covered[lane])
    {
      continue;
    }
    const Ray ray = packet.GetRay(lane);
    const Hit hit = packet.GetHit(lane);
    glm::vec3 known;
    if (this->Settings.Cache && this->Integrator.LookUp(ray, hit, known))
    {
      radiance.Set(lane, known);
      covered[lane] = -1;
    }
    else
    {
      const int texel = group.GetTexel(lane);
      const auto sample = static_cast<std::uint32_t>(block.Sums.Samples + group.GetSample(lane));
      queue.Batch.Add({ ray, block.Hashes[texel], sample }, hit);
      queue.Sources.push_back({ &block.Sums, texel });
      block.IsExact = false;
    }
  }
}

void TexelRenderer::FollowPaths(PathQueue& queue) const
{
  if (queue.Batch.GetSize() == 0)
  {
    return;
  }
  this->Integrator.Follow(queue.Batch, queue.Rays);
  for (int path = 0; path < queue.Batch.GetSize(); ++path)
  {
    const PathQueue::Source& source = queue.Sources[path];
    source.Sums->AddPath(source.Texel, queue.Batch.GetRadiance(path));
  }
  queue.Batch.Clear();
  queue.Sources.clear();
}

void TexelRenderer::AddEnvironment(const RayPacket& packet, const Block& block,
  const TexelGroup& group, PacketRadiance& radiance, int covered[]) const
{
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (block.Inside[group.GetTexel(lane)] && !packet.IsHit(lane))
    {
      radiance.Set(lane, this->World.GetEnvironment().GetRadiance(packet.GetRay(lane).Direction));
      covered[lane] = -1;
    }
  }
}

void TexelRenderer::FindDepths(Block& block) const
{
  // Where the ray to the centre sees nothing, the samples may.
  SamplePlaces places;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    places.X[lane] = 0.5f;
    places.Y[lane] = 0.5f;
    places.TileX[lane] = block.Texels.X[lane] + 0.5f;
    places.TileY[lane] = block.Texels.Y[lane] + 0.5f;
  }
  RayPacket packet;
  packet.PassByHalf = true;
  PacketScale scale;
  SetRays(block.Grid, places.TileX, places.TileY, packet, scale);
  const TexelGroup all(RayPacket::Size);
  KeepInside(all, block.Inside, packet);
  this->World.Intersect(packet);
  block.Sums.AddDepths(all, packet, scale, places.X, places.Y);
  for (int lane = 0; lane < RayPacket::Size && !this->Settings.ShowEnvironment; ++lane)
  {
    block.LacksDepths |= block.Inside[lane] && !packet.IsHit(lane);
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
      TexelPlaces::GetRow(lane);
    const std::int64_t texel = row * this->Layout.GetWidth() + block.Tile * this->Layout.TileWidth +
      block.X + TexelPlaces::GetColumn(lane);
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
