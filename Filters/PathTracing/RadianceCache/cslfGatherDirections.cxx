// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGatherDirections.h"

#include "PathTracing/cslfLambert.h"
#include "PathTracing/cslfSampleStream.h"

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
struct Direction
{
  glm::vec3 Local;
  std::uint16_t Index;
};

/// Halves directions, along x and y in turn, until each part is a packet.
void Sort(std::vector<Direction>::iterator begin, std::vector<Direction>::iterator end, int axis)
{
  const auto count = end - begin;
  if (count <= RayPacket::Size)
  {
    return;
  }
  const auto middle = begin + count / 2;
  std::nth_element(begin, middle, end,
    [axis](const Direction& a, const Direction& b)
    { return a.Local[axis] != b.Local[axis] ? a.Local[axis] < b.Local[axis] : a.Index < b.Index; });
  Sort(begin, middle, 1 - axis);
  Sort(middle, end, 1 - axis);
}

std::uint64_t HashSequence(std::uint64_t key, int count)
{
  return MixBits(key, static_cast<std::uint64_t>(count / GatherDirections::Length));
}
}

GatherDirections::GatherDirections(int first)
{
  for (int sequence = 0; sequence < Sequences; ++sequence)
  {
    std::vector<Direction> directions;
    for (int i = 0; i < Length; ++i)
    {
      const SampleStream stream(MixBits(0, sequence), static_cast<std::uint32_t>(i));
      directions.push_back(
        { Lambert::Sample(stream.Get2D(Dimension::Direction)), static_cast<std::uint16_t>(i) });
    }
    for (int end = std::min(first, Length); end <= Length; end *= 2)
    {
      Sort(directions.begin() + (end > first ? end / 2 : 0), directions.begin() + end, 0);
    }
    for (int i = 0; i < Length; i += RayPacket::Size)
    {
      Packet packet;
      for (int lane = 0; lane < RayPacket::Size; ++lane)
      {
        const Direction& direction = directions[i + lane];
        packet.X[lane] = direction.Local.x;
        packet.Y[lane] = direction.Local.y;
        packet.Z[lane] = direction.Local.z;
        packet.Index[lane] = direction.Index;
      }
      this->Packets.push_back(packet);
    }
  }
}

const GatherDirections::Packet& GatherDirections::Get(std::uint64_t key, int count) const
{
  const std::size_t sequence = HashSequence(key, count) % Sequences;
  return this->Packets[(sequence * Length + count % Length) / RayPacket::Size];
}

Frame GatherDirections::Turn(const Frame& frame, std::uint64_t key, int count)
{
  const float angle = static_cast<float>(HashSequence(key, count) >> 40) * 0x1p-24f * 2.0f * Pi;
  const float cosine = std::cos(angle);
  const float sine = std::sin(angle);
  Frame turned = frame;
  turned.X = cosine * frame.X + sine * frame.Y;
  turned.Y = cosine * frame.Y - sine * frame.X;
  return turned;
}
}
