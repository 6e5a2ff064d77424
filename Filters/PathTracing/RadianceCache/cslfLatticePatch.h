// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The points and bricks that LatticeBuilder works on; internal to it.
 */
#ifndef cslfLatticePatch_h
#define cslfLatticePatch_h

#include "cslfLatticeBuilder.h"

#include <cstdint>
#include <vector>

namespace cslf
{
// How often the spacing is halved at the edges of very bright areas, whose errors affect all
// surfaces that they light.
constexpr int ExtraLevels = 5;

/// A point of the surface at which light is estimated or interpolated.
struct LatticeBuilder::Point
{
  Hit Place;
  std::uint64_t Key = 0;
  SurfaceEstimate Estimate;

  // If it lies between two other points that are close enough together, it is interpolated.
  bool IsMean = false;
  std::uint32_t Before = 0;
  std::uint32_t After = 0;
  float Weight = 0.0f; // of the point after it
};

/// How much the light between two points differs from a straight line.
struct LatticeBuilder::Bend
{
  glm::vec3 Middle{ 0.0f }; // half way, added to the mean of both
  glm::vec3 Variance{ 0.0f };
};

/// A brick that is being computed, and the points of its lattice, row by row.
struct LatticeBuilder::Patch
{
  int Half = 0; // which of the two lattices it belongs to, and whose values decide
  std::size_t Brick = 0;
  std::size_t Domain = 0; // its triangle's number, or that of all triangles plus its chart's
  std::uint32_t Mesh = 0;
  std::uint32_t Triangle = 0;          // if it belongs to a triangle
  const SurfaceChart* Chart = nullptr; // if it belongs to a chart
  float RootEdge = 0.0f;               // the longest edge of the brick that contains it
  float RootArea = 0.0f;               // and that brick's area
  int RootSize = 0;                    // of that brick, as below
  bool Back = false;
  bool Flipped = false;
  int Column = 0; // of its first corner among the finest points of the triangle or chart
  int Row = 0;
  int Size = 0; // of its edges, in finest points, as a binary logarithm
  int Level = 0;
  bool IsConstant = false;
  bool IsSmooth = false; // whether it is a whole triangle that shares points with its neighbours
  bool HasOwnVertices = false; // whether its corners do not share the points of vertices nearby,
                               // because those are all hidden
  bool IsOpen = true;
  std::vector<std::uint32_t> Points;

  float GetArea() const
  {
    return this->RootArea / static_cast<float>(1 << 2 * (this->RootSize - this->Size));
  }

  std::uint32_t GetPoint(int i, int j) const
  {
    return this->Points[PointIndex(i, j, 1 << this->Level)];
  }
};
}

#endif
