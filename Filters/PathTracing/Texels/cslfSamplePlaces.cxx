// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSamplePlaces.h"

#include "RandomNumbers/cslfSampleStream.h"
#include "SIMD/cslfVectorize.h"

namespace cslf
{
namespace
{
/// Repeats the values of some texels for each of a packet's samples.
template <int Texels, typename Value>
inline void Repeat(const Value* __restrict values, Value* __restrict repeated)
{
  for (int sample = 0; sample < RayPacket::Size / Texels; ++sample)
  {
    for (int texel = 0; texel < Texels; ++texel)
    {
      repeated[sample * Texels + texel] = values[texel];
    }
  }
}

template <int Texels>
inline void Repeat(const TexelPlaces& texels, int first, TexelPlaces& repeated)
{
  Repeat<Texels>(texels.X + first, repeated.X);
  Repeat<Texels>(texels.Y + first, repeated.Y);
  Repeat<Texels>(texels.Low + first, repeated.Low);
  Repeat<Texels>(texels.High + first, repeated.High);
}
}

CSLF_VECTORIZE void FindPlaces(const TexelGroup& group, int packets, int firstSample,
  const TexelPlaces& texels, SamplePlaces* places)
{
  for (int i = 0; i < packets; ++i)
  {
    SamplePlaces& packet = places[i];
    const int first = group.First + i * group.Size;
    TexelPlaces repeated;
    switch (group.Size)
    {
      case RayPacket::Size:
        Repeat<RayPacket::Size>(texels, first, repeated);
        break;
      case 4:
        Repeat<4>(texels, first, repeated);
        break;
      default:
        Repeat<1>(texels, first, repeated);
        break;
    }
    CSLF_LANE_LOOP
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      SampleStream::Get2D(static_cast<std::uint32_t>(firstSample + (lane >> group.Shift)),
        { repeated.Low[lane], repeated.High[lane] }, packet.X[lane], packet.Y[lane]);
      packet.TileX[lane] = repeated.X[lane] + packet.X[lane];
      packet.TileY[lane] = repeated.Y[lane] + packet.Y[lane];
    }
  }
}
}
