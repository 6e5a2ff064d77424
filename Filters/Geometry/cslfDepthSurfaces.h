// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The surfaces that a viewpoint sees in one tile.
 */
#ifndef cslfDepthSurfaces_h
#define cslfDepthSurfaces_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfDepthViews.h"
#include "cslfTileFrame.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace cslf
{
/// The inverse depths of a tile, which texels are parts of one surface, and its plane in each
/// texel.
class VTKCSLF_EXPORT DepthSurfaces
{
public:
  DepthSurfaces(const DepthViews& views, int view, int tile);

  const TileFrame& GetFrame() const { return this->Frame; }
  int GetResolution() const { return this->Resolution; }

  std::size_t IndexOf(int x, int y) const
  {
    return static_cast<std::size_t>(y) * this->Resolution + x;
  }

  /// Whether a texel sees a surface.
  bool IsSurface(std::size_t texel) const { return this->Inverse[texel] > 0.0f; }

  /// 1 over depth; above 0 for surfaces.
  float GetInverseDepth(std::size_t texel) const { return this->Inverse[texel]; }

  /// The change of inverse depth per texel.
  const glm::vec2& GetSlope(std::size_t texel) const { return this->Slopes[texel]; }

  ///@{
  /// Whether a texel is a part of the same surface as the next one in its row or column.
  bool IsLinkedRight(std::size_t texel) const { return this->Right[texel] != 0; }
  bool IsLinkedDown(std::size_t texel) const { return this->Down[texel] != 0; }
  ///@}

  /// Whether the four texels beside a texel are parts of the same surface, or beyond the tile.
  bool IsInside(int x, int y) const;

  /// The plane of a texel's surface: the normal that has the scalar product 1 with its points from
  /// the viewpoint, in CC.
  glm::dvec3 GetNormal(int x, int y) const;

  /// The plane for other viewpoints.
  SurfacePlane GetPlane(int x, int y) const;

private:
  void Link();
  void FindSlopes();

  TileFrame Frame;
  int Resolution;
  std::vector<float> Inverse;
  std::vector<glm::vec2> Slopes;
  std::vector<char> Right;
  std::vector<char> Down;
};
}

#endif
