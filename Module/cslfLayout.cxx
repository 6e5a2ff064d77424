// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLayout.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <set>
#include <utility>

namespace cslf
{
std::vector<int> CoarsestNodes(int viewpoints)
{
  const int last = viewpoints - 1;
  const int inner = viewpoints % 2 == 1 ? last / 2 : (2 * last + 3) / 6;
  const std::set<int> nodes{ 0, inner, last - inner, last };
  return { nodes.begin(), nodes.end() };
}

Layout::Layout(int viewpoints, int resolution)
  : BaseNodes(viewpoints)
  , Nodes(std::max(viewpoints, 0))
  , Resolution(resolution)
{
  std::iota(this->Nodes.begin(), this->Nodes.end(), 0);
}

Layout::Layout(int baseNodes, std::vector<int> nodes, int resolution)
  : BaseNodes(baseNodes)
  , Nodes(std::move(nodes))
  , Resolution(resolution)
{
}

bool Layout::IsValid() const
{
  if (this->BaseNodes < 2 || this->BaseNodes > MaximumBaseNodes || this->Nodes.size() < 2 ||
    this->Nodes.size() > MaximumViewpoints || this->Resolution < 1 ||
    this->Resolution > MaximumResolution || this->Nodes.front() != 0 ||
    this->Nodes.back() != this->BaseNodes - 1)
  {
    return false;
  }
  if (std::adjacent_find(this->Nodes.begin(), this->Nodes.end(), std::greater_equal<int>()) !=
    this->Nodes.end())
  {
    return false;
  }
  for (std::size_t i = 0; i < this->Nodes.size(); ++i)
  {
    if (this->Nodes[i] + this->Nodes[this->Nodes.size() - 1 - i] != this->BaseNodes - 1)
    {
      return false;
    }
  }
  return true;
}

void Layout::GetWholeExtent(int extent[6]) const
{
  extent[0] = extent[2] = extent[4] = 0;
  extent[1] = this->GetStripWidth() - 1;
  extent[3] = this->Resolution - 1;
  extent[5] = this->GetSlices() - 1;
}

int Layout::SliceOf(const Viewpoint& viewpoint) const
{
  const int side = this->GetViewpoints();
  return (viewpoint.Face * side + viewpoint.J) * side + viewpoint.I;
}

Viewpoint Layout::ViewpointOf(int slice) const
{
  const int side = this->GetViewpoints();
  return { slice / (side * side), slice % side, slice / side % side };
}

double Layout::NodeCoordinate(int index) const
{
  return -1.0 + 2.0 * this->Nodes[index] / (this->BaseNodes - 1);
}

double Layout::TexelCoordinate(int index) const
{
  return -1.0 + 2.0 * (index + 0.5) / this->Resolution;
}

NodeBracket Layout::FindNodes(double coordinate) const
{
  const double node = 0.5 * (std::clamp(coordinate, -1.0, 1.0) + 1.0) * (this->BaseNodes - 1);
  const auto above = std::upper_bound(this->Nodes.begin() + 1, this->Nodes.end() - 1, node);
  NodeBracket bracket;
  bracket.Upper = static_cast<int>(above - this->Nodes.begin());
  bracket.Lower = bracket.Upper - 1;
  const int lowerNode = this->Nodes[bracket.Lower];
  bracket.Weight = (node - lowerNode) / (this->Nodes[bracket.Upper] - lowerNode);
  return bracket;
}

glm::dvec3 Layout::ViewpointPosition(const Viewpoint& viewpoint) const
{
  return FaceToCube(
    viewpoint.Face, { this->NodeCoordinate(viewpoint.I), this->NodeCoordinate(viewpoint.J) });
}

bool Layout::operator==(const Layout& other) const
{
  return this->BaseNodes == other.BaseNodes && this->Nodes == other.Nodes &&
    this->Resolution == other.Resolution;
}
}
