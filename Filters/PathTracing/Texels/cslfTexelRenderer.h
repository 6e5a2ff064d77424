// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Computes texels from rays: the rays that a texel averages, and the values that it stores.
 */
#ifndef cslfTexelRenderer_h
#define cslfTexelRenderer_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "PathTracing/RadianceCache/cslfDiffuseLookUp.h"
#include "PathTracing/Rays/cslfRayGrid.h"
#include "Quality/cslfDisplayCurve.h"
#include "cslfSamplePlaces.h"
#include "cslfStoppingRule.h"
#include "cslfTexelSums.h"
#include "cslfViewpointSamples.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace cslf
{
/// A picture of slices, each a strip of tiles.
struct PictureLayout
{
  int TileWidth = 0;
  int TileHeight = 0;
  int Tiles = 1;
  int FirstSlice = 0; ///< slices have absolute numbers
  int Slices = 1;

  int GetWidth() const { return this->Tiles * this->TileWidth; }
};

struct RenderSettings
{
  int Samples = 64;
  double NoiseTarget = 0.0; ///< the displayed error at which sampling ends early; 0 for never
  std::uint32_t Seed = 0;
  double Exposure = 1.0;
  double DisplayRange = DisplayCurve::ByteRange; ///< of the noise target: see DisplayCurve
  bool SurfaceTexels = false;   ///< whether only the surface at a texel's centre gives its colour
  bool ShowEnvironment = false; ///< whether rays that miss see the environment, with alpha 1
  PathSettings Paths;
  const RadianceCache* Cache = nullptr; ///< of the scene; null if paths are traced to their end
};

/// Renders the texels of a picture. A texel depends only on its absolute position and the settings,
/// however the texels are distributed.
///
/// The arrays are those of the channels of TexelSums that are requested, among them `Color`. The
/// first slice comes first, and x varies fastest.
class VTKCSLF_EXPORT TexelRenderer
{
public:
  TexelRenderer(const Scene& scene, const PictureLayout& layout, const RenderSettings& settings,
    std::function<RayGrid(int slice, int tile)> grids, const ViewpointSamples& output);

  /// Renders all texels on VTK's threads. Between batches calls a function on the calling thread
  /// with the progress; if that returns false, stops and returns false.
  bool Render(const std::function<bool(double)>& goOn) const;

  /// The rays traced so far.
  std::uint64_t GetNumberOfRays() const { return this->Rays; }

private:
  static constexpr int BlockSide = 4; // a packet has one ray for each texel of a block

  struct Block;
  struct PathQueue;

  std::int64_t GetRowsOfTile() const;
  int GetBlocksOfRow() const;
  int GetBlocksOfRun() const;
  int GetRunsOfRow() const;
  void RenderRun(std::int64_t index, PathQueue& queue) const;
  void SetTexels(Block& block, int column) const;
  bool IsAdaptive() const;
  void RenderBlocks(std::vector<Block>& blocks, PathQueue& queue) const;
  void TakeSingles(std::vector<Block>& blocks, PathQueue& queue) const;
  void TakeEnough(std::vector<Block>& blocks, PathQueue& queue) const;
  void AddUpTo(int samples, std::vector<Block>& blocks, PathQueue& queue) const;
  void AddUpTo(int samples, Block& block, PathQueue& queue) const;
  void AddSamples(Block& block, int count, PathQueue& queue) const;
  void AddPacket(
    Block& block, const TexelGroup& group, const SamplePlaces& places, PathQueue& queue) const;
  bool LookUp(
    const RayPacket& packet, const int inside[], PacketRadiance& radiance, int covered[]) const;
  bool MustFollow(const RayPacket& packet, int lane) const;
  void Follow(const PacketHits& hits, const int covered[], const int own[], Block& block,
    PathQueue& queue) const;
  void FollowPaths(PathQueue& queue) const;
  bool MayMeetScene(const Block& block) const;
  void LookAhead(Block& block, std::uint64_t& rays) const;
  bool IsPlain(const RayPacket& centers, Block& block, std::uint64_t& rays) const;
  bool AddSeen(const RayPacket& packet, const int inside[], ColorBounds& seen) const;
  void Write(const Block& block) const;

  const Scene& World;
  PictureLayout Layout;
  RenderSettings Settings;
  std::function<RayGrid(int, int)> Grids;
  ViewpointSamples Output;
  bool NeedsNearest;
  PathIntegrator Integrator;
  DiffuseLookUp Known;
  Box Bounds;
  StoppingRule Rule;
  mutable std::atomic<std::uint64_t> Rays{ 0 };
};
}

#endif
