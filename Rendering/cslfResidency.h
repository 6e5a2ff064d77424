// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Manages which samples of a light field are kept in graphics memory, and where.
 */
#ifndef cslfResidency_h
#define cslfResidency_h

#include "Lookup/cslfLookupConstants.h"
#include "cslfLayout.h"
#include "cslfViewFrustum.h"
#include "cslfViewpointLevels.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cslf
{
/// A set of tiles of a strip, one bit each.
using TileSet = std::uint8_t;

/// Samples that should be in graphics memory but are not.
struct WantedTiles
{
  int Slice = 0;
  int Level = 0; ///< of ViewpointLevels
  TileSet Tiles = 0;
};

/// Graphics memory is divided into blocks. A block contains one tile of each of some viewpoints of
/// one entry face: the tile of one exit face. All blocks of an entry face contain the same
/// viewpoints in the same slots. Cameras outside the cube need at most nine blocks.
///
/// Viewpoints come level by level. A cell of the grid of viewpoints uses the finest level whose
/// viewpoints around the cell are all stored.
class VTKCSLF_EXPORT Residency
{
public:
  /// The number of blocks for one camera outside the cube.
  static constexpr int MinimumBlocks = 9;
  /// Means that a viewpoint or block is missing.
  static constexpr int Absent = static_cast<int>(lookup::AbsentSlot);

  Residency() = default;

  /// Begins empty. `slots` is the number of slots per block, at least 4.
  Residency(const Layout& grid, int blocks, int slots);

  /// The blocks that these cameras need together.
  static int CountBlocks(const std::vector<ViewFrustum>& frustums);

  int GetBlocks() const { return static_cast<int>(this->Owners.size()); }
  int GetSlots() const { return this->Slots; }

  /// The number of viewpoints along a side of a face that belong to a level or a coarser one.
  int CountNodes(int level) const { return static_cast<int>(this->Levels.GetNodes(level).size()); }

  /// Makes space for the samples that these cameras can use together. Other samples stay if there
  /// is space.
  void Aim(const std::vector<ViewFrustum>& frustums);

  /// The samples to upload, the most urgent first: the coarsest level, then samples near the points
  /// that the cameras look at.
  std::vector<WantedTiles> ListMissing() const;

  /// The place of a viewpoint's tile.
  int GetSlot(int slice) const;
  int GetBlock(int face, int tile) const { return this->Faces[face].Blocks[tile]; }

  /// Records that a viewpoint's tiles were uploaded, or that they never will be.
  void SetPresent(int slice, TileSet tiles);
  void SetDamaged(int slice);

  /// For the rays that enter through a face.
  struct Table
  {
    /// For each cell of the base grid, row by row: the slots of the viewpoints at its lower corner,
    /// at upper u, at upper v and at both, then the coordinates of lower u and v and upper u and v.
    /// The slots of missing viewpoints are Absent.
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
    std::vector<int> Order; ///< wanted viewpoints, by importance if there is not space for all
    TileSet Wanted = 0;     ///< lines of sight may leave through these
    TileSet Required = 0;   ///< and some that may meet the scene leave through these
  };
  /// The faces of a block's tiles.
  struct BlockOwner
  {
    int Face = -1;
    int Tile = -1;
  };
  /// Whether each viewpoint of a face is seen, 0 or 1; empty if none is.
  using SeenViewpoints = std::vector<std::uint8_t>;
  /// A camera, and what it sees of each face.
  struct Sight
  {
    ViewFrustum Frustum;
    std::array<SeenViewpoints, FaceCount> Seen;
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

  void FindSights(const std::vector<ViewFrustum>& frustums);
  void AssignBlocks();
  void FreeBlock(int block);
  void FindViewpoints(int face);
  void AssignSlots(FaceState& face) const;
  SeenViewpoints FindSeen(const ViewFrustum& frustum, int face) const;
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
  std::vector<Sight> Sights;      ///< of the cameras, each once
};
}

#endif
