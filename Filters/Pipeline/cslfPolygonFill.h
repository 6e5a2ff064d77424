// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles that fill any polygon, also one that touches or crosses itself.
 */
#ifndef cslfPolygonFill_h
#define cslfPolygonFill_h

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace cslf
{
/// A point where edges of a polygon cross: a weighted mean of four points of the fill.
struct PolygonCrossing
{
  std::array<int, 4> Points; ///< corners, or crossings before this one
  std::array<double, 4> Weights;
};

/// The triangles that fill a polygon by the even-odd rule: a point belongs to the fill if a line
/// from there to the outside crosses the outline an odd number of times.
struct PolygonFill
{
  std::vector<int> Triangles; ///< three points each: corners, followed by crossings
  std::vector<PolygonCrossing> Crossings;
  double Area = 0.0;      ///< of the triangles along the normal
  bool IsTangled = false; ///< whether it is not filled, because that would take too long
};

/// The work that filling may take, which is proportional to the number of corners: an outline of n
/// corners may cross itself n * n / 2 times.
struct FillBudget
{
  std::int64_t Pairs = 100000000; ///< of edges that overlap along an axis
  std::int64_t Crossings = 50000;

  void AddPolygon(std::size_t corners)
  {
    this->Pairs += 200 * static_cast<std::int64_t>(corners);
    this->Crossings += 20 * static_cast<std::int64_t>(corners);
  }
};

/// The normal of the plane in which a polygon is filled, of any length. It is 0 if the polygon has
/// no area in any plane. Of polygons that do not cross themselves, it is the vector area.
glm::dvec3 FindPolygonNormal(const std::vector<glm::dvec3>& corners);

/// Whether edges of a polygon, projected along a normal, may meet outside of its corners, or more
/// than two of them at a corner. True for large polygons.
bool MayTouchItself(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal);

/// Fills a polygon, projected along a normal, with triangles that face the normal. Coordinates must
/// be finite. Takes the work from the budget.
PolygonFill FillPolygon(
  const std::vector<glm::dvec3>& corners, const glm::dvec3& normal, FillBudget& budget);
}

#endif
