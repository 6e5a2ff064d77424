// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The edges of a mesh's triangles, by which neighbours are found, and the closed bodies that they
 * tell.
 */
#ifndef cslfMeshEdges_h
#define cslfMeshEdges_h

#include "PathTracing/Shapes/cslfMesh.h"
#include "cslfLayoutProgress.h"
#include "vtkCSLFModule.h" // for export macro

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace cslf
{
/// A number for a cell of space, given by integers, that depends on a seed, too.
std::uint64_t HashCell(const glm::vec3& cell, std::uint64_t seed);

/// Of each mesh, for each vertex.
using VertexClusters = std::vector<std::vector<std::uint32_t>>;

/// For each vertex of a mesh, the first vertex in the same cube of an edge length, whose normal has
/// a similar direction. Vertices that have no normal stand alone. Empty if the mesh has no normals.
VTKCSLF_EXPORT std::vector<std::uint32_t> FindVertexClusters(
  const Mesh& mesh, float edge, const LayoutProgress& progress = LayoutProgress());

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

/// For each triangle of a mesh 1 for the front or 2 for the back, if that side faces the inside of
/// a body that the mesh closes by itself; else 0. Vertices at the same place count as one. A body
/// is closed if each edge belongs to two triangles that run along it in opposite directions.
std::vector<std::uint8_t> FindInsides(
  const Mesh& mesh, const LayoutProgress& progress = LayoutProgress());
}

#endif
