// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Resampling/cslfKeyViews.h"

#include "cslfJSONText.h"

#include <algorithm>

namespace cslf
{
KeyViews::KeyViews(int viewpoints, int step)
  : Viewpoints(viewpoints)
  , Step(step)
{
  const int last = viewpoints - 1;
  int gaps = (last + step - 1) / step;
  // A symmetric list of an odd number has a middle, but the nodes 0 to an odd number have none.
  gaps += last % 2 == 1 && gaps % 2 == 0 ? 1 : 0;
  for (int gap = 0; gap <= gaps; ++gap)
  {
    // Rounded from the nearer end, so that both halves are symmetric.
    const bool isUpper = 2 * gap > gaps;
    const int fromEnd = (2 * (isUpper ? gaps - gap : gap) * last + gaps) / (2 * gaps);
    this->Indices.push_back(isUpper ? last - fromEnd : fromEnd);
  }
}

std::string KeyViews::FindError(int viewpoints, int step)
{
  return step >= 1 && step < viewpoints ? std::string()
                                        : "Of " + std::to_string(viewpoints) +
      " viewpoints a side, the step of key views must be 1 to " + std::to_string(viewpoints - 1) +
      ".";
}

int KeyViews::ToWhole(int slice) const
{
  const int kept = static_cast<int>(this->Indices.size());
  const int face = slice / (kept * kept);
  const int j = this->Indices[slice / kept % kept];
  const int i = this->Indices[slice % kept];
  return (face * this->Viewpoints + j) * this->Viewpoints + i;
}

bool KeyViews::IsKey(int wholeSlice) const
{
  const auto isKept = [this](int index)
  { return std::binary_search(this->Indices.begin(), this->Indices.end(), index); };
  return isKept(wholeSlice % this->Viewpoints) &&
    isKept(wholeSlice / this->Viewpoints % this->Viewpoints);
}

Description KeyViews::Apply(const Description& whole) const
{
  if (this->Step == 1)
  {
    return whole;
  }
  std::vector<int> nodes;
  for (int index : this->Indices)
  {
    nodes.push_back(whole.Grid.GetNodes()[index]);
  }
  Description field = whole;
  field.Grid = Layout(whole.Grid.GetBaseNodes(), nodes, whole.Grid.GetResolution());
  auto sampling = nlohmann::json::parse(whole.Sampling);
  sampling["key_view_step"] = 1LL * this->Step * ToInteger(sampling, "key_view_step", 1);
  field.Sampling = sampling.dump();
  return field;
}
}
