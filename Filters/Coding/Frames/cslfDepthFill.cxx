// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDepthFill.h"

#include "cslfLayout.h"
#include "cslfPushPull.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cslf
{
namespace
{
/// How much farther away a neighbour on the same surface may be.
constexpr float MostRimRatio = 1.1F;

/// Moves known texels beside unknown ones to the depth of the farthest known neighbour on the same
/// surface.
void PushRim(Patch& patch)
{
  const Patch before = patch;
  for (int y = 0; y < patch.Size; ++y)
  {
    for (int x = 0; x < patch.Size; ++x)
    {
      const std::size_t to = patch.IndexOf(x, y);
      const float most = MostRimRatio * before.Values[to];
      float farthest = before.Values[to];
      bool isRim = false;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, patch.Size - 1); ++j)
      {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, patch.Size - 1); ++i)
        {
          const std::size_t from = before.IndexOf(i, j);
          const bool isKnown = before.Weights[from] > 0.0F;
          isRim = isRim || !isKnown;
          const bool isSame = isKnown && before.Values[from] < most;
          farthest = isSame ? std::max(farthest, before.Values[from]) : farthest;
        }
      }
      if (isRim && before.Weights[to] > 0.0F)
      {
        patch.Values[to] = farthest;
      }
    }
  }
}
}

void FillDepth(int resolution, const unsigned char* coverage, const unsigned short* depth,
  unsigned short* filled)
{
  for (int tile = 0; tile < TileCount; ++tile)
  {
    const auto texelOf = [=](int x, int y)
    { return static_cast<std::size_t>(y) * TileCount * resolution + tile * resolution + x; };
    Patch patch(resolution);
    bool isCovered = false;
    for (int y = 0; y < resolution; ++y)
    {
      for (int x = 0; x < resolution; ++x)
      {
        const bool known = coverage[texelOf(x, y)] > 0;
        patch.Values[patch.IndexOf(x, y)] = depth[texelOf(x, y)];
        patch.Weights[patch.IndexOf(x, y)] = known ? 1.0F : 0.0F;
        isCovered = isCovered || known;
      }
    }
    if (isCovered)
    {
      PushRim(patch);
      Fill(patch);
    }
    for (int y = 0; y < resolution; ++y)
    {
      for (int x = 0; x < resolution; ++x)
      {
        filled[texelOf(x, y)] =
          static_cast<unsigned short>(std::lround(patch.Values[patch.IndexOf(x, y)]));
      }
    }
  }
}
}
