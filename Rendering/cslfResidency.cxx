// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfResidency.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

namespace cslf
{
namespace
{
constexpr TileSet SetOf(int tile)
{
  return static_cast<TileSet>(1 << tile);
}

bool Holds(TileSet set, TileSet subset)
{
  return (set & subset) == subset;
}

/// The tiles through which lines of sight may leave: all of them, or only those where some may meet
/// the scene.
TileSet FindTilesOf(int face, const std::vector<ViewFrustum>& frustums, bool onlyThroughScene)
{
  TileSet tiles = 0;
  for (const ViewFrustum& frustum : frustums)
  {
    for (int tile = 0; tile < TileCount && frustum.CanEnter(face); ++tile)
    {
      const int exit = ExitFaceOf(face, tile);
      if (frustum.CanLeave(face, exit) &&
        (!onlyThroughScene || frustum.PassesThrough(exit, glm::dvec2(-1.0), glm::dvec2(1.0))))
      {
        tiles |= SetOf(tile);
      }
    }
  }
  return tiles;
}
}

Residency::Residency(const Layout& grid, int blocks, int slots)
  : Grid(grid)
  , Levels(grid.GetViewpoints())
  , Slots(slots)
  , Owners(blocks)
{
  const int viewpoints = grid.GetViewpoints() * grid.GetViewpoints();
  for (FaceState& face : this->Faces)
  {
    face.Slots.assign(viewpoints, -1);
    face.Viewpoints.assign(slots, -1);
    face.Present.assign(viewpoints, 0);
    face.Damaged.assign(viewpoints, false);
  }
}

int Residency::CountBlocks(const std::vector<ViewFrustum>& frustums)
{
  int blocks = 0;
  for (int face = 0; face < FaceCount; ++face)
  {
    const TileSet tiles = FindTilesOf(face, frustums, false);
    for (int tile = 0; tile < TileCount; ++tile)
    {
      blocks += Holds(tiles, SetOf(tile)) ? 1 : 0;
    }
  }
  return blocks;
}

// What a camera sees is found once while it stays.
void Residency::FindSights(const std::vector<ViewFrustum>& frustums)
{
  std::vector<Sight> sights;
  for (const ViewFrustum& frustum : frustums)
  {
    const auto isSame = [&](const Sight& sight) { return sight.Frustum == frustum; };
    if (std::any_of(sights.begin(), sights.end(), isSame))
    {
      continue;
    }
    const auto known = std::find_if(this->Sights.begin(), this->Sights.end(), isSame);
    if (known != this->Sights.end())
    {
      sights.push_back(std::move(*known));
      this->Sights.erase(known);
      continue;
    }
    sights.push_back({ frustum, {} });
    for (int face = 0; face < FaceCount; ++face)
    {
      sights.back().Seen[face] = this->FindSeen(frustum, face);
    }
  }
  this->Sights = std::move(sights);
}

void Residency::Aim(const std::vector<ViewFrustum>& frustums)
{
  this->FindSights(frustums);
  for (int face = 0; face < FaceCount; ++face)
  {
    this->Faces[face].Wanted = FindTilesOf(face, frustums, false);
    this->Faces[face].Required = FindTilesOf(face, frustums, true);
  }
  this->AssignBlocks();
  for (int face = 0; face < FaceCount; ++face)
  {
    this->FindViewpoints(face);
    this->AssignSlots(this->Faces[face]);
  }
}

//------------------------------------------------------------------------------
// Room

void Residency::AssignBlocks()
{
  const auto isWanted = [this](const BlockOwner& owner)
  { return owner.Face >= 0 && Holds(this->Faces[owner.Face].Wanted, SetOf(owner.Tile)); };
  for (int face = 0; face < FaceCount; ++face)
  {
    for (int tile = 0; tile < TileCount; ++tile)
    {
      if (!Holds(this->Faces[face].Wanted, SetOf(tile)) || this->Faces[face].Blocks[tile] >= 0)
      {
        continue;
      }
      auto found = std::find_if(this->Owners.begin(), this->Owners.end(),
        [](const BlockOwner& owner) { return owner.Face < 0; });
      if (found == this->Owners.end())
      {
        found = std::find_if_not(this->Owners.begin(), this->Owners.end(), isWanted);
      }
      const int block = static_cast<int>(found - this->Owners.begin());
      this->FreeBlock(block);
      this->Owners[block] = { face, tile };
      this->Faces[face].Blocks[tile] = block;
    }
  }
}

void Residency::FreeBlock(int block)
{
  const BlockOwner owner = std::exchange(this->Owners[block], {});
  if (owner.Face >= 0)
  {
    FaceState& face = this->Faces[owner.Face];
    face.Blocks[owner.Tile] = -1;
    for (TileSet& present : face.Present)
    {
      present &= static_cast<TileSet>(~SetOf(owner.Tile));
    }
  }
}

// The viewpoints of the cells through which lines of sight enter, and of their neighbours, because
// lookups that do not know the surface show errors up to this far around the scene.
Residency::SeenViewpoints Residency::FindSeen(const ViewFrustum& frustum, int face) const
{
  if (!frustum.CanEnter(face))
  {
    return {};
  }
  const int side = this->Grid.GetViewpoints();
  SeenViewpoints seen(side * side, 0);
  for (int level = 0; level < this->Levels.GetCount(); ++level)
  {
    const std::vector<int>& nodes = this->Levels.GetNodes(level);
    const int cells = static_cast<int>(nodes.size()) - 1;
    std::vector<glm::dvec2> ranges; // of a cell and its neighbours, along either side
    ranges.reserve(nodes.size());
    for (int cell = 0; cell < cells; ++cell)
    {
      ranges.emplace_back(this->Grid.NodeCoordinate(nodes[std::max(cell - 1, 0)]),
        this->Grid.NodeCoordinate(nodes[std::min(cell + 2, cells)]));
    }
    for (int b = 0; b < cells; ++b)
    {
      for (int a = 0; a < cells; ++a)
      {
        if (frustum.PassesThrough(face, { ranges[a].x, ranges[b].x }, { ranges[a].y, ranges[b].y }))
        {
          for (int corner = 0; corner < 4; ++corner)
          {
            seen[nodes[b + corner / 2] * side + nodes[a + corner % 2]] = 1;
          }
        }
      }
    }
  }
  return seen;
}

double Residency::DistanceToGaze(int slice) const
{
  const glm::dvec3 position = this->Grid.ViewpointPosition(this->Grid.ViewpointOf(slice));
  double distance = std::numeric_limits<double>::max();
  for (const Sight& sight : this->Sights)
  {
    distance = std::min(distance, glm::distance(position, sight.Frustum.GetGaze()));
  }
  return distance;
}

void Residency::FindViewpoints(int face)
{
  FaceState& state = this->Faces[face];
  state.Order.clear();
  if (state.Wanted == 0)
  {
    return;
  }
  SeenViewpoints seen(state.Slots.size(), 0);
  for (const Sight& sight : this->Sights)
  {
    const SeenViewpoints& more = sight.Seen[face];
    std::transform(more.begin(), more.end(), seen.begin(), seen.begin(), std::bit_or<>());
  }
  for (int viewpoint = 0; viewpoint < static_cast<int>(seen.size()); ++viewpoint)
  {
    if (seen[viewpoint])
    {
      state.Order.push_back(viewpoint);
    }
  }
  if (static_cast<int>(state.Order.size()) > this->Slots)
  {
    this->SortByImportance(face, state.Order);
  }
}

void Residency::SortByImportance(int face, std::vector<int>& viewpoints) const
{
  const int side = this->Grid.GetViewpoints();
  std::vector<std::pair<std::pair<int, double>, int>> keys;
  for (int viewpoint : viewpoints)
  {
    const int level = this->Levels.LevelOf(viewpoint % side, viewpoint / side);
    const double distance = this->DistanceToGaze(face * side * side + viewpoint);
    keys.push_back({ { level, distance }, viewpoint });
  }
  std::sort(keys.begin(), keys.end());
  std::transform(
    keys.begin(), keys.end(), viewpoints.begin(), [](const auto& key) { return key.second; });
}

void Residency::AssignSlots(FaceState& face) const
{
  face.Order.resize(std::min(face.Order.size(), static_cast<std::size_t>(this->Slots)));
  std::vector<bool> isWanted(face.Slots.size(), false);
  for (int viewpoint : face.Order)
  {
    isWanted[viewpoint] = true;
  }
  // Empty slots first, so that other viewpoints stay while there is space.
  std::vector<int> slots;
  for (const bool isEmpty : { true, false })
  {
    for (int slot = 0; slot < this->Slots; ++slot)
    {
      const int holder = face.Viewpoints[slot];
      if (isEmpty ? holder < 0 : holder >= 0 && !isWanted[holder])
      {
        slots.push_back(slot);
      }
    }
  }
  auto next = slots.begin();
  for (int viewpoint : face.Order)
  {
    if (face.Slots[viewpoint] >= 0)
    {
      continue;
    }
    const int slot = *next++;
    const int previous = std::exchange(face.Viewpoints[slot], viewpoint);
    if (previous >= 0)
    {
      face.Slots[previous] = -1;
      face.Present[previous] = 0;
    }
    face.Slots[viewpoint] = slot;
    face.Present[viewpoint] = 0;
  }
}

//------------------------------------------------------------------------------
// Coming and going

std::vector<WantedTiles> Residency::ListMissing() const
{
  const int perFace = this->Grid.GetViewpoints() * this->Grid.GetViewpoints();
  std::vector<std::pair<std::pair<bool, double>, WantedTiles>> found;
  for (int face = 0; face < FaceCount; ++face)
  {
    const FaceState& state = this->Faces[face];
    for (int viewpoint : state.Order)
    {
      const TileSet missing = static_cast<TileSet>(state.Wanted & ~state.Present[viewpoint]);
      if (missing != 0 && !state.Damaged[viewpoint])
      {
        const Viewpoint place = this->Grid.ViewpointOf(face * perFace + viewpoint);
        const WantedTiles wanted{ face * perFace + viewpoint,
          this->Levels.LevelOf(place.I, place.J), missing };
        found.push_back({ { wanted.Level > 0, this->DistanceToGaze(wanted.Slice) }, wanted });
      }
    }
  }
  std::sort(
    found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<WantedTiles> missing;
  missing.reserve(found.size());
  for (const auto& entry : found)
  {
    missing.push_back(entry.second);
  }
  return missing;
}

int Residency::GetSlot(int slice) const
{
  const int perFace = this->Grid.GetViewpoints() * this->Grid.GetViewpoints();
  return this->Faces[slice / perFace].Slots[slice % perFace];
}

void Residency::SetPresent(int slice, TileSet tiles)
{
  const int perFace = this->Grid.GetViewpoints() * this->Grid.GetViewpoints();
  this->Faces[slice / perFace].Present[slice % perFace] |= tiles;
}

void Residency::SetDamaged(int slice)
{
  const int perFace = this->Grid.GetViewpoints() * this->Grid.GetViewpoints();
  this->Faces[slice / perFace].Damaged[slice % perFace] = true;
}

//------------------------------------------------------------------------------
// What the shader gets

Residency::Corners Residency::FindCorners(int level, int i, int j) const
{
  const std::vector<int>& nodes = this->Levels.GetNodes(level);
  const int a = this->Levels.FindInterval(level, i);
  const int b = this->Levels.FindInterval(level, j);
  const int side = this->Grid.GetViewpoints();
  Corners corners{ {}, nodes[a], nodes[b], nodes[a + 1], nodes[b + 1] };
  corners.Viewpoints = { corners.LowerV * side + corners.LowerU,
    corners.LowerV * side + corners.UpperU, corners.UpperV * side + corners.LowerU,
    corners.UpperV * side + corners.UpperU };
  return corners;
}

bool Residency::IsUsable(const FaceState& face, int viewpoint) const
{
  return face.Present[viewpoint] != 0 && Holds(face.Present[viewpoint], face.Required);
}

// The finest level with all viewpoints. If there is none, a level that lacks only damaged ones.
Residency::Corners Residency::ChooseCorners(const FaceState& face, int i, int j) const
{
  const auto isUsable = [&](int viewpoint) { return this->IsUsable(face, viewpoint); };
  const auto isSettled = [&](int viewpoint)
  { return face.Damaged[viewpoint] || this->IsUsable(face, viewpoint); };
  const int finest = this->Levels.GetCount() - 1;
  for (int level = finest; level >= 0; --level)
  {
    const Corners corners = this->FindCorners(level, i, j);
    if (std::all_of(corners.Viewpoints.begin(), corners.Viewpoints.end(), isUsable))
    {
      return corners;
    }
  }
  for (int level = finest; level >= 0; --level)
  {
    const Corners corners = this->FindCorners(level, i, j);
    if (std::all_of(corners.Viewpoints.begin(), corners.Viewpoints.end(), isSettled))
    {
      return corners;
    }
  }
  return this->FindCorners(finest, i, j);
}

Residency::Table Residency::MakeTable(int face) const
{
  const FaceState& state = this->Faces[face];
  const int cells = this->Grid.GetBaseNodes() - 1;
  std::vector<int> intervals;
  intervals.reserve(this->Grid.GetBaseNodes());
  for (int cell = 0; cell < cells; ++cell)
  {
    intervals.push_back(this->Grid.FindNodes(-1.0 + 2.0 * (cell + 0.5) / cells).Lower);
  }
  Table table;
  table.Tiles = state.Wanted;
  table.Cells.reserve(static_cast<std::size_t>(8) * cells * cells);
  for (int j : intervals)
  {
    for (int i : intervals)
    {
      const Corners corners = this->ChooseCorners(state, i, j);
      for (int viewpoint : corners.Viewpoints)
      {
        const bool isUsable = this->IsUsable(state, viewpoint);
        table.Cells.push_back(static_cast<float>(isUsable ? state.Slots[viewpoint] : Absent));
        table.Tiles &= isUsable ? state.Present[viewpoint] : table.Tiles;
      }
      for (int node : { corners.LowerU, corners.LowerV, corners.UpperU, corners.UpperV })
      {
        table.Cells.push_back(static_cast<float>(this->Grid.NodeCoordinate(node)));
      }
    }
  }
  return table;
}
}
