// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSamplePlaces.h"

#include "cslfSampleStream.h"
#include "cslfVectorize.h"

namespace cslf
{
CSLF_VECTORIZE void FindPlaces(const TexelGroup& group, int packets, int firstSample,
  const TexelPlaces& texels, SamplePlaces* places)
{
  for (int i = 0; i < packets; ++i)
  {
    SamplePlaces& packet = places[i];
    const int first = group.First + i * group.Size;
    CSLF_LANE_LOOP
    for (int lane = 0; lane < RayPacket::Size; ++lane)
    {
      const int texel = first + (lane & (group.Size - 1));
      SampleStream::Get2D(static_cast<std::uint32_t>(firstSample + (lane >> group.Shift)),
        { texels.Low[texel], texels.High[texel] }, packet.X[lane], packet.Y[lane]);
      packet.TileX[lane] = texels.X[texel] + packet.X[lane];
      packet.TileY[lane] = texels.Y[texel] + packet.Y[lane];
    }
  }
}
}
