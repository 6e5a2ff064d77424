// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The channel Depth: the ray's parameter at the hit nearest to a texel's centre.
 */
#ifndef cslfDepthSum_h
#define cslfDepthSum_h

#include "cslfChannelSum.h"

#include <algorithm>

namespace cslf
{
class DepthSum : public ChannelSum
{
public:
  static constexpr KnownChannel Id = KnownChannel::Depth;
  static constexpr bool NeedsNearest = true;

  DepthSum() { std::fill_n(this->Depth, Size, 1.0f); }

  void KeepNearest(const PacketHits& hits, const int* nearest)
  {
    alignas(64) float depths[Size];
    for (int lane = 0; lane < Size; ++lane)
    {
      depths[lane] = hits.GetDepth(lane);
    }
    CopyNearest(this->Depth, hits.Group, depths, nearest);
  }

  /// [0,1] as [0,65535].
  void Write(const WrittenTexels& texels, const ViewpointSamples& output) const
  {
    auto* depths = output.Get<unsigned short>(Id);
    for (const WrittenTexels::Texel& texel : texels)
    {
      const float depth =
        texel.Covered > 0 ? std::clamp(this->Depth[texel.Number], 0.0f, 1.0f) : 1.0f;
      depths[texel.Index] = static_cast<unsigned short>(65535.0f * depth + 0.5f);
    }
  }

private:
  alignas(64) float Depth[Size];
};
}

#endif
