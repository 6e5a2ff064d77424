// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMeshEdges.h"

#include "RandomNumbers/cslfSampleStream.h"

#include <vtkSMPTools.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>
#include <unordered_map>

namespace cslf
{
namespace
{
// The normals of a cluster differ by up to about this size in each component.
constexpr float NormalStep = 0.5f;
}

std::uint64_t HashCell(const glm::vec3& cell, std::uint64_t seed)
{
  for (int i = 0; i < 3; ++i)
  {
    seed = MixBits(seed, static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[i])));
  }
  return seed;
}

std::vector<std::uint32_t> FindVertexClusters(
  const Mesh& mesh, float edge, const LayoutProgress& progress)
{
  std::vector<std::uint32_t> clusters;
  std::unordered_map<std::uint64_t, std::uint32_t> firsts;
  for (std::uint32_t vertex = 0; vertex < mesh.Normals.size(); ++vertex)
  {
    progress.Step();
    const float length = glm::length(mesh.Normals[vertex]);
    if (!(length > 0.0f))
    {
      clusters.push_back(vertex);
      continue;
    }
    const glm::vec3 normal = glm::round(mesh.Normals[vertex] / (NormalStep * length));
    const std::uint64_t key =
      HashCell(normal, HashCell(glm::floor(mesh.Vertices[vertex] / edge), 0));
    clusters.push_back(firsts.emplace(key, vertex).first->second);
  }
  return clusters;
}

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

namespace
{
std::uint64_t HashPlace(const glm::vec3& place)
{
  std::uint32_t bits[3];
  const glm::vec3 positive = place + 0.0f; // one of the two zeros
  static_assert(sizeof(bits) == sizeof(positive), "three floats");
  std::memcpy(bits, &positive, sizeof(bits));
  return MixBits(std::uint64_t(bits[0]) << 32 | bits[1], bits[2]);
}
}

VertexPlaces NumberPlaces(const Mesh& mesh, const LayoutProgress& progress)
{
  constexpr std::uint32_t none = 0xffffffffu;
  const auto count = static_cast<std::uint32_t>(mesh.Vertices.size());
  std::size_t slots = 2;
  while (slots < 2 * std::size_t(count))
  {
    slots *= 2;
  }
  // The first vertex at each place, in the slot of its hash or the next free one.
  std::vector<std::uint32_t> firsts(slots, none);
  VertexPlaces places;
  places.Numbers.resize(count);
  for (std::uint32_t vertex = 0; vertex < count; ++vertex)
  {
    progress.Step();
    const glm::vec3& place = mesh.Vertices[vertex];
    std::size_t slot = HashPlace(place) & (slots - 1);
    while (firsts[slot] != none && mesh.Vertices[firsts[slot]] != place)
    {
      slot = (slot + 1) & (slots - 1);
    }
    if (firsts[slot] == none)
    {
      firsts[slot] = vertex;
      places.Numbers[vertex] = places.Count++;
    }
    else
    {
      places.Numbers[vertex] = places.Numbers[firsts[slot]];
    }
  }
  return places;
}

void SortEdges(std::vector<MeshEdge>& edges, std::uint32_t places, const LayoutProgress& progress)
{
  // By the lower end, by counting, and then those of each lower end, which are few.
  std::vector<std::size_t> begins(std::size_t(places) + 1, 0);
  for (const MeshEdge& edge : edges)
  {
    ++begins[edge.Low + std::size_t(1)];
  }
  for (std::size_t place = 0; place < places; ++place)
  {
    progress.Step();
    begins[place + 1] += begins[place];
  }
  std::vector<MeshEdge> sorted(edges.size(), MeshEdge(0, 0, 0));
  std::vector<std::size_t> next(begins);
  for (const MeshEdge& edge : edges)
  {
    progress.Step();
    sorted[next[edge.Low]++] = edge;
  }
  edges.swap(sorted);
  for (std::size_t place = 0; place < places; ++place)
  {
    progress.Step(begins[place + 1] - begins[place]);
    std::sort(edges.begin() + static_cast<std::ptrdiff_t>(begins[place]),
      edges.begin() + static_cast<std::ptrdiff_t>(begins[place + 1]),
      [](const MeshEdge& a, const MeshEdge& b)
      { return std::tie(a.High, a.Triangle) < std::tie(b.High, b.Triangle); });
  }
}

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
