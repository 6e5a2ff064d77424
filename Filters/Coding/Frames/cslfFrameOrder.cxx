// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFrameOrder.h"

#include "cslfLayout.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cslf
{
namespace
{
/// Splits indices into parts of at most `most`, as equal as possible.
std::vector<std::vector<int>> Split(const std::vector<int>& indices, std::size_t most)
{
  const std::size_t count = (indices.size() + most - 1) / most;
  std::vector<std::vector<int>> parts(count);
  for (std::size_t k = 0; k < indices.size(); ++k)
  {
    parts[k * count / indices.size()].push_back(indices[k]);
  }
  return parts;
}

/// Adds the viewpoints of some rows and columns of a face that are not taken yet as a group.
void AddBlock(const Layout& grid, int face, const std::vector<int>& rows,
  const std::vector<int>& columns, std::vector<bool>& isTaken, FrameOrder& order)
{
  const std::size_t before = order.Slices.size();
  std::vector<int> path = columns;
  for (int j : rows)
  {
    for (int i : path)
    {
      const int slice = grid.SliceOf({ face, i, j });
      if (!isTaken[slice])
      {
        isTaken[slice] = true;
        order.Slices.push_back(slice);
      }
    }
    std::reverse(path.begin(), path.end());
  }
  if (order.Slices.size() > before)
  {
    order.Groups.push_back(static_cast<int>(order.Slices.size() - before));
  }
}

/// Adds the viewpoints of some rows and as many columns of all faces that are not taken yet.
void AddBlocks(const Layout& grid, const std::vector<int>& indices, int length,
  std::vector<bool>& isTaken, FrameOrder& order)
{
  const int height = static_cast<int>(std::sqrt(static_cast<double>(length)));
  const auto bands = Split(indices, height);
  const auto stacks = Split(indices, length / height);
  for (int face = 0; face < FaceCount; ++face)
  {
    for (const std::vector<int>& rows : bands)
    {
      for (const std::vector<int>& columns : stacks)
      {
        AddBlock(grid, face, rows, columns, isTaken, order);
      }
    }
  }
}
}

FrameOrder MakeFrameOrder(const Layout& grid, int length)
{
  const std::vector<int> nodes = CoarsestNodes(grid.GetViewpoints());
  std::vector<int> all(grid.GetViewpoints());
  std::iota(all.begin(), all.end(), 0);
  std::vector<bool> isTaken(grid.GetSlices(), false);
  FrameOrder order;
  order.Slices.reserve(grid.GetSlices());
  AddBlocks(grid, nodes, length, isTaken, order);
  order.Coarsest = static_cast<int>(order.Slices.size());
  AddBlocks(grid, all, length, isTaken, order);
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
}
