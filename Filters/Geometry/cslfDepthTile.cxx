// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDepthTile.h"

#include "SIMD/cslfVectorize.h"

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
/// What is nearer to a viewpoint, in CC along the axis of a tile, is cut off before it is
/// projected.
constexpr double NearestDistance = 1e-6;

/// Boxes of triangles are widened by this part of a texel and of a tile, because they are rounded.
constexpr float BoxMargin = 1e-3F;
constexpr float BoxMarginOfTile = 1e-5F;

/// Floats do not place points that are nearer to a viewpoint than this, in CC along the axis, well
/// enough.
constexpr float CloseDistance = 0.05F;

/// The triangles that are left out of a tile at once, if their box is. Neighbours follow each other
/// in the files' order.
constexpr std::size_t ClusterCorners = 3 * 64;

/// Triangles are widened by this, relative to the size of their edges, so that no ray falls between
/// neighbours that are rounded differently.
constexpr double EdgeMargin = 1e-12;

/// The sides of a tile that a point lies outside of.
enum Side : std::uint8_t
{
  Left = 1,
  Right = 2,
  Top = 4,
  Bottom = 8,
  Behind = 16,
  Close = 32
};

/// Projects points to texels, whose centres have whole numbers. The inverse depths are multiples of
/// `scale`.
CSLF_VECTORIZE void Project(const float* const points[3], std::size_t count, const TileAxis axes[3],
  float scale, float startX, float startY, float last, float margin, float* x, float* y,
  float* inverse, std::uint8_t* sides)
{
  const float* const px = points[axes[0].Number];
  const float* const py = points[axes[1].Number];
  const float* const pz = points[axes[2].Number];
  const auto signX = static_cast<float>(axes[0].Sign);
  const auto signY = static_cast<float>(axes[1].Sign);
  const auto signZ = static_cast<float>(axes[2].Sign);
  const auto fromX = static_cast<float>(axes[0].From);
  const auto fromY = static_cast<float>(axes[1].From);
  const auto fromZ = static_cast<float>(axes[2].From);
  const auto nearest = static_cast<float>(NearestDistance);
  CSLF_LANE_LOOP
  for (std::size_t k = 0; k < count; ++k)
  {
    const float z = signZ * pz[k] - fromZ;
    const bool isBehind = z < nearest;
    const float factor = scale / (isBehind ? 1.0F : z);
    const float texelX = factor * (signX * px[k] - fromX) - startX;
    const float texelY = factor * (signY * py[k] - fromY) - startY;
    const int outside = (texelX < -margin ? Left : 0) | (texelX > last + margin ? Right : 0) |
      (texelY < -margin ? Top : 0) | (texelY > last + margin ? Bottom : 0);
    x[k] = texelX;
    y[k] = texelY;
    inverse[k] = factor;
    const int exact = z < CloseDistance ? Close : outside;
    sides[k] = static_cast<std::uint8_t>(isBehind ? static_cast<int>(Behind) : exact);
  }
}

/// A number that is linear over a tile.
struct Plane
{
  double First; ///< in the first texel of a box
  double StepX;
  double StepY;
};

/// The range of inverse depths of a triangle, which planes of slivers exceed.
struct Range
{
  double Least;
  double Most;
};

/// Draws a triangle to the texels of a box: its inverse depth, which is the last plane, and its
/// number, where the other three are not negative.
CSLF_VECTORIZE void DrawTexels(const Plane planes[4], const Range& range, int width, int height,
  std::uint32_t number, float* nearest, std::uint32_t* numbers, int resolution)
{
  for (int y = 0; y < height; ++y)
  {
    float* row = nearest + static_cast<std::size_t>(y) * resolution;
    std::uint32_t* triangles = numbers + static_cast<std::size_t>(y) * resolution;
    double first[4];
    for (int k = 0; k < 4; ++k)
    {
      first[k] = planes[k].First + y * planes[k].StepY;
    }
    CSLF_LANE_LOOP
    for (int x = 0; x < width; ++x)
    {
      const double least =
        std::min(std::min(first[0] + x * planes[0].StepX, first[1] + x * planes[1].StepX),
          first[2] + x * planes[2].StepX);
      const double linear = first[3] + x * planes[3].StepX;
      const auto inverse = static_cast<float>(std::min(std::max(linear, range.Least), range.Most));
      const bool isNearest = least >= 0.0 && inverse > row[x];
      row[x] = isNearest ? inverse : row[x];
      triangles[x] = isNearest ? number : triangles[x];
    }
  }
}

/// The corners of what lies before the viewpoint.
std::vector<glm::dvec3> CutNear(const std::array<glm::dvec3, 3>& triangle)
{
  std::vector<glm::dvec3> corners;
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3& a = triangle[k];
    const glm::dvec3& b = triangle[(k + 1) % 3];
    if (a.z >= NearestDistance)
    {
      corners.push_back(a);
    }
    if ((a.z >= NearestDistance) != (b.z >= NearestDistance))
    {
      glm::dvec3 cut = a + (NearestDistance - a.z) / (b.z - a.z) * (b - a);
      cut.z = NearestDistance;
      corners.push_back(cut);
    }
  }
  return corners;
}
}

DrawnTriangles::DrawnTriangles(std::vector<glm::dvec3> points, std::vector<unsigned int> corners)
  : Points(std::move(points))
  , Corners(std::move(corners))
{
  for (std::vector<float>& coordinates : this->Coordinates)
  {
    coordinates.reserve(this->Points.size());
  }
  for (const glm::dvec3& point : this->Points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Coordinates[axis].push_back(static_cast<float>(point[axis]));
    }
  }
  for (std::size_t k = 0; k < this->Corners.size(); ++k)
  {
    const glm::dvec3& point = this->Points[this->Corners[k]];
    if (k % ClusterCorners == 0)
    {
      this->Clusters.push_back({ point, point });
    }
    Box& cluster = this->Clusters.back();
    cluster = { glm::min(cluster.Low, point), glm::max(cluster.High, point) };
  }
  this->Bounds = this->Clusters.empty() ? Box{} : this->Clusters.front();
  for (const Box& cluster : this->Clusters)
  {
    this->Bounds = { glm::min(this->Bounds.Low, cluster.Low),
      glm::max(this->Bounds.High, cluster.High) };
  }
}

DepthTile::DepthTile(const Layout& grid, int slice, int tile)
  : Resolution(grid.GetResolution())
  , Margin(BoxMargin + BoxMarginOfTile * static_cast<float>(Resolution))
  , Frame(grid, slice, tile)
  , Axes{ TileAxis(Frame.AxisX, Frame.From), TileAxis(Frame.AxisY, Frame.From),
    TileAxis(Frame.AxisZ, Frame.From) }
{
  this->Nearest.assign(static_cast<std::size_t>(this->Resolution) * this->Resolution, 0.0F);
  this->Triangles.assign(this->Nearest.size(), 0);
}

bool DepthTile::Draw(const DrawnTriangles& triangles, const std::atomic<bool>& isStopped)
{
  if (!this->HasRays() || !this->Reaches(triangles.GetBounds()))
  {
    return true;
  }
  this->Place(triangles.GetCoordinates());
  const std::vector<unsigned int>& corners = triangles.GetCorners();
  std::size_t first = 0;
  for (const DrawnTriangles::Box& cluster : triangles.GetClusters())
  {
    if (isStopped)
    {
      return false;
    }
    const std::size_t end = std::min(first + ClusterCorners, corners.size());
    if (this->Reaches(cluster))
    {
      for (std::size_t k = first; k < end; k += 3)
      {
        this->Draw(triangles, static_cast<std::uint32_t>(k / 3));
      }
    }
    first = end;
  }
  return true;
}

// Whether rays of the tile may meet a box.
bool DepthTile::Reaches(const DrawnTriangles::Box& box) const
{
  const glm::dvec3 low = this->Measure(box.Low);
  const glm::dvec3 high = this->Measure(box.High);
  const glm::dvec3 least = glm::min(low, high);
  const glm::dvec3 most = glm::max(low, high);
  if (most.z <= 0.0)
  {
    return false;
  }
  // The sides of the tile are planes through the viewpoint: x - start * z / distance is 0 there.
  for (int axis = 0; axis < 2; ++axis)
  {
    const double first = this->Frame.Start[axis] / this->Frame.Distance;
    const double last = (this->Frame.Start[axis] + 2.0) / this->Frame.Distance;
    if (most[axis] < std::min(first * least.z, first * most.z) ||
      least[axis] > std::max(last * least.z, last * most.z))
    {
      return false;
    }
  }
  return true;
}

// Projects the points of all triangles.
void DepthTile::Place(const std::array<std::vector<float>, 3>& points)
{
  const std::size_t count = points[0].size();
  this->X.resize(count);
  this->Y.resize(count);
  this->Inverses.resize(count);
  this->Sides.resize(count);
  const double texels = 0.5 * this->Resolution;
  const float* const coordinates[3] = { points[0].data(), points[1].data(), points[2].data() };
  Project(coordinates, count, this->Axes.data(), static_cast<float>(texels * this->Frame.Distance),
    static_cast<float>(texels * this->Frame.Start.x + 0.5),
    static_cast<float>(texels * this->Frame.Start.y + 0.5),
    static_cast<float>(this->Resolution - 1), this->Margin, this->X.data(), this->Y.data(),
    this->Inverses.data(), this->Sides.data());
}

void DepthTile::Draw(const DrawnTriangles& triangles, std::uint32_t number)
{
  const std::vector<glm::dvec3>& points = triangles.GetPoints();
  const unsigned int* corners = &triangles.GetCorners()[3 * std::size_t(number)];
  const std::uint8_t sides[3] = { this->Sides[corners[0]], this->Sides[corners[1]],
    this->Sides[corners[2]] };
  if ((sides[0] & sides[1] & sides[2] & ~Close) != 0)
  {
    return;
  }
  const bool isNear = ((sides[0] | sides[1] | sides[2]) & (Behind | Close)) != 0;
  const Box box =
    isNear ? this->FindBox(CutNear(this->Find(points, corners))) : this->FindBox(corners);
  if (box.FirstX > box.LastX || box.FirstY > box.LastY)
  {
    return;
  }
  if (isNear)
  {
    this->Draw(this->Find(points, corners), box, number);
  }
  else
  {
    this->Draw(corners, box, number);
  }
}

glm::dvec3 DepthTile::Measure(const glm::dvec3& point) const
{
  return { this->Axes[0].Measure(point), this->Axes[1].Measure(point),
    this->Axes[2].Measure(point) };
}

DepthTile::Triangle DepthTile::Find(
  const std::vector<glm::dvec3>& points, const unsigned int* corners) const
{
  return { this->Measure(points[corners[0]]), this->Measure(points[corners[1]]),
    this->Measure(points[corners[2]]) };
}

// The texels whose centres may lie in a triangle or a polygon.
DepthTile::Box DepthTile::FindBox(const unsigned int* corners) const
{
  const float x[3] = { this->X[corners[0]], this->X[corners[1]], this->X[corners[2]] };
  const float y[3] = { this->Y[corners[0]], this->Y[corners[1]], this->Y[corners[2]] };
  return this->ToBox({ std::min(std::min(x[0], x[1]), x[2]), std::min(std::min(y[0], y[1]), y[2]) },
    { std::max(std::max(x[0], x[1]), x[2]), std::max(std::max(y[0], y[1]), y[2]) });
}

DepthTile::Box DepthTile::FindBox(const std::vector<glm::dvec3>& corners) const
{
  glm::vec2 least(std::numeric_limits<float>::infinity());
  glm::vec2 most(-std::numeric_limits<float>::infinity());
  const double texels = 0.5 * this->Resolution;
  for (const glm::dvec3& corner : corners)
  {
    const double factor = this->Frame.Distance / corner.z;
    const glm::vec2 texel = texels * (factor * glm::dvec2(corner) - this->Frame.Start) - 0.5;
    least = glm::min(least, texel);
    most = glm::max(most, texel);
  }
  return this->ToBox(least, most);
}

DepthTile::Box DepthTile::ToBox(const glm::vec2& least, const glm::vec2& most) const
{
  // Conversion to int rounds down from 0 on.
  const auto size = static_cast<float>(this->Resolution);
  const glm::vec2 first = glm::clamp(least - this->Margin, -1.0F, size) + 1.0F;
  const glm::vec2 end = glm::clamp(most + this->Margin, -1.0F, size) + 1.0F;
  const auto up = [](float number)
  {
    const int down = static_cast<int>(number);
    return down + (static_cast<float>(down) < number ? 1 : 0);
  };
  const int last = this->Resolution - 1;
  return { std::max(up(first.x) - 1, 0), std::min(static_cast<int>(end.x) - 1, last),
    std::max(up(first.y) - 1, 0), std::min(static_cast<int>(end.y) - 1, last) };
}

void DepthTile::Draw(const Triangle& triangle, const Box& box, std::uint32_t number)
{
  const glm::dvec3& a = triangle[0];
  const glm::dvec3 normal = glm::cross(triangle[1] - a, triangle[2] - a);
  const double height = glm::dot(normal, a);
  if (height == 0.0)
  {
    return;
  }
  // Inside, all rays pass the edges on the same side.
  const double sign = height > 0.0 ? 1.0 : -1.0;
  const glm::dvec3 edges[3] = { sign * glm::cross(a, triangle[1]),
    sign * glm::cross(triangle[1], triangle[2]), sign * glm::cross(triangle[2], a) };
  const double step = this->Frame.Step;
  const glm::dvec3 first = this->Frame.GetRay(box.FirstX, box.FirstY);
  Plane planes[4];
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec3& edge = edges[k];
    const double margin = EdgeMargin * glm::dot(glm::abs(edge), glm::dvec3(1.0));
    planes[k] = { glm::dot(edge, first) + margin, step * edge.x, step * edge.y };
  }
  const glm::dvec3 inverse = normal / height;
  planes[3] = { glm::dot(inverse, first), step * inverse.x, step * inverse.y };
  const double depths[3] = { std::max(a.z, NearestDistance),
    std::max(triangle[1].z, NearestDistance), std::max(triangle[2].z, NearestDistance) };
  const Range range = { this->Frame.Distance / std::max({ depths[0], depths[1], depths[2] }),
    this->Frame.Distance / std::min({ depths[0], depths[1], depths[2] }) };
  const std::size_t texel = static_cast<std::size_t>(box.FirstY) * this->Resolution + box.FirstX;
  DrawTexels(planes, range, box.LastX - box.FirstX + 1, box.LastY - box.FirstY + 1, number,
    &this->Nearest[texel], &this->Triangles[texel], this->Resolution);
}

// The same for projected corners, none of which is near. The products of their differences are
// exact.
void DepthTile::Draw(const unsigned int* corners, const Box& box, std::uint32_t number)
{
  glm::dvec2 points[3];
  double inverses[3];
  for (int k = 0; k < 3; ++k)
  {
    points[k] = { this->X[corners[k]], this->Y[corners[k]] };
    inverses[k] = this->Inverses[corners[k]] * (2.0 / this->Resolution);
  }
  const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
  const double area = cross(points[1] - points[0], points[2] - points[0]);
  if (area == 0.0)
  {
    return;
  }
  const double sign = area > 0.0 ? 1.0 : -1.0;
  const glm::dvec2 first(box.FirstX, box.FirstY);
  Plane planes[4]{};
  for (int k = 0; k < 3; ++k)
  {
    const glm::dvec2 edge = sign * (points[(k + 1) % 3] - points[k]);
    const double margin = EdgeMargin * this->Resolution * (std::abs(edge.x) + std::abs(edge.y));
    planes[k] = { cross(edge, first - points[k]) + margin, -edge.y, edge.x };
    const double share = inverses[(k + 2) % 3] / std::abs(area);
    planes[3].First += share * (planes[k].First - margin);
    planes[3].StepX += share * planes[k].StepX;
    planes[3].StepY += share * planes[k].StepY;
  }
  const Range range = { std::min({ inverses[0], inverses[1], inverses[2] }),
    std::max({ inverses[0], inverses[1], inverses[2] }) };
  const std::size_t texel = static_cast<std::size_t>(box.FirstY) * this->Resolution + box.FirstX;
  DrawTexels(planes, range, box.LastX - box.FirstX + 1, box.LastY - box.FirstY + 1, number,
    &this->Nearest[texel], &this->Triangles[texel], this->Resolution);
}
}
