// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From rays to texels: which rays a texel averages, and what it stores.
 */
#ifndef cslfTexelRenderer_h
#define cslfTexelRenderer_h

#include "vtkCSLFModule.h" // for export macro

#include "RadianceCache/cslfDiffuseLookUp.h"
#include "cslfDisplayCurve.h"
#include "cslfPathIntegrator.h"
#include "cslfRayGrid.h"
#include "cslfSamplePlaces.h"
#include "cslfStoppingRule.h"
#include "cslfTexelSums.h"

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
  int FirstSlice = 0; ///< slices are numbered absolutely
  int Slices = 1;

  int GetWidth() const { return this->Tiles * this->TileWidth; }
};

/// Where texels are written; what is null is not. The first slice comes first, x varies fastest.
struct TexelOutput
{
  unsigned char* ColorBytes = nullptr; ///< 4 a texel, as EncodeColor writes them
  float* ColorFloats = nullptr;        ///< 4 a texel: linear radiance times exposure, and alpha
  unsigned short* Depth = nullptr;     ///< the ray's parameter at the hit, [0,1] as [0,65535]
};

struct RenderSettings
{
  int Samples = 64;
  double NoiseTarget = 0.0; ///< the displayed error at which sampling ends early; 0 for never
  std::uint32_t Seed = 0;
  double Exposure = 1.0;
  double DisplayRange = DisplayCurve::ByteRange; ///< of the noise target: see DisplayCurve
  bool ShowEnvironment = false; ///< whether rays that miss see the environment, with alpha 1
  PathSettings Paths;
  const RadianceCache* Cache = nullptr; ///< of the scene; null where paths are traced to their end
};

/// Renders the texels of a picture, whichever way they are dealt out: a texel depends on its
/// absolute position and the settings only.
class VTKCSLF_EXPORT TexelRenderer
{
public:
  TexelRenderer(const Scene& scene, const PictureLayout& layout, const RenderSettings& settings,
    std::function<RayGrid(int slice, int tile)> grids, const TexelOutput& output);

  /// Renders all texels on VTK's threads. Between batches tells the calling thread how much is
  /// done, which says whether to go on. False where it did not.
  bool Render(const std::function<bool(double)>& goOn) const;

  /// The rays traced so far.
  std::uint64_t GetNumberOfRays() const { return this->Rays; }

private:
  static constexpr int BlockSide = 4; // a packet of rays is one of each texel of a block

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
  void Follow(const RayPacket& packet, Block& block, const TexelGroup& group, const int covered[],
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
  TexelOutput Output;
  PathIntegrator Integrator;
  DiffuseLookUp Known;
  Box Bounds;
  StoppingRule Rule;
  mutable std::atomic<std::uint64_t> Rays{ 0 };
};
}

#endif
