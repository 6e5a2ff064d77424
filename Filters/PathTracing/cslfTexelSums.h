// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What the samples of texels add up to, and whether they are enough.
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
  alignas(64) float Depth[Size];       ///< the grid's parameter of the sample nearest to the centre
  alignas(64) float DepthOffset[Size]; ///< squared, from the centre to that sample
  int Samples = 0;                     ///< of each texel

  TexelSums();

  /// Adds samples of some texels: `covered` is -1 where one sees something, else 0, and its
  /// radiance 0.
  void Add(const TexelGroup& group, const PacketRadiance& radiance, const int covered[Size]);

  /// Adds to a sample what was left out of it: what a path in one of the texels saw.
  void AddPath(int texel, const glm::vec3& radiance);

  /// Adds the squares of the samples, which GetNoise needs.
  void AddSquares(const TexelGroup& group, const PacketRadiance& radiance);

  /// Sets the depth where a hit is the nearest to its texel's centre so far. Places are in the
  /// texel, in [0,1].
  void AddDepths(const TexelGroup& group, const RayPacket& packet, const PacketScale& scale,
    const float x[Size], const float y[Size]);

  /// The largest standard error of a texel's displayed colour or coverage, in parts of white.
  float GetNoise(float exposure) const;

  /// How far the displayed colours of the texels that are inside lie apart, in parts of white;
  /// infinitely far where only some are covered.
  float GetRange(float exposure, const int inside[Size]) const;
};
}

#endif
