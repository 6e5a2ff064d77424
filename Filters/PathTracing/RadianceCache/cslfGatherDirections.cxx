// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGatherDirections.h"

#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"
#include "SIMD/cslfVectorize.h"

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
constexpr int Bits = 24;

struct Pair
{
  std::uint32_t Angle;
  std::uint32_t Azimuth;
  std::uint16_t Index;
};

/// The interval of a pair if azimuth and angle are each divided into a power of two of parts.
std::uint32_t GetInterval(const Pair& pair, int azimuthBits, int angleBits)
{
  const std::uint32_t azimuth = azimuthBits > 0 ? pair.Azimuth >> (Bits - azimuthBits) : 0;
  const std::uint32_t angle = angleBits > 0 ? pair.Angle >> (Bits - angleBits) : 0;
  return azimuth << angleBits | angle;
}

/// Sorts pairs into intervals of 16; a block of the sequence has equally many in each. The
/// hemisphere is divided into quarters first, then by angle and azimuth alternately.
void Sort(std::vector<Pair>::iterator begin, std::vector<Pair>::iterator end)
{
  int azimuthBits = 0;
  int angleBits = 0;
  for (auto size = end - begin; size > RayPacket::Size; size /= 2)
  {
    ++(azimuthBits < 2 || azimuthBits - 2 < angleBits ? azimuthBits : angleBits);
  }
  std::stable_sort(begin, end,
    [azimuthBits, angleBits](const Pair& a, const Pair& b)
    { return GetInterval(a, azimuthBits, angleBits) < GetInterval(b, azimuthBits, angleBits); });
}
}

GatherDirections::GatherDirections(int first)
{
  std::vector<Pair> pairs;
  for (int i = 0; i < Length; ++i)
  {
    const glm::vec2 numbers =
      SampleStream(0, static_cast<std::uint32_t>(i)).Get2D(Dimension::Direction);
    pairs.push_back({ static_cast<std::uint32_t>(numbers.x * (1 << Bits)),
      static_cast<std::uint32_t>(numbers.y * (1 << Bits)), static_cast<std::uint16_t>(i) });
  }
  for (int end = std::min(first, Length); end <= Length; end *= 2)
  {
    Sort(pairs.begin() + (end > first ? end / 2 : 0), pairs.begin() + end);
  }
  for (int i = 0; i < Length; i += RayPacket::Size)
  {
    Numbers numbers;
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      numbers.Angle[lane] = pairs[i + lane].Angle;
      numbers.Azimuth[lane] = pairs[i + lane].Azimuth;
      numbers.Index[lane] = pairs[i + lane].Index;
    }
    this->Packets.push_back(numbers);
  }
}

void GatherDirections::Get(std::uint64_t key, int count, Packet& packet) const
{
  const std::uint64_t shift = MixBits(key, static_cast<std::uint64_t>(count / Length));
  const Numbers& numbers = this->Packets[count % Length / RayPacket::Size];
  constexpr std::uint64_t mask = (1u << Bits) - 1;
  Shift(numbers, static_cast<std::uint32_t>(shift & mask),
    static_cast<std::uint32_t>(shift >> Bits & mask), packet);
}

CSLF_VECTORIZE void GatherDirections::Shift(
  const Numbers& numbers, std::uint32_t angle, std::uint32_t azimuth, Packet& packet)
{
  constexpr float scale = 1.0f / (1 << Bits);
  packet.Index = numbers.Index;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < RayPacket::Size; ++lane)
  {
    const float square = static_cast<float>(static_cast<int>(numbers.Angle[lane] ^ angle)) * scale;
    const float turn =
      static_cast<float>(static_cast<int>(numbers.Azimuth[lane] ^ azimuth)) * scale;
    float sine = 0.0f;
    float cosine = 0.0f;
    SinCosOfTurn(turn, sine, cosine);
    const float radius = std::sqrt(square);
    packet.X[lane] = radius * cosine;
    packet.Y[lane] = radius * sine;
    packet.Z[lane] = std::sqrt(1.0f - square);
  }
}
}
