// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointLevels.h"

#include "cslfLayout.h"

#include <algorithm>

namespace cslf
{
namespace
{
std::vector<int> Halve(const std::vector<int>& nodes)
{
  std::vector<int> finer{ nodes.front() };
  for (std::size_t k = 1; k < nodes.size(); ++k)
  {
    if (nodes[k] - nodes[k - 1] > 1)
    {
      finer.push_back((nodes[k - 1] + nodes[k]) / 2);
    }
    finer.push_back(nodes[k]);
  }
  return finer;
}
}

ViewpointLevels::ViewpointLevels(int viewpoints)
  : Levels(viewpoints, -1)
{
  this->Nodes.push_back(CoarsestNodes(viewpoints));
  while (static_cast<int>(this->Nodes.back().size()) < viewpoints)
  {
    this->Nodes.push_back(Halve(this->Nodes.back()));
  }
  for (int level = 0; level < this->GetCount(); ++level)
  {
    const std::vector<int>& nodes = this->Nodes[level];
    std::vector<int> intervals;
    for (int lower = 0; lower + 1 < static_cast<int>(nodes.size()); ++lower)
    {
      intervals.insert(intervals.end(), nodes[lower + 1] - nodes[lower], lower);
    }
    this->Intervals.push_back(intervals);
    for (int node : nodes)
    {
      this->Levels[node] = this->Levels[node] < 0 ? level : this->Levels[node];
    }
  }
}

int ViewpointLevels::LevelOf(int i, int j) const
{
  return std::max(this->Levels[i], this->Levels[j]);
}
}
