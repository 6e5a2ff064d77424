// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelRenderer.h"

#include "cslfColor.h"
#include "cslfVectorize.h"

#include <vtkSMPThreadLocal.h>
#include <vtkSMPTools.h>
#include <vtkType.h>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

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

/// The places of samples in their texels.
CSLF_VECTORIZE void FindPlaces(const std::uint32_t* samples, const std::uint32_t* low,
  const std::uint32_t* high, float* x, float* y)
{
  CSLF_LANE_LOOP
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    SampleStream::Get2D(samples[lane], { low[lane], high[lane] }, x[lane], y[lane]);
  }
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
  int Inside[RayPacket::Size];           // -1 where the tile has the lane's texel, else 0
  std::uint64_t Hashes[RayPacket::Size]; // of the texels, for their random numbers
  std::uint32_t Low[RayPacket::Size];    // the scramble of their samples' places
  std::uint32_t High[RayPacket::Size];
  int Samples = 0;     // taken of each texel
  bool IsExact = true; // whether all are without noise

  int LaneX(int lane) const { return this->X + lane % BlockSide; }
  int LaneY(int lane) const { return this->Y + lane / BlockSide; }
};

/// Which sample of which of a block's texels each ray of a packet is.
struct TexelRenderer::Lineup
{
  int Texel[RayPacket::Size];
  std::uint32_t Sample[RayPacket::Size];
};

/// What the samples of a texel add up to.
struct TexelRenderer::Sums
{
  glm::vec3 Radiance{ 0.0f };
  glm::vec3 Squares{ 0.0f }; // of the samples' radiance
  int Covered = 0;           // samples that see something
  double Depth = 1.0;
  float DepthOffset = std::numeric_limits<float>::max(); // squared, from the centre to that sample

  void Add(const glm::vec3& radiance)
  {
    this->Radiance += radiance;
    this->Squares += radiance * radiance;
    ++this->Covered;
  }

  void AddDepth(double depth, float offset)
  {
    if (offset < this->DepthOffset)
    {
      this->Depth = depth;
      this->DepthOffset = offset;
    }
  }
};

/// A block on its way.
struct TexelRenderer::Work
{
  Block Texels;
  Sums Results[RayPacket::Size];
};

/// Paths that wait to be followed together, those of some blocks of a row: which they are depends
/// on the row alone.
struct TexelRenderer::PathQueue
{
  PathBatch Batch;
  std::vector<Sums*> Texels; // of the batch's paths
  std::uint64_t Rays = 0;    // of all paths so far
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
  vtkSMPThreadLocal<PathQueue> queues;
  for (std::int64_t first = 0; first < rows; first += batch)
  {
    if (!goOn(static_cast<double>(first) / static_cast<double>(rows)))
    {
      return false;
    }
    vtkSMPTools::For(first, std::min(first + batch, rows),
      [this, &queues](vtkIdType begin, vtkIdType end)
      {
        PathQueue& queue = queues.Local();
        for (vtkIdType index = begin; index < end; ++index)
        {
          this->RenderRow(index, queue);
        }
      });
  }
  return goOn(1.0);
}

void TexelRenderer::RenderRow(std::int64_t index, PathQueue& queue) const
{
  const std::int64_t rows = this->GetRowsOfTile();
  Block block;
  block.Y = static_cast<int>(index % rows) * BlockSide;
  index /= rows;
  block.Tile = static_cast<int>(index % this->Layout.Tiles);
  block.Slice = this->Layout.FirstSlice + static_cast<int>(index / this->Layout.Tiles);
  block.Grid = this->Grids(block.Slice, block.Tile);
  std::vector<Work> works(this->GetBlocksAtOnce());
  queue.Rays = 0;
  int count = 0;
  for (int column = 0; column < this->Layout.TileWidth; column += BlockSide)
  {
    works[count] = { block, {} };
    this->SetTexels(works[count].Texels, column);
    if (++count == static_cast<int>(works.size()))
    {
      this->RenderBlocks(works.data(), count, queue);
      count = 0;
    }
  }
  this->RenderBlocks(works.data(), count, queue);
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
    const int x = block.LaneX(lane);
    const int y = block.LaneY(lane);
    block.Inside[lane] = x < this->Layout.TileWidth && y < this->Layout.TileHeight ? -1 : 0;
    block.Hashes[lane] = SampleStream::HashTexel(
      this->Settings.Seed, block.Slice, block.Tile * this->Layout.TileWidth + x, y);
    const auto scramble = SampleStream::MakeScramble(block.Hashes[lane], Dimension::Pixel);
    block.Low[lane] = scramble.Low;
    block.High[lane] = scramble.High;
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

void TexelRenderer::RenderBlocks(Work* works, int count, PathQueue& queue) const
{
  std::vector<Work*> unfinished;
  for (int i = 0; i < count; ++i)
  {
    unfinished.push_back(works + i);
  }
  for (int samples = 0; samples < this->Settings.Samples && !unfinished.empty();)
  {
    const int added = this->GetSamplesAtOnce(samples);
    samples += added;
    for (Work* work : unfinished)
    {
      this->AddSamples(*work, added, queue);
    }
    if (this->Settings.NoiseTarget > 0.0 && IsPowerOfTwo(samples))
    {
      this->FollowPaths(queue);
      const auto isGood = [this](const Work* work)
      { return this->IsGoodEnough(work->Texels, work->Results); };
      unfinished.erase(
        std::remove_if(unfinished.begin(), unfinished.end(), isGood), unfinished.end());
    }
  }
  this->FollowPaths(queue);
  for (int i = 0; i < count; ++i)
  {
    if (this->Output.Depth)
    {
      this->FindDepths(works[i].Texels, works[i].Results);
    }
    this->Write(works[i].Texels, works[i].Results);
  }
}

bool TexelRenderer::IsGoodEnough(const Block& block, const Sums sums[]) const
{
  // A few samples tell of noise only where there is none.
  if (block.Samples < FewestSamples)
  {
    return block.IsExact && this->IsSmooth(block, sums);
  }
  const auto count = static_cast<float>(block.Samples);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const Sums& sum = sums[lane];
    const glm::vec3 mean = sum.Radiance / count;
    const glm::vec3 variance =
      glm::max(sum.Squares / count - mean * mean, glm::vec3(0.0f)) / (count - 1.0f);
    const glm::vec3 error = this->Display(mean + glm::sqrt(variance)) - this->Display(mean);
    const float alpha = static_cast<float>(sum.Covered) / count;
    const float errorOfAlpha = std::sqrt(alpha * (1.0f - alpha) / (count - 1.0f));
    if (!(std::max({ error.x, error.y, error.z, errorOfAlpha }) <= this->Settings.NoiseTarget))
    {
      return false;
    }
  }
  return true;
}

bool TexelRenderer::IsSmooth(const Block& block, const Sums sums[]) const
{
  // Where in its texel a sample lies matters as much as the texels differ from their neighbours.
  const auto count = static_cast<float>(block.Samples);
  glm::vec3 lowest(1.0f);
  glm::vec3 highest(0.0f);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    if (block.Inside[lane])
    {
      if (sums[lane].Covered != sums[0].Covered)
      {
        return false;
      }
      const glm::vec3 color = this->Display(sums[lane].Radiance / count);
      lowest = glm::min(lowest, color);
      highest = glm::max(highest, color);
    }
  }
  const glm::vec3 range = highest - lowest;
  return std::max({ range.x, range.y, range.z }) < RangeOfTarget * this->Settings.NoiseTarget;
}

glm::vec3 TexelRenderer::Display(const glm::vec3& radiance) const
{
  return glm::sqrt(
    glm::min(radiance * static_cast<float>(this->Settings.Exposure), glm::vec3(1.0f)));
}

/// That of one of `count` packets, which together hold `count` samples of each texel: 1, 4 or 16.
/// The more there are, the fewer texels share a packet, and the closer its rays run.
TexelRenderer::Lineup TexelRenderer::LineUp(int packet, int count, std::uint32_t firstSample)
{
  Lineup lineup;
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    int texel = count == 1 ? lane : packet;
    int sample = count == 1 ? 0 : lane;
    if (count == 4)
    {
      const int x = 2 * (packet % 2) + lane % 2;
      const int y = 2 * (packet / 2) + lane / 2 % 2;
      texel = BlockSide * y + x;
      sample = lane / 4;
    }
    lineup.Texel[lane] = texel;
    lineup.Sample[lane] = firstSample + static_cast<std::uint32_t>(sample);
  }
  return lineup;
}

void TexelRenderer::AddSamples(Work& work, int count, PathQueue& queue) const
{
  Block& block = work.Texels;
  for (int packet = 0; packet < count; ++packet)
  {
    if (count < RayPacket::Size || block.Inside[packet])
    {
      if (queue.Batch.GetSize() + RayPacket::Size > PathBatch::Capacity)
      {
        this->FollowPaths(queue);
      }
      this->AddPacket(block, LineUp(packet, count, static_cast<std::uint32_t>(block.Samples)),
        work.Results, queue);
    }
  }
  block.Samples += count;
}

void TexelRenderer::AddPacket(
  Block& block, const Lineup& lineup, Sums sums[], PathQueue& queue) const
{
  // Make the rays.
  std::uint32_t low[RayPacket::Size];
  std::uint32_t high[RayPacket::Size];
  float x[RayPacket::Size];
  float y[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const int texel = lineup.Texel[lane];
    low[lane] = block.Low[texel];
    high[lane] = block.High[texel];
    x[lane] = static_cast<float>(block.LaneX(texel));
    y[lane] = static_cast<float>(block.LaneY(texel));
  }
  float placesX[RayPacket::Size];
  float placesY[RayPacket::Size];
  FindPlaces(lineup.Sample, low, high, placesX, placesY);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    x[lane] += placesX[lane];
    y[lane] += placesY[lane];
  }
  RayPacket packet;
  const PacketScale scale = SetRays(block.Grid, x, y, packet);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    packet.Active[lane] &= block.Inside[lineup.Texel[lane]];
    queue.Rays -= packet.Active[lane];
  }
  this->World.Intersect(packet);

  // Follow each.
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const Hit& hit = packet.Hits[lane];
    const int texel = lineup.Texel[lane];
    Sums& sum = sums[texel];
    if (hit.IsValid())
    {
      const bool isExact = this->Integrator.CanLookUp(hit);
      block.IsExact = block.IsExact && isExact;
      if (isExact)
      {
        sum.Add(this->Integrator.LookUp(hit));
      }
      else
      {
        queue.Batch.Add({ packet.GetRay(lane), block.Hashes[texel], lineup.Sample[lane] }, hit);
        queue.Texels.push_back(&sum);
      }
      const float offsetX = placesX[lane] - 0.5f;
      const float offsetY = placesY[lane] - 0.5f;
      sum.AddDepth(scale.ToParameter(lane, hit.Distance), offsetX * offsetX + offsetY * offsetY);
    }
    else if (this->Settings.ShowEnvironment && block.Inside[texel])
    {
      sum.Add(this->World.GetEnvironment().GetRadiance(packet.GetRay(lane).Direction));
    }
  }
}

void TexelRenderer::FollowPaths(PathQueue& queue) const
{
  this->Integrator.Follow(queue.Batch, queue.Rays);
  for (int path = 0; path < queue.Batch.GetSize(); ++path)
  {
    queue.Texels[path]->Add(queue.Batch.GetRadiance(path));
  }
  queue.Batch.Clear();
  queue.Texels.clear();
}

void TexelRenderer::FindDepths(const Block& block, Sums sums[]) const
{
  float x[RayPacket::Size];
  float y[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    x[lane] = static_cast<float>(block.LaneX(lane)) + 0.5f;
    y[lane] = static_cast<float>(block.LaneY(lane)) + 0.5f;
  }
  RayPacket packet;
  packet.PassByHalf = true;
  const PacketScale scale = SetRays(block.Grid, x, y, packet);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    packet.Active[lane] &= block.Inside[lane];
  }
  this->World.Intersect(packet);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const Hit& hit = packet.Hits[lane];
    if (hit.IsValid())
    {
      sums[lane].Depth = scale.ToParameter(lane, hit.Distance);
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
    const glm::dvec3 radiance =
      glm::dvec3(sum.Radiance) * (this->Settings.Exposure / block.Samples);
    const double alpha = static_cast<double>(sum.Covered) / block.Samples;
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
