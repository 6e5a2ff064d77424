// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the samples of texels add up to.
 */
#ifndef cslfTexelSums_h
#define cslfTexelSums_h

#include "vtkCSLFModule.h" // for export macro

#include "RadianceCache/cslfDiffuseLookUp.h"
#include "cslfRayGrid.h"
#include "cslfSamplePlaces.h"

namespace cslf
{
/// Of as many texels as a packet has rays.
struct VTKCSLF_EXPORT TexelSums
{
  static constexpr int Size = RayPacket::Size;

  alignas(64) float Red[Size] = {};
  alignas(64) float Green[Size] = {};
  alignas(64) float Blue[Size] = {};
  alignas(64) float RedSquares[Size] = {}; ///< of the samples' radiance, if they are asked for
  alignas(64) float GreenSquares[Size] = {};
  alignas(64) float BlueSquares[Size] = {};
  alignas(64) int Covered[Size] = {};  ///< samples that see something
  alignas(64) int Paths[Size] = {};    ///< samples whose paths were followed
  alignas(64) float Depth[Size];       ///< the grid's parameter of the sample nearest to the centre
  alignas(64) float DepthOffset[Size]; ///< squared, from the centre to that sample
  int Samples = 0;                     ///< of each texel

  TexelSums();

  /// Adds samples of some texels: `covered` is -1 where one sees something, else 0, and its
  /// radiance 0.
  void Add(const TexelGroup& group, const PacketRadiance& radiance, const int covered[Size]);

  /// Adds to a sample what was left out of it: what a path in one of the texels saw.
  void AddPath(int texel, const glm::vec3& radiance);

  /// Adds the squares of the samples.
  void AddSquares(const TexelGroup& group, const PacketRadiance& radiance);

  /// Sets the depth where a hit is the nearest to its texel's centre so far. Places are in the
  /// texel, in [0,1].
  void AddDepths(const TexelGroup& group, const RayPacket& packet, const PacketScale& scale,
    const float x[Size], const float y[Size]);
};

/// What texels store: the means of their samples, of each texel so many as it needs.
class VTKCSLF_EXPORT TexelMeans
{
public:
  static constexpr int Size = TexelSums::Size;

  int Samples[Size] = {}; ///< 0 where the mean is not taken yet
  int Covered[Size];      ///< samples that see something
  float Red[Size];        ///< sums over the samples
  float Green[Size];
  float Blue[Size];

  /// Takes the mean of a texel's samples so far, unless it was taken before.
  void Take(int texel, const TexelSums& sums);

  /// Takes those of all texels.
  void TakeAll(const TexelSums& sums);

  /// Whether all have theirs.
  bool AreTaken() const { return this->Taken == Size; }

private:
  int Taken = 0;
};
}

#endif
