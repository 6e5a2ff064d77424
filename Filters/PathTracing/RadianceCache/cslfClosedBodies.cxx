// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfClosedBodies.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace cslf
{
namespace
{
/// One number for all vertices at the same place.
std::vector<std::uint32_t> NumberPlaces(const Mesh& mesh)
{
  const auto getKey = [&mesh](std::uint32_t vertex)
  {
    const glm::vec3& place = mesh.Vertices[vertex];
    return std::make_tuple(place.x, place.y, place.z);
  };
  std::vector<std::uint32_t> order(mesh.Vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return getKey(a) < getKey(b); });
  std::vector<std::uint32_t> numbers(order.size(), 0);
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    numbers[order[i]] = numbers[order[i - 1]] + (getKey(order[i]) != getKey(order[i - 1]) ? 1 : 0);
  }
  return numbers;
}

struct Edge
{
  std::uint32_t Low;
  std::uint32_t High;
  std::uint32_t Triangle;
  bool IsRising; // whether the triangle runs from the lower to the higher number

  bool IsAlong(const Edge& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
};

/// The edges of all triangles whose corners differ, sorted.
std::vector<Edge> SortEdges(const Mesh& mesh, const std::vector<std::uint32_t>& places)
{
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.Triangles.size());
  for (std::uint32_t triangle = 0; triangle < mesh.Triangles.size(); ++triangle)
  {
    const glm::uvec3& corners = mesh.Triangles[triangle];
    const std::uint32_t ends[3] = { places[corners.x], places[corners.y], places[corners.z] };
    if (ends[0] == ends[1] || ends[1] == ends[2] || ends[2] == ends[0])
    {
      continue;
    }
    for (int i = 0; i < 3; ++i)
    {
      const std::uint32_t from = ends[i];
      const std::uint32_t to = ends[(i + 1) % 3];
      edges.push_back({ std::min(from, to), std::max(from, to), triangle, from < to });
    }
  }
  std::sort(edges.begin(), edges.end(),
    [](const Edge& a, const Edge& b)
    { return std::tie(a.Low, a.High, a.Triangle) < std::tie(b.Low, b.High, b.Triangle); });
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

std::vector<std::uint8_t> FindInsides(const Mesh& mesh)
{
  const std::size_t count = mesh.Triangles.size();
  const std::vector<Edge> edges = SortEdges(mesh, NumberPlaces(mesh));
  Bodies bodies(count);
  std::vector<char> isClosed(count, 0);
  for (const Edge& edge : edges)
  {
    isClosed[edge.Triangle] = 1;
  }
  for (auto edge = edges.begin(); edge != edges.end();)
  {
    const auto end =
      std::find_if(edge, edges.end(), [&edge](const Edge& other) { return !edge->IsAlong(other); });
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
