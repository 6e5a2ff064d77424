// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Resampling/cslfNesting.h"

#include "cslfJSONText.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cslf
{
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
