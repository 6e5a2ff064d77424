// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfFrameOrder.h"

#include "cslfLayout.h"

#include <algorithm>
#include <set>

namespace cslf
{
std::vector<int> CoarsestNodes(int viewpoints)
{
  const int last = viewpoints - 1;
  const int inner = viewpoints % 2 == 1 ? last / 2 : (2 * last + 3) / 6;
  const std::set<int> nodes{ 0, inner, last - inner, last };
  return { nodes.begin(), nodes.end() };
}

FrameOrder MakeFrameOrder(const Layout& grid)
{
  const int side = grid.GetViewpoints();
  const std::vector<int> nodes = CoarsestNodes(side);
  std::vector<bool> coarse(side, false);
  for (int node : nodes)
  {
    coarse[node] = true;
  }
  FrameOrder order;
  order.Slices.reserve(grid.GetSlices());
  for (const bool wanted : { true, false })
  {
    bool backwards = false;
    for (int face = 0; face < FaceCount; ++face)
    {
      for (int j = 0; j < side; ++j)
      {
        const auto before = order.Slices.size();
        for (int k = 0; k < side; ++k)
        {
          const int i = backwards ? side - 1 - k : k;
          if ((coarse[i] && coarse[j]) == wanted)
          {
            order.Slices.push_back(grid.SliceOf({ face, i, j }));
          }
        }
        backwards = backwards != (order.Slices.size() > before);
      }
    }
    if (wanted)
    {
      order.Coarsest = static_cast<int>(order.Slices.size());
    }
  }
  return order;
}

std::vector<SliceRun> ToRuns(const std::vector<int>& slices)
{
  std::vector<SliceRun> runs;
  for (int slice : slices)
  {
    if (!runs.empty())
    {
      SliceRun& run = runs.back();
      if (run.Count == 1)
      {
        run.Step = slice - run.Start;
      }
      if (slice == run.Start + run.Step * run.Count)
      {
        ++run.Count;
        continue;
      }
    }
    runs.push_back({ slice, 1, 1 });
  }
  return runs;
}

std::vector<int> FromRuns(const std::vector<SliceRun>& runs, int count)
{
  std::vector<int> slices;
  std::vector<bool> seen(count, false);
  for (const SliceRun& run : runs)
  {
    long long slice = run.Start;
    for (int k = 0; k < run.Count; ++k, slice += run.Step)
    {
      if (slice < 0 || slice >= count || seen[slice])
      {
        return {};
      }
      seen[slice] = true;
      slices.push_back(static_cast<int>(slice));
    }
  }
  return static_cast<int>(slices.size()) == count ? slices : std::vector<int>();
}

std::vector<int> MakeGroups(const FrameOrder& order, int length)
{
  std::vector<int> groups;
  const int whole = static_cast<int>(order.Slices.size());
  for (int frame = 0; frame < whole; frame += groups.back())
  {
    const int end = frame < order.Coarsest ? order.Coarsest : whole;
    groups.push_back(std::min(length, end - frame));
  }
  return groups;
}
}
