// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfClosedBodies.h"

#include "cslfMeshEdges.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace cslf
{
namespace
{
/// The edges of all triangles whose corners differ, sorted.
std::vector<MeshEdge> FindEdges(const Mesh& mesh, const LayoutProgress& progress)
{
  const VertexPlaces places = NumberPlaces(mesh, progress);
  std::vector<MeshEdge> edges;
  edges.reserve(3 * mesh.Triangles.size());
  for (std::uint32_t triangle = 0; triangle < mesh.Triangles.size(); ++triangle)
  {
    progress.Step();
    const glm::uvec3& corners = mesh.Triangles[triangle];
    const std::uint32_t ends[3] = { places.Numbers[corners.x], places.Numbers[corners.y],
      places.Numbers[corners.z] };
    if (ends[0] == ends[1] || ends[1] == ends[2] || ends[2] == ends[0])
    {
      continue;
    }
    for (int i = 0; i < 3; ++i)
    {
      edges.emplace_back(ends[i], ends[(i + 1) % 3], triangle);
    }
  }
  SortEdges(edges, places.Count, progress);
  return edges;
}

/// Triangles that share edges, as a forest.
class Bodies
{
public:
  explicit Bodies(std::size_t triangles)
    : Parents(triangles)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0u);
  }

  std::uint32_t Find(std::uint32_t triangle)
  {
    while (this->Parents[triangle] != triangle)
    {
      this->Parents[triangle] = this->Parents[this->Parents[triangle]];
      triangle = this->Parents[triangle];
    }
    return triangle;
  }

  void Join(std::uint32_t a, std::uint32_t b) { this->Parents[this->Find(a)] = this->Find(b); }

private:
  std::vector<std::uint32_t> Parents;
};
}

std::vector<std::uint8_t> FindInsides(const Mesh& mesh, const LayoutProgress& progress)
{
  const std::size_t count = mesh.Triangles.size();
  const std::vector<MeshEdge> edges = FindEdges(mesh, progress);
  Bodies bodies(count);
  std::vector<char> isClosed(count, 0);
  for (const MeshEdge& edge : edges)
  {
    isClosed[edge.Triangle] = 1;
  }
  for (auto edge = edges.begin(); edge != edges.end();)
  {
    const auto end = std::find_if(
      edge, edges.end(), [&edge](const MeshEdge& other) { return !edge->IsAlong(other); });
    progress.Step(static_cast<std::size_t>(end - edge));
    const bool isPair = end - edge == 2 && edge->IsRising != (end - 1)->IsRising;
    for (auto other = edge; other != end; ++other)
    {
      if (!isPair)
      {
        isClosed[other->Triangle] = 0;
      }
      bodies.Join(other->Triangle, edge->Triangle);
    }
    edge = end;
  }

  // A body with one open edge is open. The sign of its volume tells on which side the inside is.
  std::vector<double> volumes(count, 0.0);
  for (std::uint32_t triangle = 0; triangle < count; ++triangle)
  {
    progress.Step();
    const glm::uvec3& corners = mesh.Triangles[triangle];
    const glm::dvec3 a(mesh.Vertices[corners.x]);
    const glm::dvec3 b(mesh.Vertices[corners.y]);
    const glm::dvec3 c(mesh.Vertices[corners.z]);
    const std::uint32_t body = bodies.Find(triangle);
    volumes[body] += glm::dot(a, glm::cross(b, c));
    isClosed[body] = isClosed[body] && isClosed[triangle] ? 1 : 0;
  }
  std::vector<std::uint8_t> sides(count, 0);
  for (std::uint32_t triangle = 0; triangle < count; ++triangle)
  {
    const std::uint32_t body = bodies.Find(triangle);
    const double volume = isClosed[body] != 0 ? volumes[body] : 0.0;
    sides[triangle] = volume > 0.0 ? 2 : volume < 0.0 ? 1 : 0;
  }
  return sides;
}
}
