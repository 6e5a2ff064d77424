// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPolygonFill.h"

#ifdef _WIN32
#include <windows.h> // GLU's header needs it
#endif
#ifdef __APPLE__
#include <OpenGL/glu.h>
#else
#include <GL/glu.h>
#endif

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <new>

#ifndef CALLBACK
#define CALLBACK // the calling convention of GLU's callbacks, on Windows
#endif

namespace cslf
{
namespace
{
// The vector area of a polygon that does not cross itself is its normal. If it is a smaller part of
// the areas between the edges and the centre, the largest triangle is a safer one.
constexpr double MinimumVectorArea = 0.25;

// A polygon with fewer corners cannot cross itself often enough to take long.
constexpr std::size_t FewCorners = 64;

// The smallest area, in a square of the polygon's size, that is not an error of rounding.
constexpr double MinimumArea = 1e-14;

double Cross(const glm::dvec2& a, const glm::dvec2& b)
{
  return a.x * b.y - a.y * b.x;
}

/// A polygon around the origin, with coordinates of at most 1.
struct Outline
{
  explicit Outline(const std::vector<glm::dvec3>& corners)
  {
    glm::dvec3 lower = corners.front();
    glm::dvec3 upper = corners.front();
    for (const glm::dvec3& corner : corners)
    {
      lower = glm::min(lower, corner);
      upper = glm::max(upper, corner);
    }
    const glm::dvec3 half = 0.5 * upper - 0.5 * lower;
    this->Scale = std::max({ half.x, half.y, half.z });
    if (this->Scale > 0.0)
    {
      const glm::dvec3 center = 0.5 * lower + 0.5 * upper;
      for (const glm::dvec3& corner : corners)
      {
        this->Corners.push_back((corner - center) / this->Scale);
      }
    }
  }

  std::vector<glm::dvec3> Corners; ///< none if all are at one place
  double Scale;
};

/// Twice the area of a large triangle of corners, as a normal.
glm::dvec3 FindLargeTriangle(const std::vector<glm::dvec3>& corners)
{
  const auto findFarthest = [&corners](const glm::dvec3& from)
  {
    return *std::max_element(corners.begin(), corners.end(),
      [&from](const glm::dvec3& a, const glm::dvec3& b)
      { return glm::dot(a - from, a - from) < glm::dot(b - from, b - from); });
  };
  const glm::dvec3 first = findFarthest(glm::dvec3(0.0));
  const glm::dvec3 side = findFarthest(first) - first;
  glm::dvec3 largest(0.0);
  for (const glm::dvec3& corner : corners)
  {
    const glm::dvec3 normal = glm::cross(side, corner - first);
    if (glm::dot(normal, normal) > glm::dot(largest, largest))
    {
      largest = normal;
    }
  }
  return largest;
}

/// Whether the first triangle from the first corner that has an area faces away from a normal. The
/// parts of an outline that crosses itself face both ways, and which of them is larger would differ
/// between the polygons of one surface.
bool FacesBack(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal)
{
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    const double along =
      glm::dot(glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]), normal);
    if (std::abs(along) > MinimumArea * glm::length(normal))
    {
      return along < 0.0;
    }
  }
  return false;
}

/// An edge of a polygon in a plane.
struct Edge
{
  glm::dvec2 Ends[2];
  glm::dvec2 Lower;
  glm::dvec2 Upper;
};

std::vector<Edge> FindEdges(const std::vector<glm::dvec2>& corners)
{
  std::vector<Edge> edges;
  edges.reserve(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const glm::dvec2& begin = corners[i];
    const glm::dvec2& end = corners[i + 1 < corners.size() ? i + 1 : 0];
    edges.push_back({ { begin, end }, glm::min(begin, end), glm::max(begin, end) });
  }
  return edges;
}

bool ShareCorner(const Edge& a, const Edge& b)
{
  return a.Ends[0] == b.Ends[0] || a.Ends[0] == b.Ends[1] || a.Ends[1] == b.Ends[0] ||
    a.Ends[1] == b.Ends[1];
}

/// Whether edges have a point in common.
bool Meet(const Edge& a, const Edge& b)
{
  const auto divides = [](const Edge& line, const Edge& edge)
  {
    const glm::dvec2 side = line.Ends[1] - line.Ends[0];
    return Cross(side, edge.Ends[0] - line.Ends[0]) * Cross(side, edge.Ends[1] - line.Ends[0]) <=
      0.0;
  };
  return a.Lower.x <= b.Upper.x && b.Lower.x <= a.Upper.x && a.Lower.y <= b.Upper.y &&
    b.Lower.y <= a.Upper.y && divides(a, b) && divides(b, a);
}

/// Takes the costs of an outline from the budget. Returns whether that suffices. The tessellator
/// takes time for each crossing and, to find the edges beside a corner, for each pair of edges that
/// overlap along the x axis.
bool Spend(const std::vector<glm::dvec2>& corners, FillBudget& budget)
{
  std::vector<Edge> edges = FindEdges(corners);
  std::sort(
    edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.Lower.x < b.Lower.x; });
  FillBudget left = budget;
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    for (std::size_t k = i + 1; k < edges.size() && edges[k].Lower.x <= edges[i].Upper.x; ++k)
    {
      --left.Pairs;
      left.Crossings -= Meet(edges[i], edges[k]) && !ShareCorner(edges[i], edges[k]) ? 1 : 0;
      if (left.Pairs < 0 || left.Crossings < 0)
      {
        return false;
      }
    }
  }
  budget = left;
  return true;
}

/// GLU's tessellator. It numbers points from 1, because it tells by a null pointer that there is
/// none. An exception must not pass through it, so it is thrown afterwards.
class Tessellator
{
public:
  explicit Tessellator(PolygonFill& fill)
    : Fill(fill)
    , Handle(gluNewTess(), &gluDeleteTess)
  {
    if (!this->Handle)
    {
      throw std::bad_alloc();
    }
    // With a callback for edges, all parts are separate triangles.
    this->SetCallback(GLU_TESS_EDGE_FLAG_DATA, &Tessellator::SetEdgeFlag);
    this->SetCallback(GLU_TESS_VERTEX_DATA, &Tessellator::AddPoint);
    this->SetCallback(GLU_TESS_COMBINE_DATA, &Tessellator::AddCrossing);
    this->SetCallback(GLU_TESS_ERROR_DATA, &Tessellator::Fail);
    gluTessProperty(this->Handle.get(), GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_ODD);
    gluTessNormal(this->Handle.get(), 0.0, 0.0, 1.0);
  }

  void Run(const std::vector<glm::dvec2>& corners)
  {
    this->Count = static_cast<int>(corners.size());
    gluTessBeginPolygon(this->Handle.get(), this);
    gluTessBeginContour(this->Handle.get());
    for (int i = 0; i < this->Count; ++i)
    {
      double place[3] = { corners[i].x, corners[i].y, 0.0 };
      gluTessVertex(this->Handle.get(), place, ToPointer(i));
    }
    gluTessEndContour(this->Handle.get());
    gluTessEndPolygon(this->Handle.get());
    if (this->HasFailed)
    {
      throw std::bad_alloc();
    }
  }

private:
  static void* ToPointer(int point)
  {
    return reinterpret_cast<void*>(static_cast<std::uintptr_t>(point) + 1);
  }

  static int ToPoint(void* pointer)
  {
    return static_cast<int>(reinterpret_cast<std::uintptr_t>(pointer) - 1);
  }

  template <typename Function>
  void SetCallback(GLenum which, Function function)
  {
    gluTessCallback(this->Handle.get(), which, reinterpret_cast<void(CALLBACK*)()>(function));
  }

  static void CALLBACK SetEdgeFlag(GLboolean, void*) {}

  static void CALLBACK AddPoint(void* point, void* self)
  {
    auto* tessellator = static_cast<Tessellator*>(self);
    try
    {
      tessellator->Fill.Triangles.push_back(ToPoint(point));
    }
    catch (const std::bad_alloc&)
    {
      tessellator->HasFailed = true;
    }
  }

  /// Corners at one place become one of them; crossings become new points.
  static void CALLBACK AddCrossing(
    double*, void* points[4], float weights[4], void** result, void* self)
  {
    *result = points[0];
    auto* tessellator = static_cast<Tessellator*>(self);
    if (!points[2] || !points[3])
    {
      return;
    }
    PolygonCrossing crossing;
    for (int i = 0; i < 4; ++i)
    {
      crossing.Points[i] = ToPoint(points[i]);
      crossing.Weights[i] = weights[i];
    }
    try
    {
      tessellator->Fill.Crossings.push_back(crossing);
      *result =
        ToPointer(tessellator->Count + static_cast<int>(tessellator->Fill.Crossings.size()) - 1);
    }
    catch (const std::bad_alloc&)
    {
      tessellator->HasFailed = true;
    }
  }

  static void CALLBACK Fail(GLenum, void* self)
  {
    static_cast<Tessellator*>(self)->HasFailed = true;
  }

  PolygonFill& Fill;
  std::unique_ptr<GLUtesselator, void(CALLBACK*)(GLUtesselator*)> Handle;
  int Count = 0; // of corners
  bool HasFailed = false;
};

/// The coordinates of points in the plane of a normal.
std::vector<glm::dvec2> Project(const std::vector<glm::dvec3>& points, const glm::dvec3& normal)
{
  const glm::dvec3 axis = glm::normalize(normal);
  const glm::dvec3 other =
    std::abs(axis.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 u = glm::normalize(glm::cross(other, axis));
  const glm::dvec3 v = glm::cross(axis, u);
  std::vector<glm::dvec2> projected;
  projected.reserve(points.size());
  for (const glm::dvec3& point : points)
  {
    projected.emplace_back(glm::dot(point, u), glm::dot(point, v));
  }
  return projected;
}

/// The area of the triangles in the plane.
double FindArea(const PolygonFill& fill, std::vector<glm::dvec2> points)
{
  for (const PolygonCrossing& crossing : fill.Crossings)
  {
    glm::dvec2 place(0.0);
    for (int i = 0; i < 4; ++i)
    {
      place += crossing.Weights[i] * points[crossing.Points[i]];
    }
    points.push_back(place);
  }
  double area = 0.0;
  for (std::size_t i = 0; i + 2 < fill.Triangles.size(); i += 3)
  {
    const glm::dvec2& first = points[fill.Triangles[i]];
    area += 0.5 *
      std::abs(Cross(points[fill.Triangles[i + 1]] - first, points[fill.Triangles[i + 2]] - first));
  }
  return area;
}
}

glm::dvec3 FindPolygonNormal(const std::vector<glm::dvec3>& corners)
{
  const std::vector<glm::dvec3> outline = Outline(corners).Corners;
  glm::dvec3 sum(0.0);
  double size = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    const glm::dvec3 part = glm::cross(outline[i], outline[(i + 1) % outline.size()]);
    sum += part;
    size += glm::length(part);
  }
  if (size > 0.0 && glm::length(sum) >= MinimumVectorArea * size)
  {
    return sum;
  }
  const glm::dvec3 largest = outline.empty() ? sum : FindLargeTriangle(outline);
  if (!(glm::length(largest) > MinimumArea))
  {
    return glm::dvec3(0.0);
  }
  return FacesBack(outline, largest) ? -largest : largest;
}

bool MayTouchItself(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal)
{
  if (corners.size() > FewCorners)
  {
    return true;
  }
  const std::vector<Edge> edges = FindEdges(Project(corners, normal));
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    for (std::size_t k = i + 2; k < edges.size() - (i == 0 ? 1 : 0); ++k)
    {
      if (Meet(edges[i], edges[k]))
      {
        return true;
      }
    }
  }
  return false;
}

PolygonFill FillPolygon(
  const std::vector<glm::dvec3>& corners, const glm::dvec3& normal, FillBudget& budget)
{
  PolygonFill fill;
  const Outline outline(corners);
  if (outline.Corners.empty() || !(glm::length(normal) > 0.0))
  {
    return fill;
  }
  std::vector<glm::dvec2> points = Project(outline.Corners, normal);
  budget.AddPolygon(points.size());
  if (points.size() > FewCorners && !Spend(points, budget))
  {
    // Along the other axis, fewer edges may overlap.
    for (glm::dvec2& point : points)
    {
      point = { point.y, -point.x };
    }
    fill.IsTangled = !Spend(points, budget);
  }
  if (fill.IsTangled)
  {
    return fill;
  }
  Tessellator(fill).Run(points);
  const double area = FindArea(fill, points);
  fill.Area = area * outline.Scale * outline.Scale;
  if (!(area > MinimumArea))
  {
    fill.Triangles.clear();
  }
  return fill;
}
}
