// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMeshLevels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
using Corners = std::vector<std::uint32_t>;

/// Fewer triangles are drawn fast enough, or other work takes longer.
constexpr std::size_t MinimumTriangles = 10000;

/// A level has at most this share of the triangles of the one before. If it cannot, without tearing
/// the surface or mixing colours along creases, points at one place become one; if that does not
/// suffice either, there are no more levels.
constexpr double MaximumShare = 0.75;

/// About half of the triangles, if that is possible. Points that have none would hinder it, because
/// they count as others at the same place.
Corners Halve(const std::vector<glm::vec3>& points, const Corners& corners)
{
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  Corners numbers(points.size(), none);
  Corners used;
  std::vector<glm::vec3> usedPoints;
  Corners renumbered;
  renumbered.reserve(corners.size());
  for (const std::uint32_t corner : corners)
  {
    if (numbers[corner] == none)
    {
      numbers[corner] = static_cast<std::uint32_t>(used.size());
      used.push_back(corner);
      usedPoints.push_back(points[corner]);
    }
    renumbered.push_back(numbers[corner]);
  }
  Corners halved(corners.size());
  const std::size_t wanted = corners.size() / 6 * 3;
  halved.resize(
    meshopt_simplify(halved.data(), renumbered.data(), renumbered.size(), &usedPoints.front().x,
      usedPoints.size(), sizeof(glm::vec3), wanted, std::numeric_limits<float>::max(), 0, nullptr));
  for (std::uint32_t& corner : halved)
  {
    corner = used[corner];
  }
  return halved;
}

bool IsMuchLess(const Corners& fewer, const Corners& corners)
{
  return static_cast<double>(fewer.size()) <= MaximumShare * static_cast<double>(corners.size());
}

/// Makes the corners at one place the same point.
void Join(const std::vector<glm::vec3>& points, Corners& corners)
{
  meshopt_generateShadowIndexBuffer(corners.data(), corners.data(), corners.size(), &points[0].x,
    points.size(), sizeof(glm::vec3), sizeof(glm::vec3));
}

/// Sorts triangles: those of closed parts first, each group in an order that reuses points.
/// Returns the number of corners of the former.
std::size_t Sort(const std::vector<char>& isClosed, Corners& corners)
{
  Corners closed;
  Corners open;
  for (std::size_t i = 0; i < corners.size(); i += 3)
  {
    Corners& target = isClosed[corners[i]] != 0 ? closed : open;
    target.insert(target.end(), corners.begin() + static_cast<std::ptrdiff_t>(i),
      corners.begin() + static_cast<std::ptrdiff_t>(i + 3));
  }
  corners.clear();
  for (Corners* part : { &closed, &open })
  {
    meshopt_optimizeVertexCache(part->data(), part->data(), part->size(), isClosed.size());
    corners.insert(corners.end(), part->begin(), part->end());
  }
  return closed.size();
}

MeshLevels Make(const std::vector<glm::vec3>& points, const Corners& corners,
  std::size_t closedCorners, const std::atomic<bool>& isAborted)
{
  std::vector<char> isClosed(points.size(), 0);
  for (std::size_t i = 0; i < closedCorners; ++i)
  {
    isClosed[corners[i]] = 1;
  }
  MeshLevels levels;
  Corners level = corners;
  while (!isAborted && level.size() / 3 > MinimumTriangles)
  {
    Corners next = Halve(points, level);
    if (!IsMuchLess(next, level) && !isAborted)
    {
      Join(points, level);
      next = Halve(points, level);
    }
    if (!IsMuchLess(next, level))
    {
      break;
    }
    const std::size_t closed = Sort(isClosed, next);
    const std::size_t first = levels.Corners.size();
    levels.Corners.insert(levels.Corners.end(), next.begin(), next.end());
    levels.Levels.push_back({ first, first + closed, first + next.size() });
    level = std::move(next);
  }
  return levels;
}
}

MeshLevelMaker::~MeshLevelMaker()
{
  this->IsAborted = true;
  if (this->Making.valid())
  {
    this->Making.wait();
  }
}

const MeshLevels* MeshLevelMaker::Find(
  const std::vector<glm::vec3>& points, const Corners& corners, std::size_t closedCorners)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (!this->Making.valid())
  {
    this->Making = std::async(std::launch::async,
      [&points, &corners, closedCorners, this]
      { return Make(points, corners, closedCorners, this->IsAborted); });
  }
  const bool isReady = this->Making.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  return isReady ? &this->Making.get() : nullptr;
}
}
