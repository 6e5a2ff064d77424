// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sums of the samples of texels.
 */
#ifndef cslfTexelSums_h
#define cslfTexelSums_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/RadianceCache/cslfDiffuseLookUp.h"
#include "cslfRayGrid.h"
#include "cslfSamplePlaces.h"

namespace cslf
{
/// For as many texels as a packet has rays.
struct VTKCSLF_EXPORT TexelSums
{
  static constexpr int Size = RayPacket::Size;

  alignas(64) float Red[Size] = {};
  alignas(64) float Green[Size] = {};
  alignas(64) float Blue[Size] = {};
  alignas(64) float RedSquares[Size] = {}; ///< of the samples' radiance, if it is requested
  alignas(64) float GreenSquares[Size] = {};
  alignas(64) float BlueSquares[Size] = {};
  alignas(64) int Covered[Size] = {};  ///< the number of samples that see something
  alignas(64) int Paths[Size] = {};    ///< the number of samples whose paths were followed
  alignas(64) float Depth[Size];       ///< the grid's parameter of the sample nearest to the centre
  alignas(64) float DepthOffset[Size]; ///< squared, from the centre to that sample
  int Samples = 0;                     ///< of each texel

  TexelSums();

  /// Adds samples of some texels. `covered` is -1 if a sample sees something, else 0 with radiance
  /// 0.
  void Add(const TexelGroup& group, const PacketRadiance& radiance, const int covered[Size]);

  /// Adds the missing part of a sample: the radiance of a path in one of the texels.
  void AddPath(int texel, const glm::vec3& radiance);

  /// Adds the squares of the samples.
  void AddSquares(const TexelGroup& group, const PacketRadiance& radiance);

  /// Sets the depth if a hit is the nearest one to its texel's centre so far. Positions are in the
  /// texel, in [0,1].
  void AddDepths(const TexelGroup& group, const RayPacket& packet, const PacketScale& scale,
    const float x[Size], const float y[Size]);
};

/// The values that texels store: the means of as many samples as each texel needs.
class VTKCSLF_EXPORT TexelMeans
{
public:
  static constexpr int Size = TexelSums::Size;

  int Samples[Size] = {}; ///< 0 if there is no mean yet
  int Covered[Size];      ///< the number of samples that see something
  float Red[Size];        ///< sums over the samples
  float Green[Size];
  float Blue[Size];

  /// Takes the mean of a texel's samples so far, unless that was done before.
  void Take(int texel, const TexelSums& sums);

  /// Takes the means of all texels.
  void TakeAll(const TexelSums& sums);

  /// Whether all texels have their means.
  bool AreTaken() const { return this->Taken == Size; }

private:
  int Taken = 0;
};
}

#endif
