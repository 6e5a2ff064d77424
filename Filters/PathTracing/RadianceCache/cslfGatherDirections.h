// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Directions of rays from points of a surface, in packets of coherent rays.
 */
#ifndef cslfGatherDirections_h
#define cslfGatherDirections_h

#include "PathTracing/Rays/cslfRayPacket.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/**
 * Cosine-distributed directions around z, made from a (0,2)-sequence. Each point of the surface has
 * its own digital shift of that sequence: both numbers of a pair are combined, bit by bit, with a
 * random number (Kollig and Keller, "Efficient Multidimensional Sampling", Eurographics 2002). So
 * directions have the right density, and those of one point are evenly spread. A shift maps
 * intervals whose size is a power of two to such intervals, so it is enough to sort the sequence
 * once to keep each packet's directions close to each other.
 */
class GatherDirections
{
public:
  /// The length of the sequence; points that need more start again with another shift.
  static constexpr int Length = 1024;

  /// Sixteen directions, and their place in the sequence.
  struct Packet
  {
    alignas(64) float X[RayPacket::Size];
    alignas(64) float Y[RayPacket::Size];
    alignas(64) float Z[RayPacket::Size];
    const std::uint16_t* Index; ///< among the Length directions
  };

  /// Sorts within the first directions, and within each doubling of their number: a power of two,
  /// at least 16.
  explicit GatherDirections(int first);

  /// The packet that starts with direction `count`, a multiple of 16, of the sequence of a key.
  void Get(std::uint64_t key, int count, Packet& packet) const;

private:
  /// The numbers to be shifted, which determine the angle to z and the azimuth, with 24 bits each.
  struct Numbers
  {
    alignas(64) std::uint32_t Angle[RayPacket::Size];
    alignas(64) std::uint32_t Azimuth[RayPacket::Size];
    std::uint16_t Index[RayPacket::Size];
  };

  static void Shift(
    const Numbers& numbers, std::uint32_t angle, std::uint32_t azimuth, Packet& packet);

  std::vector<Numbers> Packets;
};
}

#endif
