// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which samples of a light field are kept in graphics memory, and where.
 */
#ifndef cslfResidency_h
#define cslfResidency_h

#include "cslfLayout.h"
#include "cslfSight.h"
#include "cslfViewpointLevels.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cslf
{
/// A set of the tiles of a strip, a bit for each.
using TileSet = std::uint8_t;

/// Samples that are wanted in graphics memory but not there.
struct WantedTiles
{
  int Slice = 0;
  int Level = 0; ///< of ViewpointLevels
  TileSet Tiles = 0;
};

/// Graphics memory is divided into blocks. A block holds one tile of each of some viewpoints: those
/// of one entry face, and what they see of one exit face. All blocks of a face hold the same
/// viewpoints in the same slots. Cameras outside the cube need at most nine blocks.
///
/// Viewpoints come level by level. A cell of the grid of viewpoints is looked up in the finest
/// level whose viewpoints around it are all there.
class VTKCSLF_EXPORT Residency
{
public:
  /// What one camera outside the cube needs.
  static constexpr int LeastBlocks = 9;
  /// Tells the shader that there is nothing. Far enough below 0 to stay so whatever is added.
  static constexpr int Absent = -1000000;

  Residency() = default;

  /// Nothing is there. `slots` are those of each block; at least 4.
  Residency(const Layout& grid, int blocks, int slots);

  /// The blocks that these cameras need together.
  static int CountBlocks(const std::vector<Sight>& sights);

  int GetBlocks() const { return static_cast<int>(this->Owners.size()); }
  int GetSlots() const { return this->Slots; }

  /// How many viewpoints along a side of a face belong to a level or a coarser one.
  int CountNodes(int level) const { return static_cast<int>(this->Levels.GetNodes(level).size()); }

  /// Makes room for what these cameras can use. What others used before stays where there is room.
  void Aim(const std::vector<Sight>& sights);

  /// What is to be brought, the most urgent first: the coarsest level, then what is near to what
  /// the cameras look at.
  std::vector<WantedTiles> ListMissing() const;

  /// Where a viewpoint's tile belongs.
  int GetSlot(int slice) const;
  int GetBlock(int face, int tile) const { return this->Faces[face].Blocks[tile]; }

  /// Says that a viewpoint's tiles have been brought, or that they never will be.
  void SetPresent(int slice, TileSet tiles);
  void SetDamaged(int slice);

  /// For the rays that enter by a face.
  struct Table
  {
    /// For each cell of the base grid, row by row: the slots of the viewpoints at its lower corner,
    /// at upper u, at upper v and at both, then the coordinates of lower u and v and upper u and v.
    /// The slots of what is not there are Absent.
    std::vector<float> Cells;
    TileSet Tiles = 0; ///< those that can be looked up
  };
  Table MakeTable(int face) const;

private:
  struct FaceState
  {
    std::array<int, TileCount> Blocks{ -1, -1, -1, -1, -1 };
    std::vector<int> Slots;       ///< of each viewpoint, or -1
    std::vector<int> Viewpoints;  ///< of each slot, or -1; unused where all viewpoints fit
    std::vector<TileSet> Present; ///< of each viewpoint
    std::vector<bool> Damaged;    ///< of each viewpoint
    std::vector<int> Order;       ///< viewpoints wanted, by importance where not all have room
    TileSet Wanted = 0;           ///< lines of sight may leave by these
    TileSet Required = 0;         ///< and some that may meet the scene do
  };
  /// Whose tiles a block holds.
  struct BlockOwner
  {
    int Face = -1;
    int Tile = -1;
  };
  /// The viewpoints around a cell, in the order of Table.
  struct Corners
  {
    std::array<int, 4> Viewpoints{};
    int LowerU = 0;
    int LowerV = 0;
    int UpperU = 0;
    int UpperV = 0;
  };

  void AssignBlocks();
  void FreeBlock(int block);
  void FindViewpoints(int face);
  void AssignSlots(FaceState& face) const;
  std::vector<bool> FindSeen(int face) const;
  bool IsSeen(int face, const glm::dvec2& minimum, const glm::dvec2& maximum) const;
  void SortByImportance(int face, std::vector<int>& viewpoints) const;
  double DistanceToGaze(int slice) const;
  Corners FindCorners(int level, int i, int j) const;
  bool IsUsable(const FaceState& face, int viewpoint) const;
  Corners ChooseCorners(const FaceState& face, int i, int j) const;

  Layout Grid;
  ViewpointLevels Levels;
  int Slots = 0;
  std::array<FaceState, FaceCount> Faces;
  std::vector<BlockOwner> Owners; ///< of each block
  std::vector<Sight> Sights;      ///< what it was aimed at
};
}

#endif
