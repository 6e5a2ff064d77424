// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Directions in which points of a surface look around, in packets of rays that run alike.
 */
#ifndef cslfGatherDirections_h
#define cslfGatherDirections_h

#include "PathTracing/cslfFrame.h"
#include "PathTracing/cslfScene.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace cslf
{
/**
 * Owen-scrambled (0,2)-sequences of directions, spread by the cosine to z. A point of the surface
 * takes one of them and turns it about its normal. Directions are sorted, so that each packet's are
 * close to each other.
 */
class GatherDirections
{
public:
  /// The length of a sequence; longer ones go on with another, turned anew.
  static constexpr int Length = 1024;

  /// Sixteen directions, and where in the sequence they are.
  struct Packet
  {
    float X[RayPacket::Size];
    float Y[RayPacket::Size];
    float Z[RayPacket::Size];
    std::uint16_t Index[RayPacket::Size]; ///< among the Length directions
  };

  /// Sorts within the first directions, and within each doubling of their number: a power of two,
  /// at least 16.
  explicit GatherDirections(int first);

  /// The packet that starts with direction `count`, a multiple of 16, of the sequence of a key.
  const Packet& Get(std::uint64_t key, int count) const;

  /// A frame around a normal, turned for the sequence that direction `count` of a key is of.
  static Frame Turn(const Frame& frame, std::uint64_t key, int count);

private:
  static constexpr int Sequences = 16;

  std::vector<Packet> Packets;
};
}

#endif
