// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexelRenderer.h"

#include "cslfColor.h"
#include "cslfVectorize.h"

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

// Across the 4 texels of a block's side a colour may change by this many noise targets, for one
// sample to do: between its texel's centre and itself there is a quarter of a texel on average.
constexpr double RangeOfTarget = 8.0;

/// The places of a sample in each of 16 texels.
CSLF_VECTORIZE void FindPlaces(
  std::uint32_t sample, const std::uint32_t* low, const std::uint32_t* high, float* x, float* y)
{
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    SampleStream::Get2D(sample, { low[lane], high[lane] }, x[lane], y[lane]);
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
  std::uint64_t Rays = 0;
  int Samples = 0;      // taken of each texel
  bool IsExact = false; // whether all are without noise

  int LaneX(int lane) const { return this->X + lane % BlockSide; }
  int LaneY(int lane) const { return this->Y + lane / BlockSide; }
};

/// What the samples of a texel add up to.
struct TexelRenderer::Sums
{
  glm::vec3 Radiance{ 0.0f };
  glm::vec3 Squares{ 0.0f }; // of the samples' radiance
  int Covered = 0;           // samples that see something
  double Depth = 1.0;
  float DepthOffset = std::numeric_limits<float>::max(); // squared, from the centre to that sample

  void AddDepth(double depth, float offset)
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

void TexelRenderer::RenderBlock(Block& block) const
{
  Sums sums[RayPacket::Size];
  block.IsExact = true;
  for (block.Samples = 0; block.Samples < this->Settings.Samples;)
  {
    this->AddSamples(block, static_cast<std::uint32_t>(block.Samples), sums);
    ++block.Samples;
    if (this->Settings.NoiseTarget > 0.0 && this->IsGoodEnough(block, sums))
    {
      break;
    }
  }
  if (this->Output.Depth)
  {
    this->FindDepths(block, sums);
  }
  this->Write(block, sums);
}

bool TexelRenderer::IsGoodEnough(Block& block, const Sums sums[]) const
{
  // Sequences are best at powers of two. A few samples tell of noise only where there is none.
  if ((block.Samples & (block.Samples - 1)) != 0)
  {
    return false;
  }
  if (block.Samples < FewestSamples)
  {
    return block.IsExact && this->IsSmooth(block, sums) &&
      this->IsInOnePiece(block, sums[0].Covered > 0);
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

bool TexelRenderer::IsInOnePiece(Block& block, bool covered) const
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
  SetRays(block.Grid, x, y, packet);
  block.Rays += RayPacket::Size;
  this->World.Intersect(packet);
  const bool isCovered = this->Settings.ShowEnvironment ? packet.Hits[0].IsValid() : covered;
  return std::all_of(packet.Hits, packet.Hits + RayPacket::Size,
    [isCovered](const Hit& hit) { return hit.IsValid() == isCovered; });
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

void TexelRenderer::AddSamples(Block& block, std::uint32_t index, Sums sums[]) const
{
  // Take one ray of each texel.
  float placesX[RayPacket::Size];
  float placesY[RayPacket::Size];
  FindPlaces(index, block.Low, block.High, placesX, placesY);
  float x[RayPacket::Size];
  float y[RayPacket::Size];
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    x[lane] = static_cast<float>(block.LaneX(lane)) + placesX[lane];
    y[lane] = static_cast<float>(block.LaneY(lane)) + placesY[lane];
  }
  RayPacket packet;
  const PacketScale scale = SetRays(block.Grid, x, y, packet);
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    packet.Active[lane] &= block.Inside[lane];
    block.Rays -= packet.Active[lane];
  }
  this->World.Intersect(packet);

  // Follow each.
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const Hit& hit = packet.Hits[lane];
    Sums& sum = sums[lane];
    if (hit.IsValid())
    {
      const Ray ray = packet.GetRay(lane);
      glm::vec3 radiance;
      if (!this->Integrator.LookUp(ray, hit, radiance))
      {
        block.IsExact = false;
        radiance = this->Integrator.GetRadiance(
          ray, hit, SampleStream(block.Hashes[lane], index), block.Rays);
      }
      sum.Radiance += radiance;
      sum.Squares += radiance * radiance;
      ++sum.Covered;
      const float offsetX = placesX[lane] - 0.5f;
      const float offsetY = placesY[lane] - 0.5f;
      sum.AddDepth(scale.ToParameter(lane, hit.Distance), offsetX * offsetX + offsetY * offsetY);
    }
    else if (this->Settings.ShowEnvironment && block.Inside[lane])
    {
      const glm::vec3 radiance =
        this->World.GetEnvironment().GetRadiance(packet.GetRay(lane).Direction);
      sum.Radiance += radiance;
      sum.Squares += radiance * radiance;
      ++sum.Covered;
    }
  }
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
