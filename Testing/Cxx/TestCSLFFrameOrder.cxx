// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The coding order, its run-length form and the groups.
#include "Coding/Frames/cslfFrameOrder.h"
#include "cslfLayout.h"
#include "cslfTesting.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace
{
void TestCoarsest()
{
  using Nodes = std::vector<int>;
  CSLF_CHECK(cslf::CoarsestNodes(2) == Nodes({ 0, 1 }));
  CSLF_CHECK(cslf::CoarsestNodes(3) == Nodes({ 0, 1, 2 }));
  CSLF_CHECK(cslf::CoarsestNodes(4) == Nodes({ 0, 1, 2, 3 }));
  CSLF_CHECK(cslf::CoarsestNodes(16) == Nodes({ 0, 5, 10, 15 }));
  CSLF_CHECK(cslf::CoarsestNodes(17) == Nodes({ 0, 8, 16 }));
  CSLF_CHECK(cslf::CoarsestNodes(40) == Nodes({ 0, 13, 26, 39 }));
  for (int viewpoints = 2; viewpoints < 70; ++viewpoints)
  {
    // A nested grid is one that a layout accepts.
    CSLF_CHECK(cslf::Layout(viewpoints, cslf::CoarsestNodes(viewpoints), 16).IsValid());
  }
}

void TestOrder(int viewpoints)
{
  const cslf::Layout grid(viewpoints, 16);
  const cslf::FrameOrder order = cslf::MakeFrameOrder(grid, 16);
  std::vector<int> sorted = order.Slices;
  std::sort(sorted.begin(), sorted.end());
  std::vector<int> all(grid.GetSlices());
  std::iota(all.begin(), all.end(), 0);
  CSLF_CHECK(sorted == all);

  const std::vector<int> nodes = cslf::CoarsestNodes(viewpoints);
  const auto isNode = [&](int index)
  { return std::find(nodes.begin(), nodes.end(), index) != nodes.end(); };
  CSLF_CHECK(order.Coarsest == static_cast<int>(cslf::FaceCount * nodes.size() * nodes.size()));
  for (int frame = 0; frame < grid.GetSlices(); ++frame)
  {
    const cslf::Viewpoint viewpoint = grid.ViewpointOf(order.Slices[frame]);
    CSLF_CHECK((frame < order.Coarsest) == (isNode(viewpoint.I) && isNode(viewpoint.J)));
  }

  const std::vector<cslf::SliceRun> runs = cslf::ToRuns(order.Slices);
  CSLF_CHECK(cslf::FromRuns(runs, grid.GetSlices()) == order.Slices);
}

void TestGroups(int viewpoints, int length)
{
  const cslf::Layout grid(viewpoints, 16);
  const cslf::FrameOrder order = cslf::MakeFrameOrder(grid, length);
  int frame = 0;
  for (int group : order.Groups)
  {
    CSLF_CHECK(group >= 1 && group <= length);
    CSLF_CHECK(frame >= order.Coarsest || frame + group <= order.Coarsest);
    const int face = grid.ViewpointOf(order.Slices[frame]).Face;
    for (int end = frame + group; frame < end; ++frame)
    {
      CSLF_CHECK(grid.ViewpointOf(order.Slices[frame]).Face == face);
    }
  }
  CSLF_CHECK(frame == grid.GetSlices());
}

void TestBlocks()
{
  // The coarsest grid's groups, one for each face, then squares in which rows turn around.
  const cslf::Layout grid(8, 16);
  const cslf::FrameOrder order = cslf::MakeFrameOrder(grid, 16);
  const std::vector<int> coarsest{ 0, 2, 5, 7, 23, 21, 18, 16, 40, 42, 45, 47, 63, 61, 58, 56 };
  CSLF_CHECK(order.Groups.front() == 16);
  CSLF_CHECK(std::equal(coarsest.begin(), coarsest.end(), order.Slices.begin()));
  const std::vector<int> block{ 1, 3, 11, 10, 9, 8, 17, 19, 27, 26, 25, 24 };
  CSLF_CHECK(order.Groups[cslf::FaceCount] == static_cast<int>(block.size()));
  CSLF_CHECK(std::equal(block.begin(), block.end(), order.Slices.begin() + order.Coarsest));
  CSLF_CHECK(cslf::ToRuns({ 0, 1, 2, 5, 4, 3, 9 }).size() == 3);
}

void TestBadRuns()
{
  constexpr int huge = std::numeric_limits<int>::max();
  CSLF_CHECK(cslf::FromRuns({}, 4).empty());
  CSLF_CHECK(cslf::FromRuns({ { 0, 1, 3 } }, 4).empty());
  CSLF_CHECK(cslf::FromRuns({ { 0, 1, 5 } }, 4).empty());
  CSLF_CHECK(cslf::FromRuns({ { 0, 0, huge } }, 4).empty());
  CSLF_CHECK(cslf::FromRuns({ { huge, huge, huge } }, 4).empty());
  CSLF_CHECK(cslf::FromRuns({ { 3, -1, 5 } }, 4).empty());
  CSLF_CHECK(cslf::FromRuns({ { 0, 1, 2 }, { 1, 1, 2 } }, 4).empty());
  CSLF_CHECK(cslf::FromRuns({ { 3, -1, 4 } }, 4) == std::vector<int>({ 3, 2, 1, 0 }));
}
}

int TestCSLFFrameOrder(int, char*[])
{
  TestCoarsest();
  for (int viewpoints : { 2, 3, 4, 5, 6, 9, 16, 17 })
  {
    TestOrder(viewpoints);
    for (int length : { 1, 2, 5, 16 })
    {
      TestGroups(viewpoints, length);
    }
  }
  TestBlocks();
  TestBadRuns();
  return cslf::testing::Result();
}
