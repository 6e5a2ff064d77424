// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSampleStream.h"
#include "SIMD/cslfVectorize.h"

namespace cslf
{
namespace
{
struct ScrambleLanes
{
  Lanes<std::uint32_t> Low;
  Lanes<std::uint32_t> High;
};

inline void MakeScrambles(
  const StreamLanes& streams, std::uint32_t vertex, Dimension dimension, ScrambleLanes& scrambles)
{
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const auto scramble = SampleStream::MakeScramble(streams.Hash[i], dimension, vertex);
    scrambles.Low[i] = scramble.Low;
    scrambles.High[i] = scramble.High;
  }
}

CSLF_VECTORIZE void MakePoints(const StreamLanes& streams, std::uint32_t vertex,
  Dimension dimension, Lanes<float>& x, Lanes<float>& y)
{
  ScrambleLanes scrambles;
  MakeScrambles(streams, vertex, dimension, scrambles);
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    SampleStream::Get2D(streams.Index[i], { scrambles.Low[i], scrambles.High[i] }, x[i], y[i]);
  }
}

CSLF_VECTORIZE void MakeNumbers(
  const StreamLanes& streams, std::uint32_t vertex, Dimension dimension, Lanes<float>& x)
{
  ScrambleLanes scrambles;
  MakeScrambles(streams, vertex, dimension, scrambles);
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    float unused;
    SampleStream::Get2D(streams.Index[i], { scrambles.Low[i], scrambles.High[i] }, x[i], unused);
  }
}
}

void StreamLanes::Get2D(
  std::uint32_t vertex, Dimension dimension, Lanes<float>& x, Lanes<float>& y) const
{
  MakePoints(*this, vertex * static_cast<std::uint32_t>(Dimension::Count), dimension, x, y);
}

void StreamLanes::Get1D(std::uint32_t vertex, Dimension dimension, Lanes<float>& x) const
{
  MakeNumbers(*this, vertex * static_cast<std::uint32_t>(Dimension::Count), dimension, x);
}

}
