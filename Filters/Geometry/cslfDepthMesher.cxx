// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDepthMesher.h"

#include "Pipeline/cslfParallelFor.h"
#include "cslfDepthSurfaces.h"
#include "cslfDepthTile.h"
#include "cslfTilePatch.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
/// How far the surface may move when a patch is simplified, in texels at the cube's centre.
constexpr double MaximumTexels = 0.2;

/// The mesh explains a texel if it is as near as this to its surface, in texels at the cube's
/// centre.
constexpr double ExplainedTexels = 0.5;

/// Another viewpoint sees a point if it sees something as near as this to its plane, in texels at
/// the cube's centre.
constexpr double SeenTexels = 1.0;

/// Texels are good enough if they cover an area of at most the first number, in texels at the
/// cube's centre, and see the surface under at least the second one, as a cosine.
constexpr double GoodArea = 8.0;
constexpr double GoodCosine = 0.2;

/// Another texel is left to a later viewpoint whose texel covers less than this share of its area
/// there.
constexpr double BetterShare = 0.5;

/// The viewpoints that may be so, in the order of their turn.
constexpr int MaximumBetterViews = 150;

/// Groups of up to so many texels are not worth triangles where the mesh has their surface beside
/// them.
constexpr std::size_t MaximumSpeckTexels = 8;

/// The viewpoints that look at the same time.
constexpr int BatchSize = FaceCount;

/// The most triangles before the mesh is reduced.
constexpr std::size_t MaximumCollected = std::size_t(4) << 20;

/// The views in the order of their turn: one of each face after the other, each as far as possible
/// from those before it and from the edges of the face.
std::vector<int> OrderViews(const DepthViews& views)
{
  const Layout& grid = views.GetGrid();
  std::array<std::vector<int>, FaceCount> rest;
  for (int view = 0; view < views.GetCount(); ++view)
  {
    rest[grid.ViewpointOf(views.GetSlice(view)).Face].push_back(view);
  }
  const auto findPlace = [&](int view)
  {
    const Viewpoint viewpoint = grid.ViewpointOf(views.GetSlice(view));
    return glm::dvec2(grid.NodeCoordinate(viewpoint.I), grid.NodeCoordinate(viewpoint.J));
  };
  std::array<std::vector<int>, FaceCount> chosen;
  std::vector<double> distances(views.GetCount());
  for (int face = 0; face < FaceCount; ++face)
  {
    for (const int view : rest[face])
    {
      const glm::dvec2 place = glm::abs(findPlace(view));
      distances[view] = 1.25 - std::max(place.x, place.y);
    }
    while (!rest[face].empty())
    {
      const auto next = std::max_element(rest[face].begin(), rest[face].end(),
        [&](int a, int b) { return distances[a] < distances[b]; });
      chosen[face].push_back(*next);
      rest[face].erase(next);
      for (const int view : rest[face])
      {
        distances[view] =
          std::min(distances[view], glm::distance(findPlace(view), findPlace(chosen[face].back())));
      }
    }
  }
  std::vector<int> order;
  for (std::size_t k = 0; order.size() < distances.size(); ++k)
  {
    for (const std::vector<int>& onFace : chosen)
    {
      if (k < onFace.size())
      {
        order.push_back(onFace[k]);
      }
    }
  }
  return order;
}

/// What the mesh so far looks like in one tile, and which texels it lacks.
class TileNeeds
{
public:
  TileNeeds(const DepthViews& views, const DepthSurfaces& surfaces, const std::vector<float>& drawn)
    : Surfaces(surfaces)
    , Drawn(drawn)
    , Scale(views.GetScale())
    , Texel(views.GetTexel())
    , Last(surfaces.GetResolution() - 1)
  {
  }

  /// Whether a texel's surface is not in the mesh.
  bool IsMissing(int x, int y) const
  {
    const std::size_t texel = this->Surfaces.IndexOf(x, y);
    if (!this->Surfaces.IsSurface(texel) || this->IsNear(x, y, texel, 0, 0))
    {
      return false;
    }
    if (this->IsHiddenByNeighbour(x, y, texel))
    {
      return false;
    }
    if (this->Surfaces.IsInside(x, y))
    {
      return true;
    }
    // Outlines may lie up to a texel from where this viewpoint sees them.
    for (int k = 0; k < 9; ++k)
    {
      if (this->IsNear(x, y, texel, k % 3 - 1, k / 3 - 1))
      {
        return false;
      }
    }
    return true;
  }

private:
  /// Whether the mesh in a texel lies on the surface of a texel next to it.
  bool IsNear(int x, int y, std::size_t texel, int stepX, int stepY) const
  {
    if (x + stepX < 0 || y + stepY < 0 || x + stepX > this->Last || y + stepY > this->Last)
    {
      return false;
    }
    const float drawn = this->Drawn[this->Surfaces.IndexOf(x + stepX, y + stepY)];
    const double expected = this->Surfaces.GetInverseDepth(texel) +
      glm::dot(this->Surfaces.GetSlope(texel), glm::vec2(stepX, stepY));
    const double length = glm::length(this->Surfaces.GetNormal(x, y) / this->Scale);
    return drawn > 0.0f && expected > 0.0 &&
      std::abs(drawn / expected - 1.0) <= ExplainedTexels * this->Texel * length;
  }

  /// Whether the mesh is in front of a texel's surface, but is that of a texel near it.
  bool IsHiddenByNeighbour(int x, int y, std::size_t texel) const
  {
    const float drawn = this->Drawn[texel];
    if (drawn <= this->Surfaces.GetInverseDepth(texel))
    {
      return false;
    }
    for (int row = std::max(y - 2, 0); row <= std::min(y + 2, this->Last); ++row)
    {
      for (int column = std::max(x - 2, 0); column <= std::min(x + 2, this->Last); ++column)
      {
        const std::size_t other = this->Surfaces.IndexOf(column, row);
        const double length = glm::length(this->Surfaces.GetNormal(column, row) / this->Scale);
        if (other != texel && this->Surfaces.IsSurface(other) &&
          std::abs(drawn / this->Surfaces.GetInverseDepth(other) - 1.0) <=
            3.0 * this->Texel * length)
        {
          return true;
        }
      }
    }
    return false;
  }

  const DepthSurfaces& Surfaces;
  const std::vector<float>& Drawn;
  glm::dvec3 Scale;
  double Texel;
  int Last;
};

/// Adds texels of the same surface beside marked ones, in rows or columns.
void AddBeside(const DepthSurfaces& surfaces, std::vector<char>& marks)
{
  const int side = surfaces.GetResolution();
  const std::vector<char> before = marks;
  for (int y = 0; y < side; ++y)
  {
    for (int x = 0; x < side; ++x)
    {
      const std::size_t texel = surfaces.IndexOf(x, y);
      const auto join = [&](std::size_t other, bool isLinked)
      {
        if (isLinked && before[texel] != before[other])
        {
          marks[texel] = marks[other] = 1;
        }
      };
      if (x + 1 < side)
      {
        join(texel + 1, surfaces.IsLinkedRight(texel));
      }
      if (y + 1 < side)
      {
        join(texel + side, surfaces.IsLinkedDown(texel));
      }
    }
  }
}

/// Unmarks small groups of marked texels of a surface that the mesh has around them.
void DropSpecks(const DepthSurfaces& surfaces, std::vector<char>& marks)
{
  const int side = surfaces.GetResolution();
  std::vector<char> isReached(marks.size(), 0);
  std::vector<std::size_t> group;
  for (std::size_t start = 0; start < marks.size(); ++start)
  {
    if (marks[start] == 0 || isReached[start] != 0)
    {
      continue;
    }
    group.assign(1, start);
    isReached[start] = 1;
    bool isBesideMesh = false;
    for (std::size_t k = 0; k < group.size(); ++k)
    {
      const std::size_t texel = group[k];
      const auto reach = [&](std::size_t other, bool isLinked)
      {
        if (!isLinked)
        {
          return;
        }
        if (marks[other] == 0)
        {
          isBesideMesh = true;
        }
        else if (isReached[other] == 0)
        {
          isReached[other] = 1;
          group.push_back(other);
        }
      };
      const int x = static_cast<int>(texel % side);
      const int y = static_cast<int>(texel / side);
      reach(x > 0 ? texel - 1 : texel, x > 0 && surfaces.IsLinkedRight(texel - 1));
      reach(x + 1 < side ? texel + 1 : texel, x + 1 < side && surfaces.IsLinkedRight(texel));
      reach(y > 0 ? texel - side : texel, y > 0 && surfaces.IsLinkedDown(texel - side));
      reach(y + 1 < side ? texel + side : texel, y + 1 < side && surfaces.IsLinkedDown(texel));
    }
    if (isBesideMesh && group.size() <= MaximumSpeckTexels)
    {
      for (const std::size_t texel : group)
      {
        marks[texel] = 0;
      }
    }
  }
}

class Mesher
{
public:
  explicit Mesher(const DepthViews& views)
    : Views(views)
    , Order(OrderViews(views))
  {
  }

  int CountBatches() const
  {
    return (static_cast<int>(this->Order.size()) + BatchSize - 1) / BatchSize;
  }

  void LookFromBatch(int batch, const Progress& progress)
  {
    const int first = batch * BatchSize;
    const int count = std::min(BatchSize, static_cast<int>(this->Order.size()) - first);
    std::vector<SurfaceMesh> meshes(static_cast<std::size_t>(count) * TileCount);
    ParallelFor(0, static_cast<vtkIdType>(meshes.size()), OrAbort(progress),
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType k = begin; k < end; ++k)
        {
          meshes[k] = this->Look(first + static_cast<int>(k) / TileCount, first + count,
            static_cast<int>(k) % TileCount);
        }
      });
    for (const SurfaceMesh& mesh : meshes)
    {
      if (!mesh.Triangles.empty() && !this->IsFull())
      {
        this->Add(mesh);
      }
    }
  }

  bool IsFull() const { return this->Result.Triangles.size() >= MaximumCollected; }

  SurfaceMesh TakeResult() { return std::move(this->Result); }

private:
  void Add(const SurfaceMesh& mesh)
  {
    std::vector<glm::dvec3> points;
    std::vector<unsigned int> corners;
    points.reserve(mesh.Points.size());
    corners.reserve(3 * mesh.Triangles.size());
    for (const glm::vec3& point : mesh.Points)
    {
      points.push_back(glm::dvec3(point) / this->Views.GetScale());
    }
    const auto start = static_cast<unsigned int>(this->Result.Points.size());
    for (const glm::uvec3& triangle : mesh.Triangles)
    {
      corners.insert(corners.end(), { triangle.x, triangle.y, triangle.z });
      this->Result.Triangles.push_back(triangle + start);
    }
    this->Result.Points.insert(this->Result.Points.end(), mesh.Points.begin(), mesh.Points.end());
    this->Patches.emplace_back(std::move(points), std::move(corners));
  }

  /// Makes triangles for a tile of the view whose turn it is, the number `turn`. The present batch
  /// ends before `batchEnd`.
  SurfaceMesh Look(int turn, int batchEnd, int tile) const
  {
    const int view = this->Order[turn];
    DepthTile drawn(this->Views.GetGrid(), this->Views.GetSlice(view), tile);
    if (!drawn.HasRays())
    {
      return {};
    }
    const DepthSurfaces surfaces(this->Views, view, tile);
    const std::atomic<bool> isStopped{ false };
    for (const DrawnTriangles& patch : this->Patches)
    {
      drawn.Draw(patch, isStopped);
    }
    const TileNeeds needs(this->Views, surfaces, drawn.GetInverseDepths());
    const int side = surfaces.GetResolution();
    std::vector<char> marks(static_cast<std::size_t>(side) * side, 0);
    bool isNeeded = false;
    for (int y = 0; y < side; ++y)
    {
      for (int x = 0; x < side; ++x)
      {
        if (needs.IsMissing(x, y) && !this->IsLeft(turn, batchEnd, surfaces, x, y))
        {
          marks[surfaces.IndexOf(x, y)] = 1;
          isNeeded = true;
        }
      }
    }
    if (!isNeeded)
    {
      return {};
    }
    DropSpecks(surfaces, marks);
    if (std::find(marks.begin(), marks.end(), 1) == marks.end())
    {
      return {};
    }
    AddBeside(surfaces, marks);
    AddBeside(surfaces, marks);
    SurfaceMesh mesh = MakePatch(this->Views, view, surfaces, marks);
    Weld(mesh);
    Simplify(mesh, static_cast<float>(MaximumTexels * this->Views.GetTexel()));
    return mesh;
  }

  /// Whether a texel's surface is left to another view, which sees it better.
  bool IsLeft(int turn, int batchEnd, const DepthSurfaces& surfaces, int x, int y) const
  {
    const SurfacePlane plane = surfaces.GetPlane(x, y);
    const double distance = SeenTexels * this->Views.GetTexel();
    const TileFrame& frame = surfaces.GetFrame();
    const double inverse = surfaces.GetInverseDepth(surfaces.IndexOf(x, y));
    const double footprint = this->Views.FindFootprint(frame, plane.Normal, inverse);
    const glm::dvec3 ray = frame.VectorToCube(frame.GetRay(x, y)) * this->Views.GetScale();
    const double cosine =
      inverse / (glm::length(plane.Normal / this->Views.GetScale()) * glm::length(ray));
    const double texel = this->Views.GetTexel();
    const bool isGood = cosine >= GoodCosine && footprint <= GoodArea * texel * texel;
    const int batchBegin = batchEnd - 1 - (batchEnd - 1) % BatchSize;
    const int end =
      isGood ? batchEnd : std::max(batchEnd, std::min<int>(MaximumBetterViews, this->Order.size()));
    for (int other = batchBegin; other < end; ++other)
    {
      if (other == turn)
      {
        continue;
      }
      const PlaneSight sight = this->Views.See(this->Order[other], plane, distance);
      // Within a batch, one of the views keeps it, unless rounded depths let each prefer another.
      const bool isBetter = other < batchEnd
        ? sight.Footprint < footprint || (sight.Footprint == footprint && other < turn)
        : sight.Footprint < BetterShare * footprint;
      if (sight.IsSeen && isBetter)
      {
        return true;
      }
    }
    return false;
  }

  const DepthViews& Views;
  std::vector<int> Order;
  std::vector<DrawnTriangles> Patches;
  SurfaceMesh Result;
};
}

SurfaceMesh MeshDepths(const DepthViews& views, const Progress& progress)
{
  Mesher mesher(views);
  const int count = mesher.CountBatches();
  for (int batch = 0; batch < count && !mesher.IsFull(); ++batch)
  {
    mesher.LookFromBatch(batch, Within(progress, double(batch) / count, (batch + 1.0) / count));
  }
  SurfaceMesh mesh = mesher.TakeResult();
  ChangeApart(mesh, Within(progress, 1.0, 1.0), Weld);
  return mesh;
}

std::vector<glm::vec3> SpreadPoints(const DepthViews& views, std::size_t count)
{
  const Layout& grid = views.GetGrid();
  const int side = grid.GetResolution();
  const auto visit = [&](const auto& function)
  {
    for (int view = 0; view < views.GetCount(); ++view)
    {
      for (int tile = 0; tile < TileCount; ++tile)
      {
        for (int k = 0; k < side * side; ++k)
        {
          const float inverse = views.GetInverseDepth(view, tile, k % side, k / side);
          if (inverse > 0.0f)
          {
            function(view, tile, k, inverse);
          }
        }
      }
    }
  };
  std::size_t all = 0;
  visit([&all](int, int, int, float) { ++all; });
  const std::size_t step = std::max<std::size_t>(1, (all + count - 1) / count);
  std::vector<glm::vec3> points;
  std::size_t number = step / 2;
  visit(
    [&](int view, int tile, int k, float inverse)
    {
      if (++number < step)
      {
        return;
      }
      number = 0;
      const TileFrame frame(grid, views.GetSlice(view), tile);
      const glm::dvec3 ray = frame.VectorToCube(frame.GetRay(k % side, k / side));
      points.emplace_back(views.GetScale() * (frame.From + ray / static_cast<double>(inverse)));
    });
  return points;
}
}
