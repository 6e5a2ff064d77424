// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The depth of triangles as a viewpoint of a field sees them in one of its tiles.
 */
#ifndef cslfDepthTile_h
#define cslfDepthTile_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfLayout.h"
#include "cslfTileFrame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/// Triangles that viewpoints look at. They have two sides.
class VTKCSLF_EXPORT DrawnTriangles
{
public:
  /// In CC.
  struct Box
  {
    glm::dvec3 Low{ 0.0 };
    glm::dvec3 High{ 0.0 };
  };

  /// Points in CC, and three numbers of points for each triangle.
  DrawnTriangles(std::vector<glm::dvec3> points, std::vector<unsigned int> corners);

  const std::vector<glm::dvec3>& GetPoints() const { return this->Points; }
  const std::vector<unsigned int>& GetCorners() const { return this->Corners; }

  /// The points, axis by axis.
  const std::array<std::vector<float>, 3>& GetCoordinates() const { return this->Coordinates; }

  const Box& GetBounds() const { return this->Bounds; }

  /// The bounds of 64 triangles each.
  const std::vector<Box>& GetClusters() const { return this->Clusters; }

private:
  std::vector<glm::dvec3> Points;
  std::array<std::vector<float>, 3> Coordinates;
  std::vector<unsigned int> Corners;
  std::vector<Box> Clusters;
  Box Bounds;
};

/// An axis of CC, and the coordinate of the viewpoint along it.
struct TileAxis
{
  TileAxis() = default;
  TileAxis(const glm::dvec3& direction, const glm::dvec3& from)
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

/// The nearest triangles that were drawn in one tile of a viewpoint's strip.
class VTKCSLF_EXPORT DepthTile
{
public:
  DepthTile(const Layout& grid, int slice, int tile);

  /// See TileFrame::HasRays.
  bool HasRays() const { return this->Frame.HasRays(); }

  /// Returns false early if `isStopped` becomes true.
  bool Draw(const DrawnTriangles& triangles, const std::atomic<bool>& isStopped);

  /// For each texel, the largest 1 / depth of triangles that the ray to its centre meets, or 0.
  const std::vector<float>& GetInverseDepths() const { return this->Nearest; }

  /// For each texel with a depth, the number of that triangle: of equally near ones, the first.
  const std::vector<std::uint32_t>& GetTriangles() const { return this->Triangles; }

private:
  using Triangle = std::array<glm::dvec3, 3>;

  /// The edges of columns and rows of texels.
  struct Box
  {
    int FirstX;
    int LastX;
    int FirstY;
    int LastY;
  };

  bool Reaches(const DrawnTriangles::Box& box) const;
  glm::dvec3 Measure(const glm::dvec3& point) const;
  void Place(const std::array<std::vector<float>, 3>& points);
  Triangle Find(const std::vector<glm::dvec3>& points, const unsigned int* corners) const;
  Box FindBox(const unsigned int* corners) const;
  Box FindBox(const std::vector<glm::dvec3>& corners) const;
  Box ToBox(const glm::vec2& least, const glm::vec2& most) const;
  void Draw(const DrawnTriangles& triangles, std::uint32_t number);
  void Draw(const Triangle& triangle, const Box& box, std::uint32_t number);
  void Draw(const unsigned int* corners, const Box& box, std::uint32_t number);

  int Resolution;
  float Margin;
  TileFrame Frame;
  std::array<TileAxis, 3> Axes; ///< of the frame, with the viewpoint's coordinates
  std::vector<float> X;         ///< of the points, in texels
  std::vector<float> Y;
  std::vector<float> Inverses; ///< of their depths, in halves of a tile's side
  std::vector<std::uint8_t> Sides;
  std::vector<float> Nearest;
  std::vector<std::uint32_t> Triangles;
};
}

#endif
