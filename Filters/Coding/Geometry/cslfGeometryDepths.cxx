// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryDepths.h"

#include "Pipeline/cslfTriangleList.h"
#include "SIMD/cslfVectorize.h"

#include <vtkPolyData.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cslf
{
namespace
{
/// What is nearer to a viewpoint, in CC along the axis of a tile, is cut off before it is
/// projected.
constexpr double NearestDistance = 1e-6;

/// Boxes of triangles are widened by this part of a texel and of a tile, because they are rounded.
constexpr float BoxMargin = 1e-3F;
constexpr float BoxMarginOfTile = 1e-6F;

/// Triangles are widened by this, relative to the size of their edges, so that no ray falls between
/// neighbours that are rounded differently.
constexpr double EdgeMargin = 1e-12;

/// Whether a point lies outside of a tile, on which sides: bits for each tile.
enum Side : std::uint32_t
{
  Left = 1,
  Right = 2,
  Top = 4,
  Bottom = 8,
  Behind = 16
};
constexpr int SideBits = 5;
constexpr std::uint32_t AllSides = (1U << SideBits) - 1;

/// The edges of columns and rows of texels.
struct TexelBox
{
  int FirstX;
  int LastX;
  int FirstY;
  int LastY;
};

/// An axis of CC, and the coordinate of the viewpoint along it.
struct Axis
{
  Axis() = default;
  Axis(const glm::dvec3& direction, const glm::dvec3& from)
    : Number(direction.x != 0.0 ? 0
          : direction.y != 0.0  ? 1
                                : 2)
    , Sign(direction[Number])
    , From(Sign * from[Number])
  {
  }

  double Measure(const glm::dvec3& point) const
  {
    return this->Sign * point[this->Number] - this->From;
  }

  int Number = 0;
  double Sign = 1.0;
  double From = 0.0;
};

/// Projects points to texels, whose centres have whole numbers. Sets the bits of the sides.
CSLF_VECTORIZE void Project(const float* const points[3], std::size_t count, const Axis axes[3],
  float scale, float startX, float startY, float last, float margin, int shift, float* x, float* y,
  std::uint32_t* sides)
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
    const std::uint32_t outside = (texelX < -margin ? Left : 0U) |
      (texelX > last + margin ? Right : 0U) | (texelY < -margin ? Top : 0U) |
      (texelY > last + margin ? Bottom : 0U);
    x[k] = texelX;
    y[k] = texelY;
    sides[k] |= (isBehind ? static_cast<std::uint32_t>(Behind) : outside) << shift;
  }
}

/// A number that is linear over a tile.
struct Plane
{
  double First; ///< in the first texel of a box
  double StepX;
  double StepY;
};

/// Draws a triangle to the texels of a box: its inverse depth, which is the last plane, where the
/// other three are not negative.
CSLF_VECTORIZE void DrawTexels(
  const Plane planes[4], const TexelBox& box, double* nearest, int resolution)
{
  const int width = box.LastX - box.FirstX + 1;
  const int height = box.LastY - box.FirstY + 1;
  for (int y = 0; y < height; ++y)
  {
    double* row = nearest + static_cast<std::size_t>(y) * resolution;
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
      const double inverse = first[3] + x * planes[3].StepX;
      row[x] = least >= 0.0 && inverse > row[x] ? inverse : row[x];
    }
  }
}

/// One tile of a viewpoint's strip, and the space of its rays: x and y along the axes of the exit
/// face, z along its normal, from the viewpoint.
class Tile
{
public:
  Tile(const Layout& grid, int slice, int tile)
    : Resolution(grid.GetResolution())
    , Margin(BoxMargin + BoxMarginOfTile * static_cast<float>(Resolution))
    , Shift(SideBits * tile)
  {
    const Viewpoint viewpoint = grid.ViewpointOf(slice);
    const int face = ExitFaceOf(viewpoint.Face, tile);
    const glm::dvec3 from = grid.ViewpointPosition(viewpoint);
    const glm::dvec3 normal = FaceToCube(face, { 0.0, 0.0 });
    this->Axes[0] = Axis(FaceToCube(face, { 1.0, 0.0 }) - normal, from);
    this->Axes[1] = Axis(FaceToCube(face, { 0.0, 1.0 }) - normal, from);
    this->Axes[2] = Axis(normal, from);
    this->Start = { -1.0 - this->Axes[0].From, -1.0 - this->Axes[1].From };
    this->Distance = 1.0 - this->Axes[2].From;
    this->Nearest.assign(static_cast<std::size_t>(this->Resolution) * this->Resolution, 0.0);
  }

  /// Projects the points of all triangles.
  void Place(const std::array<std::vector<float>, 3>& points, std::vector<std::uint32_t>& sides)
  {
    this->X.resize(sides.size());
    this->Y.resize(sides.size());
    if (!this->HasRays())
    {
      std::for_each(sides.begin(), sides.end(),
        [this](std::uint32_t& side) { side |= static_cast<std::uint32_t>(Behind) << this->Shift; });
      return;
    }
    const double texels = 0.5 * this->Resolution;
    const float* const coordinates[3] = { points[0].data(), points[1].data(), points[2].data() };
    Project(coordinates, sides.size(), this->Axes.data(),
      static_cast<float>(texels * this->Distance), static_cast<float>(texels * this->Start.x + 0.5),
      static_cast<float>(texels * this->Start.y + 0.5), static_cast<float>(this->Resolution - 1),
      this->Margin, this->Shift, this->X.data(), this->Y.data(), sides.data());
  }

  void Draw(const std::vector<glm::dvec3>& points, const std::vector<std::uint32_t>& sides,
    const unsigned int* corners)
  {
    const std::uint32_t any = sides[corners[0]] | sides[corners[1]] | sides[corners[2]];
    const bool isCut = ((any >> this->Shift) & Behind) != 0;
    const TexelBox box =
      isCut ? this->FindBox(CutNear(this->Find(points, corners))) : this->FindBox(corners);
    if (box.FirstX <= box.LastX && box.FirstY <= box.LastY)
    {
      this->Draw(this->Find(points, corners), box);
    }
  }

  /// Writes the tile's depths to the strip.
  void Write(int tile, unsigned short* depths) const
  {
    std::size_t from = 0;
    for (int y = 0; y < this->Resolution; ++y)
    {
      unsigned short* row = depths + static_cast<std::size_t>(y) * TileCount * this->Resolution +
        static_cast<std::size_t>(tile) * this->Resolution;
      for (int x = 0; x < this->Resolution; ++x, ++from)
      {
        const double inverse = this->Nearest[from];
        row[x] = inverse > 0.0 ? static_cast<unsigned short>(
                                   std::min(65535.0 / inverse + 0.5, GeometryDepths::None - 1.0))
                               : GeometryDepths::None;
      }
    }
  }

private:
  using Triangle = std::array<glm::dvec3, 3>;

  /// On an edge of the cube, the rays to the other face lie in that face.
  bool HasRays() const { return this->Distance > 0.0; }

  Triangle Find(const std::vector<glm::dvec3>& points, const unsigned int* corners) const
  {
    Triangle triangle;
    for (int k = 0; k < 3; ++k)
    {
      const glm::dvec3& point = points[corners[k]];
      triangle[k] = { this->Axes[0].Measure(point), this->Axes[1].Measure(point),
        this->Axes[2].Measure(point) };
    }
    return triangle;
  }

  /// The corners of what lies before the viewpoint.
  static std::vector<glm::dvec3> CutNear(const Triangle& triangle)
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

  ///@{
  /// The texels whose centres may lie in a triangle or a polygon.
  TexelBox FindBox(const unsigned int* corners) const
  {
    const float x[3] = { this->X[corners[0]], this->X[corners[1]], this->X[corners[2]] };
    const float y[3] = { this->Y[corners[0]], this->Y[corners[1]], this->Y[corners[2]] };
    return this->ToBox(
      { std::min(std::min(x[0], x[1]), x[2]), std::min(std::min(y[0], y[1]), y[2]) },
      { std::max(std::max(x[0], x[1]), x[2]), std::max(std::max(y[0], y[1]), y[2]) });
  }
  TexelBox FindBox(const std::vector<glm::dvec3>& corners) const
  {
    glm::vec2 least(std::numeric_limits<float>::infinity());
    glm::vec2 most(-std::numeric_limits<float>::infinity());
    const double texels = 0.5 * this->Resolution;
    for (const glm::dvec3& corner : corners)
    {
      const double factor = this->Distance / corner.z;
      const glm::vec2 texel = texels * (factor * glm::dvec2(corner) - this->Start) - 0.5;
      least = glm::min(least, texel);
      most = glm::max(most, texel);
    }
    return this->ToBox(least, most);
  }
  TexelBox ToBox(const glm::vec2& least, const glm::vec2& most) const
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
  ///@}

  void Draw(const Triangle& triangle, const TexelBox& box)
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
    const double step = 2.0 / this->Resolution;
    const glm::dvec3 first = { this->Start.x + (box.FirstX + 0.5) * step,
      this->Start.y + (box.FirstY + 0.5) * step, this->Distance };
    Plane planes[4];
    for (int k = 0; k < 3; ++k)
    {
      const glm::dvec3& edge = edges[k];
      const double margin = EdgeMargin * glm::dot(glm::abs(edge), glm::dvec3(1.0));
      planes[k] = { glm::dot(edge, first) + margin, step * edge.x, step * edge.y };
    }
    const glm::dvec3 inverse = normal / height;
    planes[3] = { glm::dot(inverse, first), step * inverse.x, step * inverse.y };
    DrawTexels(planes, box,
      &this->Nearest[static_cast<std::size_t>(box.FirstY) * this->Resolution + box.FirstX],
      this->Resolution);
  }

  int Resolution;
  float Margin;
  int Shift;
  std::array<Axis, 3> Axes;
  glm::dvec2 Start;     ///< of the tile's corner
  double Distance;      ///< of the exit face
  std::vector<float> X; ///< of the points, in texels
  std::vector<float> Y;
  std::vector<double> Nearest; ///< the largest inverse depth of each texel, or 0
};
}

GeometryDepths::GeometryDepths(vtkPolyData* triangles, const Cube& box, const Layout& grid)
  : Grid(grid)
  , Corners(ListCorners(triangles))
{
  const vtkIdType count = triangles->GetNumberOfPoints();
  for (vtkIdType k = 0; k < count; ++k)
  {
    double point[3];
    triangles->GetPoint(k, point);
    this->Points.push_back(box.PointToCube({ point[0], point[1], point[2] }));
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Coordinates[axis].push_back(static_cast<float>(this->Points.back()[axis]));
    }
  }
}

void GeometryDepths::Draw(int slice, std::vector<unsigned short>& depths) const
{
  std::vector<Tile> tiles;
  std::vector<std::uint32_t> sides(this->Points.size(), 0);
  for (int number = 0; number < TileCount; ++number)
  {
    tiles.emplace_back(this->Grid, slice, number);
    tiles.back().Place(this->Coordinates, sides);
  }
  for (std::size_t k = 0; k < this->Corners.size(); k += 3)
  {
    const unsigned int* corners = &this->Corners[k];
    std::uint32_t outside = sides[corners[0]] & sides[corners[1]] & sides[corners[2]];
    for (Tile& tile : tiles)
    {
      if ((outside & AllSides) == 0)
      {
        tile.Draw(this->Points, sides, corners);
      }
      outside >>= SideBits;
    }
  }
  depths.assign(this->Grid.GetStripTexels(), None);
  for (int number = 0; number < TileCount; ++number)
  {
    tiles[number].Write(number, depths.data());
  }
}
}
