// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointChoice.h"

#include <algorithm>

namespace cslf
{
std::vector<int> ChooseSlices(const Layout& grid, int most)
{
  const int step = std::max(1, (grid.GetViewpoints() - 1) / (most - 1));
  std::vector<int> slices;
  for (int slice = 0; slice < grid.GetSlices(); ++slice)
  {
    const Viewpoint viewpoint = grid.ViewpointOf(slice);
    const auto isChosen = [&](int node)
    { return node % step == 0 || node == grid.GetViewpoints() - 1; };
    if (isChosen(viewpoint.I) && isChosen(viewpoint.J))
    {
      slices.push_back(slice);
    }
  }
  return slices;
}
}
