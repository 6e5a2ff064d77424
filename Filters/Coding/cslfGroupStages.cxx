// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfGroupStages.h"

#include <algorithm>

namespace cslf
{
namespace
{
constexpr int LeastSample = 24;
constexpr int LargestStride = 16;
}

GroupStages::GroupStages(int count)
  : Count(count)
{
  while (2 * this->Stride <= LargestStride && 2 * this->Stride * LeastSample <= count)
  {
    this->Stride *= 2;
    ++this->Levels;
  }
  int last = 0;
  for (int group = 0; group < std::min(count, this->Stride); ++group)
  {
    last = std::max(last, this->GetStage(group));
  }
  this->StageCount = last + 1;
}

int GroupStages::GetStage(int group) const
{
  int rest = group % this->Stride;
  if (this->Stride == 1 || rest == this->Stride / 2)
  {
    return 0;
  }
  if (rest == 0)
  {
    return 1;
  }
  int twos = 0;
  while (rest % 2 == 0)
  {
    rest /= 2;
    ++twos;
  }
  // The last half of all groups in two stages, so that little is coded on what is known of others.
  return this->Levels - twos + (twos == 0 && group % 4 == 3 ? 1 : 0);
}

std::vector<int> GroupStages::GetGroups(int stage) const
{
  std::vector<int> groups;
  for (int group = 0; group < this->Count; ++group)
  {
    if (this->GetStage(group) == stage)
    {
      groups.push_back(group);
    }
  }
  return groups;
}
}
