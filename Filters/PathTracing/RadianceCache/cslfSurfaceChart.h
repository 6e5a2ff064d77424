// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Neighbouring triangles that are flattened together, so that one lattice serves all of them.
 *
 * A chart is a rectangle in the plane onto which its triangles are projected. It is divided into
 * equal cells, and each cell into two bricks by a diagonal. Lattice points are places on the chart;
 * a place outside all triangles stands for the nearest point of a triangle.
 */
#ifndef cslfSurfaceChart_h
#define cslfSurfaceChart_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Shapes/cslfMesh.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT SurfaceChart
{
public:
  /// A triangle of the chart.
  struct Member
  {
    std::uint32_t Triangle;
    std::uint8_t Sides;   ///< the open ones, as in OpenSides::GetData
    glm::vec2 Corners[3]; ///< on the chart, in scene space
  };

  /// The largest number of cells along each side of a chart.
  static constexpr int MaximumCells = 256;

  /// Where the members lie.
  struct Rectangle
  {
    glm::vec2 Low;
    glm::vec2 Size;   ///< not 0
    glm::ivec2 Cells; ///< columns and rows
  };

  /// The rectangle of a chart of these members, which is found sooner than the chart is made.
  static Rectangle FindRectangle(const std::vector<Member>& members, float cellSize);

  /// A chart of at least one triangle of a mesh. The members' corners may have any offset. Cells
  /// are at most as wide as given, unless the chart is wider than MaximumCells of them.
  SurfaceChart(std::uint32_t mesh, std::vector<Member> members, float cellSize);

  std::uint32_t GetMesh() const { return this->Mesh; }
  int GetColumns() const { return this->Columns; }
  int GetRows() const { return this->Rows; }
  std::size_t GetBricksOfSide() const { return std::size_t(2) * this->Columns * this->Rows; }

  /// The width and height of a cell, in scene space.
  const glm::vec2& GetCellSize() const { return this->CellSize; }

  const std::vector<Member>& GetMembers() const { return this->Members; }

  /// The position of a member's corner, in cells.
  glm::vec2 GetPlace(const Member& member, int corner) const
  {
    return member.Corners[corner] / this->CellSize;
  }

  /// The point of a triangle that is open on a side which is nearest to a place, given in cells.
  /// There must be such a triangle.
  TrianglePoint Find(bool back, const glm::vec2& place) const;

  /// Whether a triangle that is open on a side overlaps the triangle of these corners, in cells.
  bool Overlaps(bool back, const glm::vec2 corners[3]) const;

private:
  struct Box
  {
    glm::ivec2 First;
    glm::ivec2 Last;
  };
  struct Nearest;

  void MakeBins();
  Box GetBins(const glm::vec2* points, int count) const;
  /// The first and the last bin of a row that a member in the bins of a box can touch.
  glm::ivec2 FindColumns(const Member& member, int row, const Box& box) const;
  std::size_t GetBin(int i, int j) const { return std::size_t(j) * this->Bins.x + i; }
  template <typename Visit>
  void VisitBins(const Member& member, const Visit& visit) const;
  void FindIn(int i, int j, bool back, const glm::vec2& place, Nearest& nearest) const;

  std::uint32_t Mesh;
  int Columns = 1;
  int Rows = 1;
  glm::vec2 Size{ 1.0f }; // of the chart, in scene space
  glm::vec2 CellSize{ 1.0f };
  std::vector<Member> Members;

  // A grid of bins with the members in each.
  glm::ivec2 Bins{ 1 };
  glm::vec2 BinSize{ 1.0f };
  std::vector<std::uint32_t> FirstOfBin; // into the list below, with one more at the end
  std::vector<std::uint32_t> BinMembers;
};
}

#endif
