// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceChart.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
// Triangles that are this close, in cells, count as overlapping. It exceeds the rounding of
// look-ups.
constexpr float Touch = 1e-4f;

// A triangle can count as overlapping a bin at up to the square root of 2 times that distance, and
// this is wider by more than rounding.
constexpr float RowMargin = 4.0f * Touch;

// The smallest extent of a chart relative to the other one: a chart must have an area.
constexpr float MinimumAspect = 1e-6f;

struct Range
{
  float Low;
  float High;
};

template <int Count>
Range Project(const glm::vec2 (&points)[Count], const glm::vec2& axis)
{
  Range range{ std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest() };
  for (const glm::vec2& point : points)
  {
    const float at = glm::dot(point, axis);
    range.Low = std::min(range.Low, at);
    range.High = std::max(range.High, at);
  }
  return range;
}

/// Whether a line along an edge of polygon `a` has polygon `b` on its other side.
template <int CountA, int CountB>
bool HasSeparatingEdge(const glm::vec2 (&a)[CountA], const glm::vec2 (&b)[CountB], float margin)
{
  for (int i = 0; i < CountA; ++i)
  {
    const glm::vec2 edge = a[(i + 1) % CountA] - a[i];
    const glm::vec2 axis(-edge.y, edge.x);
    const Range rangeA = Project(a, axis);
    const Range rangeB = Project(b, axis);
    const float gap = margin * glm::length(axis);
    if (rangeA.High + gap < rangeB.Low || rangeB.High + gap < rangeA.Low)
    {
      return true;
    }
  }
  return false;
}

/// Whether two convex polygons have a point in common, or nearly so.
template <int CountA, int CountB>
bool Meet(const glm::vec2 (&a)[CountA], const glm::vec2 (&b)[CountB], float margin)
{
  return !HasSeparatingEdge(a, b, margin) && !HasSeparatingEdge(b, a, margin);
}

float Cross(const glm::vec2& a, const glm::vec2& b)
{
  return a.x * b.y - a.y * b.x;
}

/// The barycentric coordinates of a triangle's point nearest to a place, and the squared distance.
struct NearestPoint
{
  float U = 0.0f;
  float V = 0.0f;
  float Distance2 = std::numeric_limits<float>::infinity();

  NearestPoint(const glm::vec2 corners[3], const glm::vec2& place)
  {
    const glm::vec2 alongU = corners[1] - corners[0];
    const glm::vec2 alongV = corners[2] - corners[0];
    const glm::vec2 to = place - corners[0];
    const float area = Cross(alongU, alongV);
    const float u = Cross(to, alongV) / area;
    const float v = Cross(alongU, to) / area;
    if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f) // false if the area is 0
    {
      this->U = u;
      this->V = v;
      this->Distance2 = 0.0f;
      return;
    }
    constexpr glm::vec2 barycentric[3] = { { 0.0f, 0.0f }, { 1.0f, 0.0f }, { 0.0f, 1.0f } };
    for (int i = 0; i < 3; ++i)
    {
      const int next = (i + 1) % 3;
      const glm::vec2 edge = corners[next] - corners[i];
      const float length2 = glm::dot(edge, edge);
      const float along = length2 > 0.0f
        ? glm::clamp(glm::dot(place - corners[i], edge) / length2, 0.0f, 1.0f)
        : 0.0f;
      const glm::vec2 way = place - corners[i] - along * edge;
      const float distance2 = glm::dot(way, way);
      if (distance2 < this->Distance2)
      {
        const glm::vec2 point = barycentric[i] + along * (barycentric[next] - barycentric[i]);
        this->U = point.x;
        this->V = point.y;
        this->Distance2 = distance2;
      }
    }
  }
};
}

/// The nearest point so far.
struct SurfaceChart::Nearest
{
  TrianglePoint Point;
  float Distance2 = std::numeric_limits<float>::infinity();
};

SurfaceChart::Rectangle SurfaceChart::FindRectangle(
  const std::vector<Member>& members, float cellSize)
{
  glm::vec2 low(std::numeric_limits<float>::max());
  glm::vec2 high(std::numeric_limits<float>::lowest());
  for (const Member& member : members)
  {
    for (const glm::vec2& corner : member.Corners)
    {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  }
  Rectangle result{ low, high - low, {} };
  const float least = MinimumAspect * std::max({ result.Size.x, result.Size.y, 1e-6f });
  result.Size = glm::max(result.Size, glm::vec2(least));
  const auto countCells = [cellSize](float size)
  { return std::clamp(static_cast<int>(std::ceil(size / cellSize)), 1, MaximumCells); };
  result.Cells = { countCells(result.Size.x), countCells(result.Size.y) };
  return result;
}

SurfaceChart::SurfaceChart(std::uint32_t mesh, std::vector<Member> members, float cellSize)
  : Mesh(mesh)
  , Members(std::move(members))
{
  const Rectangle rectangle = FindRectangle(this->Members, cellSize);
  for (Member& member : this->Members)
  {
    for (glm::vec2& corner : member.Corners)
    {
      corner -= rectangle.Low;
    }
  }
  this->Size = rectangle.Size;
  this->Columns = rectangle.Cells.x;
  this->Rows = rectangle.Cells.y;
  this->CellSize = this->Size / glm::vec2(rectangle.Cells);
  this->MakeBins();
}

void SurfaceChart::MakeBins()
{
  // About as many bins as members, as square as possible.
  const int count = static_cast<int>(this->Members.size());
  const float side = std::sqrt(this->Size.x * this->Size.y / static_cast<float>(count));
  const auto countBins = [count, side](float size)
  { return std::clamp(static_cast<int>(std::min(size / side, 4096.0f)), 1, count); };
  this->Bins = { countBins(this->Size.x), countBins(this->Size.y) };
  this->BinSize = this->Size / glm::vec2(this->Bins);

  this->FirstOfBin.assign(std::size_t(this->Bins.x) * this->Bins.y + 1, 0);
  for (const Member& member : this->Members)
  {
    this->VisitBins(member, [this](std::size_t bin) { ++this->FirstOfBin[bin + 1]; });
  }
  for (std::size_t bin = 1; bin < this->FirstOfBin.size(); ++bin)
  {
    this->FirstOfBin[bin] += this->FirstOfBin[bin - 1];
  }
  std::vector<std::uint32_t> next(this->FirstOfBin.begin(), this->FirstOfBin.end() - 1);
  this->BinMembers.resize(this->FirstOfBin.back());
  for (std::uint32_t index = 0; index < this->Members.size(); ++index)
  {
    this->VisitBins(this->Members[index],
      [this, &next, index](std::size_t bin) { this->BinMembers[next[bin]++] = index; });
  }
}

SurfaceChart::Box SurfaceChart::GetBins(const glm::vec2* points, int count) const
{
  glm::vec2 low = points[0];
  glm::vec2 high = points[0];
  for (int i = 1; i < count; ++i)
  {
    low = glm::min(low, points[i]);
    high = glm::max(high, points[i]);
  }
  // Rounding may reach their borders.
  const glm::vec2 margin = Touch * this->CellSize;
  const auto getBin = [this](const glm::vec2& point)
  {
    return glm::clamp(
      glm::ivec2(glm::floor(point / this->BinSize)), glm::ivec2(0), this->Bins - glm::ivec2(1));
  };
  return { getBin(low - margin), getBin(high + margin) };
}

glm::ivec2 SurfaceChart::FindColumns(const Member& member, int row, const Box& box) const
{
  const float margin = RowMargin * std::max(this->CellSize.x, this->CellSize.y);
  const float bottom = static_cast<float>(row) * this->BinSize.y - margin;
  const float top = static_cast<float>(row + 1) * this->BinSize.y + margin;
  float left = std::numeric_limits<float>::max();
  float right = std::numeric_limits<float>::lowest();
  for (int i = 0; i < 3; ++i)
  {
    glm::vec2 ends[2] = { member.Corners[i], member.Corners[(i + 1) % 3] };
    if (ends[0].y > ends[1].y)
    {
      std::swap(ends[0], ends[1]);
    }
    if (ends[1].y < bottom || ends[0].y > top)
    {
      continue;
    }
    const float height = ends[1].y - ends[0].y;
    for (int end = 0; end < 2; ++end)
    {
      const float cut = glm::clamp(ends[end].y, bottom, top);
      const float at = cut == ends[end].y
        ? ends[end].x
        : glm::mix(ends[0].x, ends[1].x, glm::clamp((cut - ends[0].y) / height, 0.0f, 1.0f));
      left = std::min(left, at);
      right = std::max(right, at);
    }
  }
  const auto getColumn = [&](float at)
  {
    return static_cast<int>(
      std::floor(glm::clamp(at / this->BinSize.x, 0.0f, static_cast<float>(this->Bins.x - 1))));
  };
  return left <= right ? glm::ivec2(std::max(box.First.x, getColumn(left - margin)),
                           std::min(box.Last.x, getColumn(right + margin)))
                       : glm::ivec2(0, -1);
}

template <typename Visit>
void SurfaceChart::VisitBins(const Member& member, const Visit& visit) const
{
  const Box box = this->GetBins(member.Corners, 3);
  const bool isSmall = box.First == box.Last;
  for (int j = box.First.y; j <= box.Last.y; ++j)
  {
    // Slivers meet few of the bins of their box.
    const glm::ivec2 columns =
      isSmall ? glm::ivec2(box.First.x, box.Last.x) : this->FindColumns(member, j, box);
    for (int i = columns.x; i <= columns.y; ++i)
    {
      const glm::vec2 low = glm::vec2(i, j) * this->BinSize;
      const glm::vec2 high = low + this->BinSize;
      const glm::vec2 bin[4] = { low, { high.x, low.y }, high, { low.x, high.y } };
      if (isSmall ||
        Meet(member.Corners, bin, Touch * std::max(this->CellSize.x, this->CellSize.y)))
      {
        visit(this->GetBin(i, j));
      }
    }
  }
}

void SurfaceChart::FindIn(int i, int j, bool back, const glm::vec2& place, Nearest& nearest) const
{
  const std::size_t bin = this->GetBin(i, j);
  for (std::size_t k = this->FirstOfBin[bin]; k < this->FirstOfBin[bin + 1]; ++k)
  {
    const Member& member = this->Members[this->BinMembers[k]];
    if ((member.Sides & (back ? 2 : 1)) == 0)
    {
      continue;
    }
    const NearestPoint point(member.Corners, place);
    if (point.Distance2 < nearest.Distance2)
    {
      nearest.Point.Triangle = member.Triangle;
      nearest.Point.U = point.U;
      nearest.Point.V = point.V;
      nearest.Distance2 = point.Distance2;
    }
  }
}

TrianglePoint SurfaceChart::Find(bool back, const glm::vec2& place) const
{
  const glm::vec2 point = place * this->CellSize;
  const glm::ivec2 center = this->GetBins(&point, 1).First;
  const float step = std::min(this->BinSize.x, this->BinSize.y);
  Nearest nearest;
  // Search rings of bins around the place until all further ones are farther away than the result.
  for (int ring = 0; ring < std::max(this->Bins.x, this->Bins.y); ++ring)
  {
    const float reach = static_cast<float>(std::max(ring - 1, 0)) * step;
    if (nearest.Distance2 <= reach * reach)
    {
      break;
    }
    for (int j = std::max(center.y - ring, 0); j <= std::min(center.y + ring, this->Bins.y - 1);
         ++j)
    {
      const bool isWhole = std::abs(j - center.y) == ring;
      for (int i = center.x - ring; i <= center.x + ring; i += isWhole || ring == 0 ? 1 : 2 * ring)
      {
        if (i >= 0 && i < this->Bins.x)
        {
          this->FindIn(i, j, back, point, nearest);
        }
      }
    }
  }
  return nearest.Point;
}

bool SurfaceChart::Overlaps(bool back, const glm::vec2 corners[3]) const
{
  const glm::vec2 triangle[3] = { corners[0] * this->CellSize, corners[1] * this->CellSize,
    corners[2] * this->CellSize };
  const float margin = Touch * std::max(this->CellSize.x, this->CellSize.y);
  const Box box = this->GetBins(triangle, 3);
  for (int j = box.First.y; j <= box.Last.y; ++j)
  {
    for (int i = box.First.x; i <= box.Last.x; ++i)
    {
      const std::size_t bin = this->GetBin(i, j);
      for (std::size_t k = this->FirstOfBin[bin]; k < this->FirstOfBin[bin + 1]; ++k)
      {
        const Member& member = this->Members[this->BinMembers[k]];
        if ((member.Sides & (back ? 2 : 1)) != 0 && Meet(triangle, member.Corners, margin))
        {
          return true;
        }
      }
    }
  }
  return false;
}
}
