// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The positions of samples in their texels, and the samples that share a packet of rays.
 */
#ifndef cslfSamplePlaces_h
#define cslfSamplePlaces_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Rays/cslfRayPacket.h"

#include <cstdint>

namespace cslf
{
/// The texels of a block for a packet's rays: several samples of a few texels, texel by texel.
struct TexelGroup
{
  int First = 0; ///< of its texels
  int Size;      ///< the number of texels: 1, 4 or 16
  int Shift;     ///< its binary logarithm

  explicit TexelGroup(int size)
    : Size(size)
    , Shift(size == 16 ? 4
          : size == 4  ? 2
                       : 0)
  {
  }

  int GetTexel(int lane) const { return this->First + (lane & (this->Size - 1)); }
  int GetSample(int lane) const { return lane >> this->Shift; }
};

/// The texels of a block, as far as their samples' positions depend on them.
struct TexelPlaces
{
  alignas(64) float X[RayPacket::Size]; ///< of the texels, in the tile
  alignas(64) float Y[RayPacket::Size];
  alignas(64) std::uint32_t Low[RayPacket::Size]; ///< the scramble of their samples' positions
  alignas(64) std::uint32_t High[RayPacket::Size];

  /// Texels lie in a square, one square of 2 x 2 after the other.
  static int GetColumn(int texel) { return (texel & 1) | (texel >> 1 & 2); }
  static int GetRow(int texel) { return (texel >> 1 & 1) | (texel >> 2 & 2); }
};

/// The positions of the samples of a packet.
struct SamplePlaces
{
  alignas(64) float X[RayPacket::Size]; ///< in the texel, in [0,1]
  alignas(64) float Y[RayPacket::Size];
  alignas(64) float TileX[RayPacket::Size]; ///< in the tile
  alignas(64) float TileY[RayPacket::Size];
};

/// Computes the positions of the next samples of the texels of a group and of the groups after it,
/// one packet each. Doing several at once hides the latency of each.
VTKCSLF_EXPORT void FindPlaces(const TexelGroup& group, int packets, int firstSample,
  const TexelPlaces& texels, SamplePlaces places[]);
}

#endif
