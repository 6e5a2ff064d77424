// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Resampling/cslfKeyViews.h"

#include "cslfJSONText.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

Nesting::Nesting(const int extent[6], int divisor, int stride)
  : Viewpoints(static_cast<int>(std::lround(std::sqrt((extent[5] + 1.0) / FaceCount))))
  , Divisor(divisor)
  , Stride(stride)
{
  std::copy_n(extent, 6, this->Extent);
}

std::string Nesting::FindError() const
{
  const int* extent = this->Extent;
  const int resolution = extent[3] + 1;
  if (extent[0] != 0 || extent[2] != 0 || extent[4] < 0 || extent[5] < extent[4] ||
    resolution < 1 || extent[1] + 1.0 != 1.0 * TileCount * resolution)
  {
    return "The input is not a light field: its extent must be 5 N x N x 6 M^2.";
  }
  if (resolution % this->Divisor != 0)
  {
    return "The resolution " + std::to_string(resolution) + " cannot be divided by " +
      std::to_string(this->Divisor) + ".";
  }
  if (this->Stride == 1)
  {
    return {};
  }
  if (this->Viewpoints < 2 || extent[4] != 0 ||
    extent[5] + 1.0 != 1.0 * FaceCount * this->Viewpoints * this->Viewpoints)
  {
    return "Viewpoints can be left out only of whole light fields.";
  }
  if ((this->Viewpoints - 1) % this->Stride != 0)
  {
    return "Of " + std::to_string(this->Viewpoints) + " viewpoints a side, every " +
      std::to_string(this->Stride) + ". one would not end on the face's edge: the stride must " +
      "divide " + std::to_string(this->Viewpoints - 1) + ".";
  }
  return {};
}

void Nesting::GetWholeExtent(int extent[6]) const
{
  std::copy_n(this->Extent, 6, extent);
  extent[1] = (this->Extent[1] + 1) / this->Divisor - 1;
  extent[3] = (this->Extent[3] + 1) / this->Divisor - 1;
  if (this->Stride > 1)
  {
    extent[5] = FaceCount * this->GetKept() * this->GetKept() - 1;
  }
}

int Nesting::ToInput(int slice) const
{
  if (this->Stride == 1)
  {
    return slice;
  }
  const int kept = this->GetKept();
  const int face = slice / (kept * kept);
  const int j = slice / kept % kept;
  const int i = slice % kept;
  return (face * this->Viewpoints + j * this->Stride) * this->Viewpoints + i * this->Stride;
}

int Nesting::FindEnd(int first, int last, int limit) const
{
  const int begin = this->ToInput(first);
  int end = first;
  while (end < last && this->ToInput(end + 1) - this->ToInput(end) <= this->Stride &&
    this->ToInput(end + 1) - begin < limit)
  {
    ++end;
  }
  return end;
}

Description Nesting::Apply(const Description& input) const
{
  std::vector<int> nodes;
  for (std::size_t i = 0; i < input.Grid.GetNodes().size(); i += this->Stride)
  {
    nodes.push_back(input.Grid.GetNodes()[i]);
  }
  Description output = input;
  output.Measured.reset();
  output.Grid =
    Layout(input.Grid.GetBaseNodes(), nodes, input.Grid.GetResolution() / this->Divisor);
  auto sampling = nlohmann::json::parse(input.Sampling);
  auto& resampled = sampling["resampled"];
  if (!resampled.is_object())
  {
    resampled = nlohmann::json::object();
  }
  const auto multiply = [&resampled](const char* key, int factor)
  { resampled[key] = 1LL * factor * ToInteger(resampled, key, 1); };
  multiply("resolution_divisor", this->Divisor);
  multiply("viewpoint_stride", this->Stride);
  output.Sampling = sampling.dump();
  return output;
}
}
