// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGroupStages.h"

#include "Quality/cslfRobertsSequence.h"

#include <algorithm>
#include <numeric>

namespace cslf
{
namespace
{
constexpr int LeastSample = 24;
constexpr int LargestStride = 16;
}

GroupStages::GroupStages(int count)
  : Stages(count, 0)
{
  int stride = 1;
  while (2 * stride <= LargestStride && 2 * stride * LeastSample <= count)
  {
    stride *= 2;
  }
  // Where each stage ends, as a share of all groups. The last stages are small, so that few groups
  // depend on predictions only.
  std::vector<double> ends;
  for (int part = stride; part > 1; part /= 2)
  {
    ends.push_back(1.0 / part);
  }
  if (stride > 1)
  {
    ends.insert(ends.end(), { 0.75, 0.875, 0.9375 });
  }
  this->StageCount = static_cast<int>(ends.size()) + 1;
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [](int a, int b) { return RobertsNumber(a + 1, 0) < RobertsNumber(b + 1, 0); });
  for (int place = 0; place < count; ++place)
  {
    this->Stages[order[place]] = static_cast<int>(
      std::upper_bound(ends.begin(), ends.end(), place / static_cast<double>(count)) -
      ends.begin());
  }
}

std::vector<int> GroupStages::GetGroups(int stage) const
{
  std::vector<int> groups;
  for (std::size_t group = 0; group < this->Stages.size(); ++group)
  {
    if (this->Stages[group] == stage)
    {
      groups.push_back(static_cast<int>(group));
    }
  }
  return groups;
}
}
