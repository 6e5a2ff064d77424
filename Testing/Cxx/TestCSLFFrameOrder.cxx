// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The coding order, its run-length form and the groups.
#include "Coding/cslfFrameOrder.h"
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
  const cslf::FrameOrder order = cslf::MakeFrameOrder(grid);
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
  for (int length : { 1, 5, 16 })
  {
    const std::vector<int> groups = cslf::MakeGroups(order, length);
    int frame = 0;
    for (int group : groups)
    {
      CSLF_CHECK(group >= 1 && group <= length);
      CSLF_CHECK(frame >= order.Coarsest || frame + group <= order.Coarsest);
      frame += group;
    }
    CSLF_CHECK(frame == grid.GetSlices());
  }
}

void TestSerpentine()
{
  // Within the rest, neighbours in a row follow each other and rows turn around.
  const cslf::Layout grid(3, 16);
  const std::vector<int> expected{ 0, 1, 2, 5, 4, 3, 6, 7, 8, 11, 10, 9 };
  const std::vector<int> slices = cslf::MakeFrameOrder(grid).Slices;
  CSLF_CHECK(std::equal(expected.begin(), expected.end(), slices.begin()));
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
  }
  TestSerpentine();
  TestBadRuns();
  return cslf::testing::Result();
}
