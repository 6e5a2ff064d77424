// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which points of the surface are next to each other.
 */
#ifndef cslfPointGraph_h
#define cslfPointGraph_h

#include "vtkCSLFModule.h" // for export macro

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT PointGraph
{
public:
  /// Two different points.
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  /// No points.
  PointGraph() = default;

  /// Edges may occur several times and in both directions.
  PointGraph(std::size_t points, const std::vector<Edge>& edges);

  std::size_t GetNumberOfPoints() const { return this->Ends.size(); }

  ///@{
  /// The neighbours of a point.
  const std::uint32_t* Begin(std::size_t point) const
  {
    return this->Neighbours.data() + (point > 0 ? this->Ends[point - 1] : 0);
  }
  const std::uint32_t* End(std::size_t point) const
  {
    return this->Neighbours.data() + this->Ends[point];
  }
  std::size_t GetNumberOfNeighbours(std::size_t point) const
  {
    return static_cast<std::size_t>(this->End(point) - this->Begin(point));
  }
  ///@}

private:
  std::vector<std::size_t> Ends; // of the points' parts of the list
  std::vector<std::uint32_t> Neighbours;
};
}

#endif
