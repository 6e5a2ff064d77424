// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfStreamLanes.h"

#include "cslfVectorize.h"

namespace cslf
{
namespace
{
CSLF_VECTORIZE void MakePoints(const StreamLanes& streams, std::uint32_t vertex,
  Dimension dimension, Lanes<float>& x, Lanes<float>& y)
{
  Lanes<std::uint32_t> low;
  Lanes<std::uint32_t> high;
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    const auto scramble = SampleStream::MakeScramble(streams.Hash[i], dimension, vertex);
    low[i] = scramble.Low;
    high[i] = scramble.High;
  }
  CSLF_LANE_LOOP
  for (int i = 0; i < LaneCount; ++i)
  {
    SampleStream::Get2D(streams.Index[i], { low[i], high[i] }, x[i], y[i]);
  }
}
}

void StreamLanes::Get2D(
  std::uint32_t vertex, Dimension dimension, Lanes<float>& x, Lanes<float>& y) const
{
  MakePoints(*this, vertex * static_cast<std::uint32_t>(Dimension::Count), dimension, x, y);
}
}
