// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfClosedParts.h"

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace cslf
{
namespace
{
using Numbers = std::vector<std::uint32_t>;

/// The corners as numbers of places: the first point there, in the order of coordinates.
Numbers FindPlaces(const std::vector<glm::vec3>& points, const Numbers& corners)
{
  const auto getKey = [&](std::uint32_t point)
  { return std::make_tuple(points[point].x, points[point].y, points[point].z); };
  Numbers order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return getKey(a) < getKey(b); });
  Numbers places(points.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    const bool isSame = rank > 0 && points[order[rank]] == points[order[rank - 1]];
    places[order[rank]] = isSame ? places[order[rank - 1]] : order[rank];
  }
  Numbers found(corners.size());
  std::transform(corners.begin(), corners.end(), found.begin(),
    [&](std::uint32_t corner) { return places[corner]; });
  return found;
}

/// The first place of the part that a place belongs to. Shortens the way there.
std::uint32_t FindPart(Numbers& parts, std::uint32_t place)
{
  while (parts[place] != place)
  {
    parts[place] = parts[parts[place]];
    place = parts[place];
  }
  return place;
}

/// The part of each place: what triangles connect.
Numbers FindParts(const Numbers& places, std::size_t count)
{
  Numbers parts(count);
  std::iota(parts.begin(), parts.end(), 0U);
  for (std::size_t corner = 0; corner < places.size(); ++corner)
  {
    const std::uint32_t one = FindPart(parts, places[corner - corner % 3]);
    const std::uint32_t other = FindPart(parts, places[corner]);
    parts[std::max(one, other)] = std::min(one, other);
  }
  for (std::uint32_t place = 0; place < count; ++place)
  {
    parts[place] = FindPart(parts, place);
  }
  return parts;
}

/// Which parts are closed: along each of their edges run as many triangles in one direction as in
/// the other.
std::vector<bool> FindClosed(const Numbers& places, const Numbers& parts)
{
  using Edge = std::pair<std::array<std::uint32_t, 2>, int>; // with the direction, 1 or -1
  std::vector<Edge> edges(places.size());
  for (std::size_t corner = 0; corner < places.size(); ++corner)
  {
    const std::uint32_t from = places[corner];
    const std::uint32_t to = places[corner % 3 == 2 ? corner - 2 : corner + 1];
    edges[corner] = { { std::min(from, to), std::max(from, to) },
      from == to    ? 0
        : from < to ? 1
                    : -1 };
  }
  std::sort(edges.begin(), edges.end());
  std::vector<bool> closed(parts.size(), true);
  for (auto edge = edges.begin(); edge != edges.end();)
  {
    const auto ends = edge->first;
    int balance = 0;
    for (; edge != edges.end() && edge->first == ends; ++edge)
    {
      balance += edge->second;
    }
    if (balance != 0)
    {
      closed[parts[ends[0]]] = false;
    }
  }
  return closed;
}
}

ClosedParts SortClosedParts(const std::vector<glm::vec3>& points, Numbers& corners)
{
  const Numbers places = FindPlaces(points, corners);
  const Numbers parts = FindParts(places, points.size());
  const std::vector<bool> closed = FindClosed(places, parts);
  const std::size_t triangles = corners.size() / 3;
  const auto getPoint = [&](std::size_t triangle, int corner)
  { return glm::dvec3(points[corners[3 * triangle + corner]]); };
  std::vector<double> volumes(points.size(), 0.0);
  for (std::size_t triangle = 0; triangle < triangles; ++triangle)
  {
    volumes[parts[places[3 * triangle]]] +=
      glm::dot(getPoint(triangle, 0), glm::cross(getPoint(triangle, 1), getPoint(triangle, 2)));
  }
  ClosedParts result;
  result.IsTurned.assign(points.size(), false);
  Numbers sorted;
  Numbers open;
  for (std::size_t triangle = 0; triangle < triangles; ++triangle)
  {
    const std::uint32_t part = parts[places[3 * triangle]];
    const bool isInsideOut = closed[part] && volumes[part] < 0.0;
    Numbers& target = closed[part] ? sorted : open;
    for (const int corner :
      isInsideOut ? std::array<int, 3>{ 0, 2, 1 } : std::array<int, 3>{ 0, 1, 2 })
    {
      const std::uint32_t point = corners[3 * triangle + corner];
      target.push_back(point);
      result.IsTurned[point] = isInsideOut;
    }
  }
  result.Corners = sorted.size();
  sorted.insert(sorted.end(), open.begin(), open.end());
  corners = std::move(sorted);
  return result;
}
}
