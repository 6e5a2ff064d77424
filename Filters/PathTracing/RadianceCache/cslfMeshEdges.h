// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The edges of a mesh's triangles, by which neighbours are found.
 */
#ifndef cslfMeshEdges_h
#define cslfMeshEdges_h

#include "PathTracing/Shapes/cslfMesh.h"
#include "cslfLayoutProgress.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

namespace cslf
{
/// Numbers of the places of vertices: vertices at the same place have the same number.
struct VertexPlaces
{
  std::vector<std::uint32_t> Numbers; ///< of each vertex
  std::uint32_t Count = 0;
};

VertexPlaces NumberPlaces(const Mesh& mesh, const LayoutProgress& progress);

struct MeshEdge
{
  std::uint32_t Low; ///< the smaller number of the places of its ends
  std::uint32_t High;
  std::uint32_t Triangle;
  bool IsRising; ///< whether the triangle runs from the lower to the higher number

  MeshEdge(std::uint32_t from, std::uint32_t to, std::uint32_t triangle)
    : Low(std::min(from, to))
    , High(std::max(from, to))
    , Triangle(triangle)
    , IsRising(from < to)
  {
  }
  bool IsAlong(const MeshEdge& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
  bool IsBefore(const MeshEdge& other) const
  {
    return std::tie(this->Low, this->High) < std::tie(other.Low, other.High);
  }
};

/// Sorts edges by their ends, and those between the same ends by their triangles, which they have
/// now. There are `places` numbers of ends.
void SortEdges(std::vector<MeshEdge>& edges, std::uint32_t places, const LayoutProgress& progress);
}

#endif
