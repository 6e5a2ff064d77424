// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelRenderer.h"

#include "PathTracing/RadianceCache/cslfRadianceCache.h"
#include "PathTracing/Volumes/cslfVolumeSet.h"

#include "Pipeline/cslfParallelFor.h"
#include "cslfCenterSurfaces.h"

#include <vtkSMPThreadLocal.h>
#include <vtkType.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <utility>

namespace cslf
{
namespace
{
// The number of samples of a batch: enough for many threads, and about a second's work on a few.
constexpr std::int64_t BatchSamples = 1 << 20;
constexpr std::int64_t MinimumBatch = 16;

// The most blocks whose paths are followed together.
constexpr int MaximumBlocks = 64;

// The least opacity of surfaces whose depth is stored. Other views look through those with less, so
// where there are only such surfaces, it is the depth of the last.
constexpr float DepthOpacity = 0.5f;

/// Whether rays of two packets, all of which hit the scene's box, see the same mesh or all miss.
bool ShowOneMesh(const RayPacket& a, const RayPacket& b)
{
  std::uint32_t differences = 0;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    differences |= a.Query.hit.geomID[lane] ^ a.Query.hit.geomID[0];
    differences |= b.Query.hit.geomID[lane] ^ a.Query.hit.geomID[0];
  }
  return differences == 0;
}

/// Removes the rays that are not inside. Returns the number of the others.
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

/// Keeps the hits nearest to the centres of texels, or the middles of what is seen of volumes.
/// Returns the lanes that see anything.
std::uint32_t KeepNearest(const PacketHits& hits, TexelSums& sums)
{
  const auto keep = [&sums](const PacketHits& seen)
  {
    sums.KeepNearest(seen);
    std::uint32_t found = 0;
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      found |= seen.Rays.IsHit(lane) ? 1u << lane : 0u;
    }
    return found;
  };
  if (!hits.Rays.MeetsVolumes)
  {
    return keep(hits);
  }
  RayPacket middles = hits.Rays;
  hits.World.GetVolumes()->FindMiddles(middles);
  return keep({ hits.World, hits.Group, hits.Places, middles, hits.Scale });
}

/// The settings of paths for texels.
PathSettings MakePathSettings(const RenderSettings& settings)
{
  PathSettings paths = settings.Paths;
  paths.ShowsEnvironment = settings.ShowEnvironment;
  return paths;
}
}

/// A square of texels in one tile, in order of squares of 2 x 2.
struct TexelRenderer::Block
{
  RayGrid Grid;
  int Slice;
  int Tile;
  int Y; // of the first texel, in the tile
  int X;
  std::uint64_t Hash;                      // of the slice
  alignas(64) int Inside[RayPacket::Size]; // -1 if the tile has the texel, else 0
  std::uint64_t Hashes[RayPacket::Size];   // of the texels, for their random numbers
  TexelPlaces Texels;
  TexelSums Sums;
  ColorBounds Expected;      // what rays see that no texel averages
  bool MayEndSoon = false;   // whether a single sample may be enough
  bool LacksNearest = false; // whether samples may be the hits nearest to the centres
  PathVariance Variance;     // of the first samples
  CenterSurfaces Surfaces;   // those whose colours count

  explicit Block(const ViewpointSamples& output)
    : Sums(output)
  {
  }
};

/// Paths of a run of blocks that wait to be followed together. They depend only on the run.
struct TexelRenderer::PathQueue
{
  /// The origin of a path.
  struct Source
  {
    TexelSums* Sums;
    int Texel;
    bool IsOwn; // whether its colour counts
  };

  PathBatch Batch;
  std::vector<Source> Sources; // of the batch's paths
  std::uint64_t Rays = 0;      // of all paths so far
};

TexelRenderer::TexelRenderer(const Scene& scene, const PictureLayout& layout,
  const RenderSettings& settings, std::function<RayGrid(int slice, int tile)> grids,
  const ViewpointSamples& output)
  : World(scene)
  , Layout(layout)
  , Settings(settings)
  , Grids(std::move(grids))
  , Output(output)
  , NeedsNearest(TexelSums(output).NeedsNearest())
  , Integrator(scene, MakePathSettings(settings), settings.Cache)
  , Known(scene, settings.Cache)
  , Bounds(scene.GetBounds())
  , Rule(DisplayCurve(settings.Exposure, settings.DisplayRange), settings.NoiseTarget)
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
  const std::int64_t batch = std::max(MinimumBatch, BatchSamples / samplesOfRun);
  vtkSMPThreadLocal<PathQueue> queues;
  for (std::int64_t first = 0; first < runs; first += batch)
  {
    if (!goOn(static_cast<double>(first) / static_cast<double>(runs)))
    {
      return false;
    }
    ParallelFor(first, std::min(first + batch, runs), 0,
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
  Block first(this->Output);
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
  this->RenderBlocks(blocks, queue);
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
    this->IsAdaptive() ? StoppingRule::MinimumSamples : std::max(this->Settings.Samples, 1);
  const int filling = PathBatch::Capacity / (RayPacket::Size * samples);
  return std::clamp(filling, 1, std::min(this->GetBlocksOfRow(), MaximumBlocks));
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

bool TexelRenderer::IsAdaptive() const
{
  return this->Settings.NoiseTarget > 0.0 && this->Settings.Samples > 1;
}

void TexelRenderer::RenderBlocks(std::vector<Block>& blocks, PathQueue& queue) const
{
  for (Block& block : blocks)
  {
    if (this->MayMeetScene(block))
    {
      this->LookAhead(block, queue.Rays);
    }
    else
    {
      // No sample would see anything.
      block.Sums.Samples = 1;
      block.Sums.TakeAll();
    }
  }
  if (this->IsAdaptive())
  {
    this->TakeSingles(blocks, queue);
    this->TakeEnough(blocks, queue);
  }
  this->AddUpTo(this->Settings.Samples, blocks, queue);
  for (Block& block : blocks)
  {
    block.Sums.TakeAll();
    this->Write(block);
  }
}

void TexelRenderer::TakeSingles(std::vector<Block>& blocks, PathQueue& queue) const
{
  for (Block& block : blocks)
  {
    if (block.MayEndSoon)
    {
      this->AddUpTo(1, block, queue);
    }
  }
  this->FollowPaths(queue);
  for (Block& block : blocks)
  {
    if (block.MayEndSoon)
    {
      this->Rule.TakeSingle(block.Expected, block.Inside, block.Sums);
    }
  }
}

void TexelRenderer::TakeEnough(std::vector<Block>& blocks, PathQueue& queue) const
{
  PathVariance all; // of the first samples, which every block takes here
  for (std::int64_t samples = StoppingRule::MinimumSamples; samples < this->Settings.Samples;
       samples *= 2)
  {
    this->AddUpTo(static_cast<int>(samples), blocks, queue);
    for (Block& block : blocks)
    {
      if (samples == StoppingRule::MinimumSamples && !block.Sums.AreTaken())
      {
        block.Variance = StoppingRule::GetVariance(block.Sums);
        all.Add(block.Variance);
      }
    }
    for (Block& block : blocks)
    {
      if (!block.Sums.AreTaken())
      {
        this->Rule.Take(
          block.Expected, all.GetMeanWithout(block.Variance), block.Inside, block.Sums);
      }
    }
  }
}

void TexelRenderer::AddUpTo(int samples, std::vector<Block>& blocks, PathQueue& queue) const
{
  for (Block& block : blocks)
  {
    if (!block.Sums.AreTaken())
    {
      this->AddUpTo(samples, block, queue);
    }
  }
  this->FollowPaths(queue);
}

void TexelRenderer::AddUpTo(int samples, Block& block, PathQueue& queue) const
{
  while (block.Sums.Samples < samples)
  {
    const int left = samples - block.Sums.Samples;
    this->AddSamples(block, left >= 16 ? 16 : left >= 4 ? 4 : 1, queue);
  }
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
  alignas(64) int inside[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    inside[lane] = block.Inside[group.GetTexel(lane)];
  }
  RayPacket packet;
  PacketScale scale;
  SetRays(block.Grid, places.TileX, places.TileY, packet, scale);
  queue.Rays += KeepInside(inside, packet);
  this->World.Intersect(packet);

  // Find what they see.
  const PacketHits hits{ this->World, group, places, packet, scale };
  alignas(64) int own[RayPacket::Size];
  const bool hasOthers = block.Surfaces.FindSamples(hits, own);
  PacketRadiance radiance;
  alignas(64) int covered[RayPacket::Size];
  if (!this->LookUp(packet, inside, radiance, covered))
  {
    this->Follow(hits, covered, own, block, queue);
  }
  const PacketSamples samples{ hits, radiance, covered, own, hasOthers };
  block.Sums.Add(samples);
  if (this->IsAdaptive())
  {
    block.Sums.AddSquares(samples);
  }
  if (block.LacksNearest)
  {
    KeepNearest(hits, block.Sums);
  }
}

bool TexelRenderer::LookUp(
  const RayPacket& packet, const int inside[], PacketRadiance& radiance, int covered[]) const
{
  if (packet.MeetsVolumes)
  {
    radiance = {};
    std::fill_n(covered, RayPacket::Size, 0);
    return false;
  }
  bool isKnown = this->Known.Get(packet, radiance, covered);
  if (!isKnown)
  {
    isKnown = true;
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      glm::vec3 known;
      if (!packet.IsHit(lane) || covered[lane])
      {
        continue;
      }
      if (this->Settings.Cache &&
        this->Integrator.LookUp(packet.GetRay(lane), packet.GetHit(lane), known))
      {
        radiance.Set(lane, known);
        covered[lane] = -1;
      }
      else
      {
        isKnown = false;
      }
    }
  }
  for (int lane = 0; lane < RayPacket::Size && this->Settings.ShowEnvironment; ++lane)
  {
    if (inside[lane] && !packet.IsHit(lane))
    {
      radiance.Set(lane, this->World.GetEnvironment().GetRadiance(packet.GetRay(lane).Direction));
      covered[lane] = -1;
    }
  }
  return isKnown;
}

/// Whether the light of a ray that sees something is to be found by a path.
bool TexelRenderer::MustFollow(const RayPacket& packet, int lane) const
{
  if (packet.IsHit(lane) || !packet.MeetsVolumes || !packet.Active[lane])
  {
    return packet.IsHit(lane);
  }
  return this->Settings.ShowEnvironment ||
    this->World.GetVolumes()->MayMeet(packet.GetRay(lane), VolumeSet::Everywhere);
}

void TexelRenderer::Follow(const PacketHits& hits, const int covered[], const int own[],
  Block& block, PathQueue& queue) const
{
  const RayPacket& packet = hits.Rays;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (!covered[lane] && this->MustFollow(packet, lane))
    {
      const int texel = hits.Group.GetTexel(lane);
      const auto sample =
        static_cast<std::uint32_t>(block.Sums.Samples + hits.Group.GetSample(lane));
      queue.Batch.Add({ packet.GetRay(lane), block.Hashes[texel], sample }, packet.GetHit(lane));
      queue.Sources.push_back({ &block.Sums, texel, own[lane] != 0 });
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
    source.Sums->AddPath(source.Texel, queue.Batch, path, source.IsOwn);
  }
  queue.Batch.Clear();
  queue.Sources.clear();
}

bool TexelRenderer::MayMeetScene(const Block& block) const
{
  const glm::dvec2 first(block.X, block.Y);
  return this->Settings.ShowEnvironment ||
    MayMeet(block.Grid, first, first + double(BlockSide), this->Bounds);
}

void TexelRenderer::LookAhead(Block& block, std::uint64_t& rays) const
{
  if (!this->NeedsNearest && !this->IsAdaptive() && !this->Settings.SurfaceTexels)
  {
    return;
  }
  SamplePlaces places;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    places.X[lane] = 0.5f;
    places.Y[lane] = 0.5f;
    places.TileX[lane] = block.Texels.X[lane] + 0.5f;
    places.TileY[lane] = block.Texels.Y[lane] + 0.5f;
  }
  RayPacket packet;
  packet.MinimumOpacity = DepthOpacity;
  PacketScale scale;
  SetRays(block.Grid, places.TileX, places.TileY, packet, scale);
  const int centers = KeepInside(block.Inside, packet);
  RayPacket veils;
  this->World.Intersect(packet, veils);
  const TexelGroup all(RayPacket::Size);
  const PacketHits hits{ this->World, all, places, packet, scale };
  if (this->Settings.SurfaceTexels && !packet.MeetsVeils)
  {
    block.Surfaces.Find(hits, block.Grid);
  }
  if (this->NeedsNearest)
  {
    const std::uint32_t seen = KeepNearest(hits, block.Sums);
    if (packet.MeetsVeils)
    {
      block.Sums.KeepNearest({ this->World, all, places, veils, scale });
    }
    // If the ray to the centre sees nothing, the samples may see something.
    for (int lane = 0; lane < RayPacket::Size && !this->Settings.ShowEnvironment; ++lane)
    {
      block.LacksNearest |= block.Inside[lane] && (seen >> lane & 1u) == 0 && !veils.IsHit(lane);
    }
  }
  else
  {
    rays += centers;
  }
  if (this->IsAdaptive())
  {
    block.MayEndSoon = this->IsPlain(packet, block, rays);
  }
}

bool TexelRenderer::IsPlain(const RayPacket& centers, Block& block, std::uint64_t& rays) const
{
  if (!this->AddSeen(centers, block.Inside, block.Expected))
  {
    return false;
  }
  // Rays to the centres miss what lies along the block's border.
  constexpr float around = 0.5f;
  constexpr float step = (BlockSide + 2.0f * around) / (BlockSide - 1);
  alignas(64) int all[RayPacket::Size];
  float x[RayPacket::Size];
  float y[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const auto column = static_cast<float>(TexelPlaces::GetColumn(lane));
    const auto row = static_cast<float>(TexelPlaces::GetRow(lane));
    all[lane] = -1;
    x[lane] = static_cast<float>(block.X) - around + step * column;
    y[lane] = static_cast<float>(block.Y) - around + step * row;
  }
  RayPacket packet;
  PacketScale scale;
  SetRays(block.Grid, x, y, packet, scale);
  rays += RayPacket::Size;
  this->World.Intersect(packet);
  return (!packet.MeetsVeils && ShowOneMesh(centers, packet)) ||
    this->AddSeen(packet, all, block.Expected);
}

bool TexelRenderer::AddSeen(const RayPacket& packet, const int inside[], ColorBounds& seen) const
{
  alignas(64) int covered[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    covered[lane] = packet.IsHit(lane) || this->Settings.ShowEnvironment ? -1 : 0;
  }
  seen.AddCoverage(covered, inside);
  if (seen.AreMixed() || packet.MeetsVeils)
  {
    return false;
  }
  PacketRadiance radiance;
  alignas(64) int known[RayPacket::Size];
  const bool isKnown = this->LookUp(packet, inside, radiance, known);
  seen.Add(radiance, covered, inside);
  return isKnown && this->Rule.IsPlain(seen);
}

void TexelRenderer::Write(const Block& block) const
{
  std::int64_t indices[RayPacket::Size];
  for (int texel = 0; texel < RayPacket::Size; ++texel)
  {
    const std::int64_t row =
      std::int64_t(block.Slice - this->Layout.FirstSlice) * this->Layout.TileHeight + block.Y +
      TexelPlaces::GetRow(texel);
    indices[texel] = row * this->Layout.GetWidth() + block.Tile * this->Layout.TileWidth + block.X +
      TexelPlaces::GetColumn(texel);
  }
  block.Sums.Write(this->Settings.Exposure, block.Inside, indices);
}
}
