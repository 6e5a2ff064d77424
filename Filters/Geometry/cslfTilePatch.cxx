// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTilePatch.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
constexpr std::uint32_t None = 0xFFFFFFFFu;

/// How far squares reach beyond the tile, in texels, so that they overlap with those of the next
/// tile.
constexpr float TileOverlap = 0.2f;

/// The number of times that outlines of surfaces and other outlines of patches are smoothed.
constexpr int Smoothings = 3;
constexpr int PatchSmoothings = 12;

/// Where outlines may be, from the corners of their texels, 1, to the middle of the texels, 0.
constexpr float OutlinePlaces[] = { 1.0f, 0.75f, 0.5f, 0.25f };

/// The most viewpoints that are asked where an outline is.
constexpr int MaximumWitnesses = 250;

/// The distance, in texels at the cube's centre, from which on something counts as behind outlines.
constexpr double BehindTexels = 3.0;

/// How much the inverse depth of a corner may differ from that of its texels, as a factor.
constexpr float MaximumChange = 1.5f;

/// A corner of squares, in texels.
struct Corner
{
  glm::vec2 Place;
  float InverseDepth = 0.0f;
  glm::vec2 Slope;
  glm::vec2 Middle;                         ///< of the texels around it
  bool IsOutline = false;                   ///< of the surface, as the viewpoint sees it
  bool IsPinned = false;                    ///< on an edge of the tile
  std::uint32_t Beside[2] = { None, None }; ///< the next corners along the patch's outline
  int Outlines = 0; ///< the number of sides of the patch's outline that meet here

  void SetPlace(const glm::vec2& place)
  {
    this->InverseDepth += glm::dot(this->Slope, place - this->Place);
    this->Place = place;
  }
};

class PatchMaker
{
public:
  PatchMaker(const DepthViews& views, int view, const DepthSurfaces& surfaces,
    const std::vector<char>& marks)
    : Views(views)
    , View(view)
    , Surfaces(surfaces)
    , Marks(marks)
    , Side(surfaces.GetResolution())
  {
  }

  SurfaceMesh Make()
  {
    this->MakeCorners();
    this->FindOutlines();
    this->Smooth();
    this->DrawBack();
    return this->MakeMesh();
  }

private:
  /// The texels around a corner of the grid, from the top left, row by row. -1 beyond the tile.
  std::array<int, 4> FindTexels(int x, int y) const
  {
    std::array<int, 4> texels;
    for (int k = 0; k < 4; ++k)
    {
      const int column = x - 1 + k % 2;
      const int row = y - 1 + k / 2;
      const bool isThere = column >= 0 && row >= 0 && column < this->Side && row < this->Side;
      texels[k] = isThere ? static_cast<int>(this->Surfaces.IndexOf(column, row)) : -1;
    }
    return texels;
  }

  /// Numbers the surfaces of the four texels around a corner.
  std::array<int, 4> FindGroups(const std::array<int, 4>& texels) const
  {
    std::array<int, 4> groups = { 0, 1, 2, 3 };
    const auto join = [&groups](int a, int b)
    {
      const int from = std::max(groups[a], groups[b]);
      const int to = std::min(groups[a], groups[b]);
      std::replace(groups.begin(), groups.end(), from, to);
    };
    const bool links[4] = { texels[0] >= 0 && texels[1] >= 0 &&
        this->Surfaces.IsLinkedRight(texels[0]),
      texels[2] >= 0 && texels[3] >= 0 && this->Surfaces.IsLinkedRight(texels[2]),
      texels[0] >= 0 && texels[2] >= 0 && this->Surfaces.IsLinkedDown(texels[0]),
      texels[1] >= 0 && texels[3] >= 0 && this->Surfaces.IsLinkedDown(texels[1]) };
    constexpr int ends[4][2] = { { 0, 1 }, { 2, 3 }, { 0, 2 }, { 1, 3 } };
    for (int k = 0; k < 4; ++k)
    {
      if (links[k])
      {
        join(ends[k][0], ends[k][1]);
      }
    }
    return groups;
  }

  void MakeCorners()
  {
    this->CornersOf.assign(this->Marks.size(), { None, None, None, None });
    for (int y = 0; y <= this->Side; ++y)
    {
      for (int x = 0; x <= this->Side; ++x)
      {
        const std::array<int, 4> texels = this->FindTexels(x, y);
        const auto isMarked = [this](int texel) { return texel >= 0 && this->Marks[texel] != 0; };
        if (std::any_of(texels.begin(), texels.end(), isMarked))
        {
          this->MakeCorners(x, y, texels);
        }
      }
    }
  }

  /// Makes the corners of the marked texels around a corner of the grid, one for each surface.
  void MakeCorners(int x, int y, const std::array<int, 4>& texels)
  {
    const std::array<int, 4> groups = this->FindGroups(texels);
    for (int group = 0; group < 4; ++group)
    {
      Corner corner;
      corner.Place = { static_cast<float>(x) - 0.5f, static_cast<float>(y) - 0.5f };
      corner.IsPinned = x == 0 || y == 0 || x == this->Side || y == this->Side;
      corner.Slope = corner.Middle = glm::vec2(0.0f);
      float least = std::numeric_limits<float>::max();
      float most = 0.0f;
      int count = 0;
      bool isUsed = false;
      for (int k = 0; k < 4; ++k)
      {
        if (groups[k] != group || texels[k] < 0 || !this->Surfaces.IsSurface(texels[k]))
        {
          continue;
        }
        const glm::vec2 center(x - 1 + k % 2, y - 1 + k / 2);
        const glm::vec2& slope = this->Surfaces.GetSlope(texels[k]);
        const float inverse = this->Surfaces.GetInverseDepth(texels[k]);
        corner.InverseDepth += inverse + glm::dot(slope, corner.Place - center);
        corner.Slope += slope;
        corner.Middle += center;
        least = std::min(least, inverse);
        most = std::max(most, inverse);
        isUsed = isUsed || this->Marks[texels[k]] != 0;
        ++count;
      }
      if (!isUsed)
      {
        continue;
      }
      const float share = 1.0f / static_cast<float>(count);
      corner.Slope *= share;
      corner.Middle *= share;
      corner.InverseDepth =
        glm::clamp(corner.InverseDepth * share, least / MaximumChange, most * MaximumChange);
      corner.IsOutline = count < 4 && !corner.IsPinned;
      for (int k = 0; k < 4; ++k)
      {
        if (groups[k] == group && texels[k] >= 0 && this->Marks[texels[k]] != 0)
        {
          // This corner lies opposite to the texel's place around it.
          this->CornersOf[texels[k]][3 - k] = static_cast<std::uint32_t>(this->Corners.size());
        }
      }
      this->Corners.push_back(corner);
    }
  }

  /// Finds the sides of squares that belong to one square only.
  void FindOutlines()
  {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sides;
    constexpr int ends[4][2] = { { 0, 1 }, { 1, 3 }, { 3, 2 }, { 2, 0 } };
    for (std::size_t texel = 0; texel < this->Marks.size(); ++texel)
    {
      for (int k = 0; this->Marks[texel] != 0 && k < 4; ++k)
      {
        const std::uint32_t a = this->CornersOf[texel][ends[k][0]];
        const std::uint32_t b = this->CornersOf[texel][ends[k][1]];
        sides.emplace_back(std::min(a, b), std::max(a, b));
      }
    }
    std::sort(sides.begin(), sides.end());
    for (std::size_t k = 0; k < sides.size(); ++k)
    {
      const bool isShared =
        (k > 0 && sides[k - 1] == sides[k]) || (k + 1 < sides.size() && sides[k + 1] == sides[k]);
      if (!isShared)
      {
        this->AddOutline(sides[k].first, sides[k].second);
        this->AddOutline(sides[k].second, sides[k].first);
      }
    }
  }

  void AddOutline(std::uint32_t from, std::uint32_t to)
  {
    Corner& corner = this->Corners[from];
    if (corner.Outlines < 2)
    {
      corner.Beside[corner.Outlines] = to;
    }
    ++corner.Outlines;
  }

  /// Smoothes outlines, which are stairs at first.
  void Smooth()
  {
    std::vector<glm::vec2> places(this->Corners.size());
    for (int k = 0; k < PatchSmoothings; ++k)
    {
      for (std::size_t i = 0; i < this->Corners.size(); ++i)
      {
        const Corner& corner = this->Corners[i];
        const bool isMoved =
          corner.Outlines == 2 && !corner.IsPinned && (k < Smoothings || !corner.IsOutline);
        places[i] = isMoved ? 0.5f * corner.Place +
            0.25f * (this->Corners[corner.Beside[0]].Place + this->Corners[corner.Beside[1]].Place)
                            : corner.Place;
      }
      for (std::size_t i = 0; i < this->Corners.size(); ++i)
      {
        this->Corners[i].SetPlace(places[i]);
      }
    }
  }

  /// Draws the outlines of surfaces back to where no viewpoint sees through them.
  void DrawBack()
  {
    const double distance = BehindTexels * this->Views.GetTexel();
    for (Corner& corner : this->Corners)
    {
      if (!corner.IsOutline)
      {
        continue;
      }
      const Corner whole = corner;
      for (const float place : OutlinePlaces)
      {
        corner = whole;
        corner.SetPlace(glm::mix(whole.Middle, whole.Place, place));
        if (!this->IsSeenThrough(this->GetPoint(corner), distance))
        {
          break;
        }
      }
    }
  }

  bool IsSeenThrough(const glm::dvec3& point, double distance) const
  {
    const int step = (this->Views.GetCount() + MaximumWitnesses - 1) / MaximumWitnesses;
    for (int view = 0; view < this->Views.GetCount(); view += step)
    {
      if (view != this->View && this->Views.SeesThrough(view, point, distance))
      {
        return true;
      }
    }
    return false;
  }

  /// In CC.
  glm::dvec3 GetPoint(const Corner& corner) const
  {
    const TileFrame& frame = this->Surfaces.GetFrame();
    glm::vec2 place = corner.Place;
    if (corner.IsPinned)
    {
      const float last = static_cast<float>(this->Side) - 0.75f;
      for (int axis = 0; axis < 2; ++axis)
      {
        place[axis] += place[axis] < -0.25f ? -TileOverlap
          : place[axis] > last              ? TileOverlap
                                            : 0.0f;
      }
    }
    const double inverse = std::max(
      1.0, static_cast<double>(corner.InverseDepth) + glm::dot(corner.Slope, place - corner.Place));
    return glm::clamp(frame.From + frame.VectorToCube(frame.GetRay(place.x, place.y)) / inverse,
      glm::dvec3(-1.0), glm::dvec3(1.0));
  }

  SurfaceMesh MakeMesh() const
  {
    SurfaceMesh mesh;
    mesh.Points.reserve(this->Corners.size());
    for (const Corner& corner : this->Corners)
    {
      mesh.Points.emplace_back(this->Views.GetScale() * this->GetPoint(corner));
    }
    // Counterclockwise as seen from the viewpoint, which is on the side of the negative z axis.
    const TileFrame& frame = this->Surfaces.GetFrame();
    const bool isTurned = glm::dot(glm::cross(frame.AxisX, frame.AxisY), frame.AxisZ) > 0.0;
    for (std::size_t texel = 0; texel < this->Marks.size(); ++texel)
    {
      if (this->Marks[texel] == 0)
      {
        continue;
      }
      const std::array<std::uint32_t, 4>& corners = this->CornersOf[texel];
      const auto getStep = [this, &corners](int a, int b)
      {
        return std::abs(
          this->Corners[corners[a]].InverseDepth - this->Corners[corners[b]].InverseDepth);
      };
      glm::uvec3 triangles[2] = { { corners[0], corners[1], corners[2] },
        { corners[1], corners[3], corners[2] } };
      if (getStep(0, 3) < getStep(1, 2))
      {
        triangles[0] = { corners[0], corners[1], corners[3] };
        triangles[1] = { corners[0], corners[3], corners[2] };
      }
      for (glm::uvec3& triangle : triangles)
      {
        if (isTurned)
        {
          std::swap(triangle.y, triangle.z);
        }
        mesh.Triangles.push_back(triangle);
      }
    }
    return mesh;
  }

  const DepthViews& Views;
  int View;
  const DepthSurfaces& Surfaces;
  const std::vector<char>& Marks;
  int Side;
  std::vector<Corner> Corners;
  std::vector<std::array<std::uint32_t, 4>> CornersOf; ///< of each texel, row by row
};
}

SurfaceMesh MakePatch(
  const DepthViews& views, int view, const DepthSurfaces& surfaces, const std::vector<char>& marks)
{
  return PatchMaker(views, view, surfaces, marks).Make();
}
}
