// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where each sample of the discretised light field lies in the image data (paper, section 3.2).
 *
 * One z slice is one viewpoint, z = (face M + j) M + i, and holds a strip of five N x N tiles: the
 * exit faces in ascending order with the entry face left out. Viewpoints are node-centred, texels
 * cell-centred.
 */
#ifndef cslfLayout_h
#define cslfLayout_h

#include "cslfCube.h"

#include <cstddef>
#include <vector>

namespace cslf
{
/// A ray leaves through one of the five faces that it did not enter by.
constexpr int TileCount = FaceCount - 1;

/// The tile of an exit face in the strip of a viewpoint on the entry face.
constexpr int TileOf(int entryFace, int exitFace)
{
  return exitFace < entryFace ? exitFace : exitFace - 1;
}

/// The exit face of a tile in the strip of a viewpoint on the entry face.
constexpr int ExitFaceOf(int entryFace, int tile)
{
  return tile < entryFace ? tile : tile + 1;
}

/// A viewpoint: its entry face and its indices along u and v.
struct Viewpoint
{
  int Face = 0;
  int I = 0;
  int J = 0;
};

/// A viewpoint, by its slice, at one of the field's times: what a frame of a file contains. A slice
/// alone is that of the first time.
struct FrameId
{
  int Time = 0;
  int Slice = 0;

  constexpr FrameId() = default;
  constexpr FrameId(int slice, int time = 0)
    : Time(time)
    , Slice(slice)
  {
  }

  constexpr bool operator==(FrameId other) const
  {
    return this->Time == other.Time && this->Slice == other.Slice;
  }
  constexpr bool operator<(FrameId other) const
  {
    return this->Time < other.Time || (this->Time == other.Time && this->Slice < other.Slice);
  }
};

/// Two neighbouring kept nodes around a coordinate, and the weight of the upper one in [0,1].
struct NodeBracket
{
  int Lower = 0;
  int Upper = 0;
  double Weight = 0.0;
};

///@{
/// The upper limits of a grid.
constexpr int MaximumBaseNodes = 65536;
constexpr int MaximumViewpoints = 1024; ///< M, along each side of a face
constexpr int MaximumResolution = 8192; ///< N, texels along each side of a tile
///@}

/// The indices, along one side, of the coarsest grid nested in one of `viewpoints` per side: the
/// ends, and the middle (odd numbers) or the thirds (even numbers), which divide it symmetrically.
VTKCSLF_EXPORT std::vector<int> CoarsestNodes(int viewpoints);

/// The grid of viewpoints and texels.
class VTKCSLF_EXPORT Layout
{
public:
  Layout() = default;

  /// All M x M nodes of a grid (M >= 2), N x N texels a tile (N >= 1).
  Layout(int viewpoints, int resolution);

  /// The kept nodes of a base grid of `baseNodes` a side: ascending, from 0 to baseNodes - 1, and
  /// symmetric, so that the grids of neighbouring faces meet whichever way their axes run.
  Layout(int baseNodes, std::vector<int> nodes, int resolution);

  /// Whether the node list and the sizes obey the conventions and are within their limits.
  bool IsValid() const;

  int GetBaseNodes() const { return this->BaseNodes; }
  const std::vector<int>& GetNodes() const { return this->Nodes; }

  /// M: the viewpoints along each side of a face.
  int GetViewpoints() const { return static_cast<int>(this->Nodes.size()); }

  /// N: the texels along each side of a tile.
  int GetResolution() const { return this->Resolution; }

  /// 6 M^2: the number of slices.
  int GetSlices() const { return FaceCount * this->GetViewpoints() * this->GetViewpoints(); }

  /// 5 N: the width of a slice.
  int GetStripWidth() const { return TileCount * this->Resolution; }

  /// 5 N x N: the texels of a slice.
  std::size_t GetStripTexels() const
  {
    return static_cast<std::size_t>(this->GetStripWidth()) * this->Resolution;
  }

  /// The whole extent of the image data, in VTK's order.
  void GetWholeExtent(int extent[6]) const;

  int SliceOf(const Viewpoint& viewpoint) const;
  Viewpoint ViewpointOf(int slice) const;

  /// The in-face coordinate, in [-1,1], of the kept node `index`.
  double NodeCoordinate(int index) const;

  /// The in-face coordinate, in (-1,1), of the centre of texel `index`.
  double TexelCoordinate(int index) const;

  /// The kept nodes around an in-face coordinate, which is clamped to [-1,1].
  NodeBracket FindNodes(double coordinate) const;

  /// The position of a viewpoint in CC.
  glm::dvec3 ViewpointPosition(const Viewpoint& viewpoint) const;

  bool operator==(const Layout& other) const;
  bool operator!=(const Layout& other) const { return !(*this == other); }

private:
  int BaseNodes = 2;
  std::vector<int> Nodes{ 0, 1 };
  int Resolution = 1;
};
}

#endif
