// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPushPull.h"

namespace cslf
{
namespace
{
/// The patch at half the size: the means of the known numbers.
Patch Shrink(const Patch& fine)
{
  Patch coarse((fine.Size + 1) / 2);
  for (int y = 0; y < fine.Size; ++y)
  {
    for (int x = 0; x < fine.Size; ++x)
    {
      const std::size_t from = fine.IndexOf(x, y);
      const std::size_t to = coarse.IndexOf(x / 2, y / 2);
      coarse.Values[to] += fine.Weights[from] * fine.Values[from];
      coarse.Weights[to] += fine.Weights[from];
    }
  }
  for (std::size_t k = 0; k < coarse.Values.size(); ++k)
  {
    if (coarse.Weights[k] > 0.0F)
    {
      coarse.Values[k] /= coarse.Weights[k];
      coarse.Weights[k] = 1.0F;
    }
  }
  return coarse;
}
}

void Fill(Patch& patch)
{
  if (patch.Size == 1)
  {
    return;
  }
  Patch coarse = Shrink(patch);
  Fill(coarse);
  for (int y = 0; y < patch.Size; ++y)
  {
    for (int x = 0; x < patch.Size; ++x)
    {
      const std::size_t to = patch.IndexOf(x, y);
      if (patch.Weights[to] == 0.0F)
      {
        patch.Values[to] = coarse.Values[coarse.IndexOf(x / 2, y / 2)];
      }
    }
  }
}
}
