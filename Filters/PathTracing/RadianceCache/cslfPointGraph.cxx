// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPointGraph.h"

#include <vtkSMPTools.h>

#include <algorithm>

namespace cslf
{
PointGraph::PointGraph(std::size_t points, const std::vector<Edge>& edges)
  : Ends(points, 0)
{
  std::vector<Edge> directed;
  directed.reserve(2 * edges.size());
  for (const Edge& edge : edges)
  {
    directed.push_back(edge);
    directed.emplace_back(edge.second, edge.first);
  }
  vtkSMPTools::Sort(directed.begin(), directed.end());
  directed.erase(std::unique(directed.begin(), directed.end()), directed.end());
  this->Neighbours.reserve(directed.size());
  for (const auto& [point, neighbour] : directed)
  {
    this->Neighbours.push_back(neighbour);
    this->Ends[point] = this->Neighbours.size();
  }
  // Points without neighbours end where the point before them does.
  for (std::size_t point = 1; point < points; ++point)
  {
    this->Ends[point] = std::max(this->Ends[point], this->Ends[point - 1]);
  }
}
}
