// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The surfaces at the centres of texels, and the samples that lie on them.
 */
#ifndef cslfCenterSurfaces_h
#define cslfCenterSurfaces_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfChannelSum.h"

namespace cslf
{
/// For as many texels as a packet has rays. At first, all samples count.
class VTKCSLF_EXPORT CenterSurfaces
{
public:
  static constexpr int Size = RayPacket::Size;

  CenterSurfaces();

  /// Finds the surfaces from the hits of the rays to the centres, one for each texel. All samples
  /// count for texels whose centre sees nothing.
  void Find(const PacketHits& centers, const RayGrid& grid);

  /// Marks samples that lie on the surface at their texel's centre, or in its plane nearby, or that
  /// count anyway, by -1, others by 0. Returns whether there are others.
  bool FindSamples(const PacketHits& samples, int own[Size]) const;

private:
  alignas(64) float X[Size]; // the planes' normals
  alignas(64) float Y[Size];
  alignas(64) float Z[Size];
  alignas(64) float Offset[Size];
  alignas(64) float Reach[Size]; // the largest distance from a plane; negative if all samples count
  bool SelectsAny = false;
};
}

#endif
