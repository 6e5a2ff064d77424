// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Directions in which points of a surface look around, in packets of rays that run alike.
 */
#ifndef cslfGatherDirections_h
#define cslfGatherDirections_h

#include "PathTracing/cslfRayPacket.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/**
 * Directions spread by the cosine to z, made from a (0,2)-sequence. Each point of the surface has
 * its own digital shift of that sequence: both numbers of a pair are combined, bit by bit, with a
 * random number (Kollig and Keller, "Efficient Multidimensional Sampling", Eurographics 2002). So
 * every direction is as likely as its density says, and the directions of one point are evenly
 * spread. A shift takes intervals of a power of two to such intervals; so the sequence is sorted
 * once, and each packet's directions stay close to each other.
 */
class GatherDirections
{
public:
  /// The length of the sequence; points that need more start again with another shift.
  static constexpr int Length = 1024;

  /// Sixteen directions, and where in the sequence they are.
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
  /// What is shifted: the numbers that tell the angle to z and the azimuth, as 24 bits each.
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
