// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceLattice.h"

#include "PathTracing/cslfVectorize.h"

namespace cslf
{
/// Where the points of a packet are: in which bricks, and where in them.
struct SurfaceLattice::PacketPlaces
{
  alignas(64) int First[LatticePacket::Size];
  alignas(64) int Level[LatticePacket::Size]; // below 0 where there are no splits along edges
  alignas(64) float U[LatticePacket::Size];
  alignas(64) float V[LatticePacket::Size];
};

SurfaceLattice::SurfaceLattice(const std::vector<std::uint8_t>& splits)
{
  this->Triangles.reserve(splits.size());
  std::size_t bricks = 0;
  for (std::uint8_t split : splits)
  {
    this->Triangles.push_back({ static_cast<std::uint32_t>(bricks), split });
    bricks += std::size_t(2) << (2 * split);
  }
  this->NumberOfRoots = bricks;
  this->Bricks.resize(bricks);
  this->Values.emplace_back(0.0f);
}

SurfaceLattice SurfaceLattice::MakeEmpty() const
{
  SurfaceLattice empty;
  empty.Triangles = this->Triangles;
  empty.NumberOfRoots = this->NumberOfRoots;
  empty.Bricks.resize(this->NumberOfRoots);
  empty.Values.emplace_back(0.0f);
  return empty;
}

void SurfaceLattice::SetBrick(
  std::size_t index, std::uint32_t level, const std::vector<glm::vec3>& values)
{
  this->Bricks[index] = { static_cast<std::uint32_t>(this->Values.size()), level };
  this->Values.insert(this->Values.end(), values.begin(), values.end());
}

std::size_t SurfaceLattice::SplitBrick(std::size_t index)
{
  const std::size_t first = this->Bricks.size();
  this->Bricks[index] = { static_cast<std::uint32_t>(first), Split };
  this->Bricks.resize(first + 4);
  return first;
}

void SurfaceLattice::Get(LatticePacket& packet) const
{
  PacketPlaces places;
  int split = GoToBricks(this->Triangles.data(), this->Bricks.data(), packet, places);
  while (split)
  {
    split = GoToParts(this->Bricks.data(), places);
  }
  Interpolate(this->Values.data(), places, packet);
}

CSLF_VECTORIZE int SurfaceLattice::GoToBricks(
  const Triangle* triangles, const Brick* bricks, const LatticePacket& packet, PacketPlaces& places)
{
  int split = 0;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    const int wanted = packet.Wanted[lane];
    const int triangle = static_cast<int>(packet.Triangle[lane]) & wanted;
    const int splits = 1 << triangles[triangle].Depth;
    const LatticeCell cell(packet.U[lane], packet.V[lane], splits);
    const int index =
      CellIndex(cell.I, cell.J, cell.Flipped, splits) + packet.Back[lane] * splits * splits;
    const int brick = static_cast<int>(triangles[triangle].FirstBrick) + (index & wanted);
    const int level = static_cast<int>(bricks[brick].Level);
    places.First[lane] = static_cast<int>(bricks[brick].First);
    places.Level[lane] = level;
    places.U[lane] = cell.U;
    places.V[lane] = cell.V;
    split |= (level == static_cast<int>(Split) ? -1 : 0) & wanted;
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

CSLF_VECTORIZE void SurfaceLattice::Interpolate(
  const glm::vec3* values, const PacketPlaces& places, LatticePacket& packet)
{
  const float* components = &values->x;
  CSLF_LANE_LOOP
  for (int lane = 0; lane < LatticePacket::Size; ++lane)
  {
    // A brick of one value is a lattice whose points are all the first.
    const int varies = places.Level[lane] < 0 ? 0 : -1;
    const int splits = 1 << (places.Level[lane] & varies);
    const LatticeCell cell(places.U[lane], places.V[lane], splits);
    const int flip = cell.Flipped;
    const int first = places.First[lane] & packet.Wanted[lane];
    const int inside = varies & packet.Wanted[lane];
    const int a = 3 * (first + (PointIndex(cell.I + flip, cell.J + flip, splits) & inside));
    const int b = 3 * (first + (PointIndex(cell.I + 1 - flip, cell.J + flip, splits) & inside));
    const int c = 3 * (first + (PointIndex(cell.I + flip, cell.J + 1 - flip, splits) & inside));
    const float w = 1.0f - cell.U - cell.V;
    packet.Red[lane] = w * components[a] + cell.U * components[b] + cell.V * components[c];
    packet.Green[lane] =
      w * components[a + 1] + cell.U * components[b + 1] + cell.V * components[c + 1];
    packet.Blue[lane] =
      w * components[a + 2] + cell.U * components[b + 2] + cell.V * components[c + 2];
  }
}
}
