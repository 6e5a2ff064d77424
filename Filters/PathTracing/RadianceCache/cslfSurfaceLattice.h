// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Values on the surface of triangles, with adaptive resolution.
 *
 * Every triangle has two sides. Each side is split into bricks, triangles of about the same size.
 * Triangles that are too small or too thin for that share the bricks of a chart, a rectangle of
 * cells onto which they are projected; each cell is two bricks. A brick has values at the points of
 * a small triangular lattice, which are interpolated linearly (after Yuksel, Keyser and House,
 * "Mesh Colors", ACM TOG 29(2), 2010), or it is split into four bricks. So no texture coordinates
 * are needed, and a look-up descends only where there is detail.
 */
#ifndef cslfSurfaceLattice_h
#define cslfSurfaceLattice_h

#include "vtkCSLFModule.h" // for export macro

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/// A small triangle of a triangle that is split into `splits` parts along each edge. Every second
/// one is flipped; its coordinates run from the corner opposite to the first corner of the
/// triangle.
struct LatticeCell
{
  int I = 0;       ///< along the triangle's second vertex
  int J = 0;       ///< along its third
  int Flipped = 0; ///< 1 if it is flipped, else 0
  float U = 0.0f;  ///< barycentric coordinates within
  float V = 0.0f;

  LatticeCell(float u, float v, int splits)
  {
    // Without branches, so that loops over points become vector instructions.
    const float x = u * static_cast<float>(splits);
    const float y = v * static_cast<float>(splits);
    const int column = static_cast<int>(x);
    const int lastI = splits - 1;
    this->I = column > lastI ? lastI : column;
    const int row = static_cast<int>(y);
    const int lastJ = lastI - this->I;
    this->J = row > lastJ ? lastJ : row;
    const float restU = x - static_cast<float>(this->I);
    const float restV = y - static_cast<float>(this->J);
    this->Flipped = (restU + restV > 1.0f ? 1 : 0) & (this->J < lastJ ? 1 : 0);
    this->U = this->Flipped ? 1.0f - restU : restU;
    this->V = this->Flipped ? 1.0f - restV : restV;
  }
};

/// One of the two triangles of a cell of a chart.
struct ChartCell
{
  int I = 0;       ///< the cell's column
  int J = 0;       ///< and row
  int Flipped = 0; ///< 1 for the triangle with the corner that is farthest from the chart's first
  float U = 0.0f;  ///< barycentric coordinates within
  float V = 0.0f;

  /// At a place given in cells.
  ChartCell(const glm::vec2& place, int columns, int rows)
  {
    this->I = std::clamp(static_cast<int>(place.x), 0, columns - 1);
    this->J = std::clamp(static_cast<int>(place.y), 0, rows - 1);
    const float restU = place.x - static_cast<float>(this->I);
    const float restV = place.y - static_cast<float>(this->J);
    this->Flipped = restU + restV > 1.0f ? 1 : 0;
    this->U = this->Flipped ? 1.0f - restU : restU;
    this->V = this->Flipped ? 1.0f - restV : restV;
  }
};

/// The number of a cell among those of its triangle.
inline int CellIndex(int i, int j, int flipped, int splits)
{
  return j * (2 * splits - j) + 2 * i + flipped;
}

/// The number of a lattice's point among those of its brick.
inline int PointIndex(int i, int j, int splits)
{
  return j * (splits + 1) - j * (j - 1) / 2 + i;
}

inline int CountPoints(int splits)
{
  return (splits + 1) * (splits + 2) / 2;
}

/// Points on the surface that are looked up together, and their values.
struct LatticePacket
{
  static constexpr int Size = 16;

  alignas(64) std::uint32_t Triangle[Size]; ///< any of the lattice where no point is wanted
  alignas(64) int Back[Size];               ///< 1 on the back, else 0
  alignas(64) float U[Size];                ///< barycentric coordinates
  alignas(64) float V[Size];
  alignas(64) float Red[Size]; ///< the values
  alignas(64) float Green[Size];
  alignas(64) float Blue[Size];
};

/// A chart, and the positions of its triangles on it.
struct LatticeChart
{
  struct Member
  {
    std::uint32_t Triangle;
    glm::vec2 Corner; ///< of its first vertex, in cells
    glm::vec2 AlongU; ///< from there to the second
    glm::vec2 AlongV; ///< and the third
  };

  int Columns = 1;
  int Rows = 1;
  std::vector<Member> Members;
};

class VTKCSLF_EXPORT SurfaceLattice
{
public:
  /// The most bricks and values: packets of look-ups have signed indices of 32 bits.
  static constexpr std::size_t MaximumIndex = 0x7fffffff;

  /// Throws std::length_error, with the reason for users, if there would be more bricks or values.
  /// All methods that add some call it.
  static void RequireIndex(std::size_t index);

  /// A brick with a single value.
  static constexpr std::uint32_t Constant = 0xffffffffu;
  /// A brick that is split into four.
  static constexpr std::uint32_t Split = 0xfffffffeu;

  struct Brick
  {
    std::uint32_t First = 0;        ///< its first value, or the first brick that it is split into
    std::uint32_t Level = Constant; ///< the binary logarithm of the splits along its edges
  };

  SurfaceLattice() = default;

  /// Bricks that are 0 everywhere. `splits` has the binary logarithm of the number of bricks along
  /// each triangle's edges. It is ignored for members of charts.
  explicit SurfaceLattice(
    const std::vector<std::uint8_t>& splits, const std::vector<LatticeChart>& charts = {});

  /// The same bricks, 0 everywhere.
  SurfaceLattice MakeEmpty() const;

  std::size_t GetNumberOfTriangles() const { return this->Triangles.size(); }
  /// The number of bricks that are not parts of others. They come first.
  std::size_t GetNumberOfRoots() const { return this->NumberOfRoots; }
  std::size_t GetNumberOfValues() const { return this->Values.size() - Spare; }
  /// The number of bricks along the edges of a triangle that is not on a chart.
  int GetSplits(std::size_t triangle) const { return 1 << this->Triangles[triangle].Depth; }

  /// A brick of a triangle that is not on a chart.
  std::size_t GetBrickIndex(std::size_t triangle, bool back, int cell) const
  {
    const int splits = this->GetSplits(triangle);
    return this->Triangles[triangle].FirstBrick + (back ? splits * splits : 0) + cell;
  }

  /// A brick of a chart. They are numbered row by row.
  std::size_t GetChartBrickIndex(std::size_t chart, bool back, int cell) const
  {
    const ChartBricks& bricks = this->Charts[chart];
    return bricks.First + (back ? bricks.CountOfSide : 0) + cell;
  }

  /// The brick at a point that is not part of another.
  std::size_t FindRoot(std::size_t triangle, bool back, float u, float v) const
  {
    return this->FindPlace(triangle, back, u, v).Root;
  }
  const Brick& GetBrick(std::size_t index) const { return this->Bricks[index]; }

  /// Gives a brick its values: one, or those of a lattice's points.
  void SetBrick(std::size_t index, std::uint32_t level, const std::vector<glm::vec3>& values);

  /// Splits a brick into four and returns the index of the first. They are in the order of the
  /// cells.
  std::size_t SplitBrick(std::size_t index);

  /// The value at a point, given by barycentric coordinates.
  glm::vec3 Get(std::size_t triangle, bool back, float u, float v) const
  {
    const Place place = this->FindPlace(triangle, back, u, v);
    return this->GetInBrick(this->Bricks[place.Root], place.U, place.V);
  }

  /// The values at the points of a packet.
  void Get(LatticePacket& packet) const;

  /// The value at a point of a brick, given by barycentric coordinates within it.
  glm::vec3 GetInBrick(Brick brick, float u, float v) const
  {
    while (brick.Level == Split)
    {
      const LatticeCell cell(u, v, 2);
      brick = this->Bricks[brick.First + CellIndex(cell.I, cell.J, cell.Flipped, 2)];
      u = cell.U;
      v = cell.V;
    }
    const glm::vec3* values = this->Values.data() + brick.First;
    if (brick.Level == Constant)
    {
      return *values;
    }
    const int splits = 1 << brick.Level;
    const LatticeCell cell(u, v, splits);
    const int flip = cell.Flipped;
    const int here = PointIndex(cell.I + flip, cell.J + flip, splits);
    const int alongU = PointIndex(cell.I + 1 - flip, cell.J + flip, splits);
    const int alongV = PointIndex(cell.I + flip, cell.J + 1 - flip, splits);
    return (1.0f - cell.U - cell.V) * values[here] + cell.U * values[alongU] +
      cell.V * values[alongV];
  }

  /// Writes or reads all data.
  template <typename Archive>
  void Exchange(Archive& archive)
  {
    archive.Value(this->NumberOfRoots);
    archive.Array(this->Triangles);
    archive.Array(this->Placements);
    archive.Array(this->Bricks);
    archive.Array(this->Values);
  }

private:
  struct Triangle
  {
    std::uint32_t FirstBrick;
    std::uint32_t Depth; // the binary logarithm of the bricks along its edges, or OnChart and the
                         // number of its placement
  };

  static constexpr std::uint32_t OnChart = 0x80000000u;

  // The position of a triangle on its chart, in cells.
  struct Placement
  {
    glm::vec2 Corner;
    glm::vec2 AlongU;
    glm::vec2 AlongV;
    std::int32_t Columns;
    std::int32_t Rows;
  };

  struct ChartBricks
  {
    std::uint32_t First;
    std::uint32_t CountOfSide;
  };

  // A point in a brick that is not part of another.
  struct Place
  {
    std::size_t Root;
    float U;
    float V;
  };

  Place FindPlace(std::size_t triangle, bool back, float u, float v) const
  {
    const Triangle& place = this->Triangles[triangle];
    if (place.Depth >= OnChart)
    {
      return FindOnChart(place, this->Placements.data(), back, u, v);
    }
    const int splits = 1 << place.Depth;
    const LatticeCell cell(u, v, splits);
    const int index = CellIndex(cell.I, cell.J, cell.Flipped, splits);
    return { place.FirstBrick + std::size_t(back ? splits * splits : 0) + index, cell.U, cell.V };
  }

  static Place FindOnChart(
    const Triangle& triangle, const Placement* placements, bool back, float u, float v)
  {
    const Placement& placement = placements[triangle.Depth - OnChart];
    const ChartCell cell(placement.Corner + u * placement.AlongU + v * placement.AlongV,
      placement.Columns, placement.Rows);
    const int index = (back ? 2 * placement.Columns * placement.Rows : 0) +
      2 * (cell.J * placement.Columns + cell.I) + cell.Flipped;
    return { triangle.FirstBrick + std::size_t(index), cell.U, cell.V };
  }

  struct PacketPlaces;
  struct PacketCorners;

  static int GoToBricks(const Triangle* triangles, const Placement* placements, const Brick* bricks,
    const LatticePacket& packet, PacketPlaces& places);
  static int GoToParts(const Brick* bricks, PacketPlaces& places);
  static void FindCorners(const PacketPlaces& places, PacketCorners& corners);
  static void Interpolate(
    const glm::vec3* values, const PacketCorners& corners, LatticePacket& packet);

  // Unused values at the end, so that values can be loaded four numbers at a time.
  static constexpr std::size_t Spare = 1;

  std::size_t NumberOfRoots = 0;
  std::vector<Triangle> Triangles;
  std::vector<Placement> Placements; // of the triangles on charts
  std::vector<ChartBricks> Charts;   // needed until all bricks have their values
  std::vector<Brick> Bricks;
  std::vector<glm::vec3> Values = std::vector<glm::vec3>(Spare, glm::vec3(0.0f));
};
}

#endif
