// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceLattice.h"

#include "SIMD/cslfVectorize.h"

#include <glm/vec4.hpp>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace cslf
{
namespace
{
// The bits for the depth of a triangle that is not on a chart.
constexpr std::uint32_t DepthBits = 15;

// Four floats that one instruction loads and scales, in any loop.
#if defined(__GNUC__)
using Float4 = float __attribute__((vector_size(16)));
#else
using Float4 = glm::vec4;
#endif

inline Float4 Load(const float* values)
{
  Float4 result;
  std::memcpy(&result, values, sizeof(result));
  return result;
}

inline void Store(const Float4& value, float* values)
{
  std::memcpy(values, &value, sizeof(value));
}
}

void SurfaceLattice::RequireIndex(std::size_t index)
{
  if (index > MaximumIndex)
  {
    throw std::length_error("the scene needs a radiance cache of more than two thousand million "
                            "values: use path tracing");
  }
}

/// The positions of a packet's points: their bricks, and their places in them.
struct SurfaceLattice::PacketPlaces
{
  alignas(64) int First[LatticePacket::Size];
  alignas(64) int Level[LatticePacket::Size]; // negative if there are no splits along edges
  alignas(64) float U[LatticePacket::Size];
  alignas(64) float V[LatticePacket::Size];
};

/// The values between which the points of a packet lie, and their weights.
struct SurfaceLattice::PacketCorners
{
  alignas(64) int A[LatticePacket::Size]; // their indices
  alignas(64) int B[LatticePacket::Size];
  alignas(64) int C[LatticePacket::Size];
  alignas(64) float W[LatticePacket::Size];
  alignas(64) float U[LatticePacket::Size];
  alignas(64) float V[LatticePacket::Size];
};

SurfaceLattice::SurfaceLattice(
  const std::vector<std::uint8_t>& splits, const std::vector<LatticeChart>& charts)
{
  this->Triangles.resize(splits.size(), { 0, 0 });
  std::size_t bricks = 0;
  for (const LatticeChart& chart : charts)
  {
    for (const LatticeChart::Member& member : chart.Members)
    {
      this->Triangles[member.Triangle].Depth =
        OnChart + static_cast<std::uint32_t>(this->Placements.size());
      this->Placements.push_back(
        { member.Corner, member.AlongU, member.AlongV, chart.Columns, chart.Rows });
    }
  }
  for (std::size_t index = 0; index < splits.size(); ++index)
  {
    Triangle& triangle = this->Triangles[index];
    if (triangle.Depth < OnChart)
    {
      triangle = { static_cast<std::uint32_t>(bricks), splits[index] };
      bricks += std::size_t(2) << (2 * splits[index]);
    }
  }
  for (const LatticeChart& chart : charts)
  {
    const std::uint32_t side = 2 * chart.Columns * chart.Rows;
    this->Charts.push_back({ static_cast<std::uint32_t>(bricks), side });
    for (const LatticeChart::Member& member : chart.Members)
    {
      this->Triangles[member.Triangle].FirstBrick = static_cast<std::uint32_t>(bricks);
    }
    bricks += std::size_t(2) * side;
  }
  RequireIndex(bricks);
  this->NumberOfRoots = bricks;
  this->Bricks.resize(bricks);
  this->Values.resize(1 + Spare, glm::vec3(0.0f));
}

SurfaceLattice SurfaceLattice::MakeEmpty() const
{
  SurfaceLattice empty;
  empty.Triangles = this->Triangles;
  empty.Placements = this->Placements;
  empty.Charts = this->Charts;
  empty.NumberOfRoots = this->NumberOfRoots;
  empty.Bricks.resize(this->NumberOfRoots);
  empty.Values.resize(1 + Spare, glm::vec3(0.0f));
  return empty;
}

void SurfaceLattice::SetBrick(
  std::size_t index, std::uint32_t level, const std::vector<glm::vec3>& values)
{
  RequireIndex(this->GetNumberOfValues() + values.size());
  this->Bricks[index] = { static_cast<std::uint32_t>(this->GetNumberOfValues()), level };
  this->Values.insert(this->Values.end() - Spare, values.begin(), values.end());
}

std::size_t SurfaceLattice::SplitBrick(std::size_t index)
{
  const std::size_t first = this->Bricks.size();
  RequireIndex(first + 4);
  this->Bricks[index] = { static_cast<std::uint32_t>(first), Split };
  this->Bricks.resize(first + 4);
  return first;
}

void SurfaceLattice::Get(LatticePacket& packet) const
{
  PacketPlaces places;
  int split = GoToBricks(
    this->Triangles.data(), this->Placements.data(), this->Bricks.data(), packet, places);
  while (split)
  {
    split = GoToParts(this->Bricks.data(), places);
  }
  PacketCorners corners;
  FindCorners(places, corners);
  Interpolate(this->Values.data(), corners, packet);
}

CSLF_VECTORIZE int SurfaceLattice::GoToBricks(const Triangle* triangles,
  const Placement* placements, const Brick* bricks, const LatticePacket& packet,
  PacketPlaces& places)
{
  alignas(64) std::uint32_t firstBrick[LatticePacket::Size];
  alignas(64) std::uint32_t depth[LatticePacket::Size];
  std::uint32_t differences = 0;
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    differences |= packet.Triangle[lane] ^ packet.Triangle[0];
  }
  std::uint32_t depths = 0;
  if (differences == 0)
  {
    const Triangle triangle = triangles[packet.Triangle[0]];
    std::fill_n(firstBrick, LatticePacket::Size, triangle.FirstBrick);
    std::fill_n(depth, LatticePacket::Size, triangle.Depth);
    depths = triangle.Depth;
  }
  for (int lane = 0; differences != 0 && lane < LatticePacket::Size; ++lane)
  {
    firstBrick[lane] = triangles[packet.Triangle[lane]].FirstBrick;
    depth[lane] = triangles[packet.Triangle[lane]].Depth;
    depths |= depth[lane];
  }
  alignas(64) int indices[LatticePacket::Size];
  CSLF_LANE_LOOP
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    const int splits = 1 << (depth[lane] & DepthBits);
    const LatticeCell cell(packet.U[lane], packet.V[lane], splits);
    const int index =
      CellIndex(cell.I, cell.J, cell.Flipped, splits) + packet.Back[lane] * splits * splits;
    indices[lane] = static_cast<int>(firstBrick[lane]) + index;
    places.U[lane] = cell.U;
    places.V[lane] = cell.V;
  }
  for (int lane = 0; depths >= OnChart && lane < LatticePacket::Size; ++lane)
  {
    if (depth[lane] >= OnChart)
    {
      const Place place = FindOnChart({ firstBrick[lane], depth[lane] }, placements,
        packet.Back[lane] != 0, packet.U[lane], packet.V[lane]);
      indices[lane] = static_cast<int>(place.Root);
      places.U[lane] = place.U;
      places.V[lane] = place.V;
    }
  }
  int split = 0;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    const Brick& brick = bricks[indices[lane]];
    const int level = static_cast<int>(brick.Level);
    places.First[lane] = static_cast<int>(brick.First);
    places.Level[lane] = level;
    split |= level == static_cast<int>(Split) ? -1 : 0;
  }
  return split;
}

CSLF_VECTORIZE int SurfaceLattice::GoToParts(const Brick* bricks, PacketPlaces& places)
{
  int split = 0;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    const int isSplit = places.Level[lane] == static_cast<int>(Split) ? -1 : 0;
    const LatticeCell cell(places.U[lane], places.V[lane], 2);
    const int part = CellIndex(cell.I, cell.J, cell.Flipped, 2);
    const int brick = (places.First[lane] + part) & isSplit;
    const int first = static_cast<int>(bricks[brick].First);
    const int level = static_cast<int>(bricks[brick].Level);
    places.First[lane] = isSplit ? first : places.First[lane];
    places.Level[lane] = isSplit ? level : places.Level[lane];
    places.U[lane] = isSplit ? cell.U : places.U[lane];
    places.V[lane] = isSplit ? cell.V : places.V[lane];
    split |= level == static_cast<int>(Split) ? isSplit : 0;
  }
  return split;
}

CSLF_VECTORIZE void SurfaceLattice::FindCorners(const PacketPlaces& places, PacketCorners& corners)
{
  CSLF_LANE_LOOP
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    // A brick with one value is a lattice whose points are all the first.
    const int varies = places.Level[lane] < 0 ? 0 : -1;
    const int splits = 1 << (places.Level[lane] & varies);
    const LatticeCell cell(places.U[lane], places.V[lane], splits);
    const int flip = cell.Flipped;
    const int first = places.First[lane];
    corners.A[lane] = first + (PointIndex(cell.I + flip, cell.J + flip, splits) & varies);
    corners.B[lane] = first + (PointIndex(cell.I + 1 - flip, cell.J + flip, splits) & varies);
    corners.C[lane] = first + (PointIndex(cell.I + flip, cell.J + 1 - flip, splits) & varies);
    corners.U[lane] = cell.U;
    corners.V[lane] = cell.V;
    corners.W[lane] = 1.0f - cell.U - cell.V;
  }
}

CSLF_VECTORIZE void SurfaceLattice::Interpolate(
  const glm::vec3* values, const PacketCorners& corners, LatticePacket& packet)
{
  // The fourth number is that of the next value or the spare one, and is not used.
  const float* components = &values->x;
  alignas(64) float sums[LatticePacket::Size][4];
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    const Float4 a = Load(components + 3 * std::ptrdiff_t(corners.A[lane]));
    const Float4 b = Load(components + 3 * std::ptrdiff_t(corners.B[lane]));
    const Float4 c = Load(components + 3 * std::ptrdiff_t(corners.C[lane]));
    const Float4 sum = corners.W[lane] * a + corners.U[lane] * b + corners.V[lane] * c;
    Store(sum, sums[lane]);
  }
  CSLF_LANE_LOOP
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    packet.Red[lane] = sums[lane][0];
    packet.Green[lane] = sums[lane][1];
    packet.Blue[lane] = sums[lane][2];
  }
}
}
