// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What viewpoints of a field see of its geometry: depth, and the colours that are the same from all
 * directions. Coded files can do without what readers compute in this way.
 */
#ifndef cslfGeometryTexels_h
#define cslfGeometryTexels_h

#include "vtkCSLFModule.h" // for export macro

#include "Geometry/cslfDepthTile.h"
#include "Pipeline/cslfColorMap.h"
#include "cslfLayout.h"

#include <glm/vec4.hpp>

#include <array>
#include <atomic>
#include <cstddef>
#include <vector>

class vtkPolyData;

namespace cslf
{
/// What a viewpoint sees of a geometry.
struct DrawnTexels
{
  /// Red, green and blue, and 255 where they are those of a surface, or 0.
  using Color = glm::vec<4, unsigned char>;

  DrawnTexels(std::size_t texels, bool hasColors)
    : Depths(texels)
    , Colors(hasColors ? texels : 0)
  {
  }

  std::vector<unsigned short> Depths;
  std::vector<Color> Colors; ///< or none
};

class VTKCSLF_EXPORT GeometryTexels
{
public:
  /// The depth of texels whose ray meets no triangle. No other texel has it.
  static constexpr unsigned short None = 65535;

  /// More triangles are not drawn, so that a file cannot ask for any amount of work.
  static constexpr std::size_t MaximumTriangles = std::size_t(1) << 22;

  /// Triangles in world coordinates, with point data `Color`, `BackColor` and `ExactColor`, or
  /// without.
  GeometryTexels(vtkPolyData* triangles, const Cube& box, const Layout& grid);

  const Layout& GetGrid() const { return this->Grid; }

  /// Whether there are exact colours of bytes.
  bool HasColors() const { return !this->Colors[0].empty(); }

  /// Whether all colours are, on both sides.
  bool AreAllExact() const;

  /// Fills the strip of a viewpoint: for each texel, the first triangle that the ray to its centre
  /// meets, as a fraction of the distance to the centre, from 0 to 65534. Triangles have two sides.
  /// Colours, if they are asked for, are those where the ray meets the triangle, if they are exact
  /// at its corners on that side. May be called by several threads at once. Returns false early if
  /// `isStopped` becomes true.
  bool Draw(int slice, DrawnTexels& drawn, const std::atomic<bool>& isStopped) const;

private:
  void TakeColors(vtkPolyData* triangles);
  DrawnTexels::Color FindColor(const TileFrame& frame, std::uint32_t triangle, int x, int y) const;

  Layout Grid;
  DrawnTriangles Triangles;
  std::array<std::vector<DrawnTexels::Color>, 2> Colors; ///< of the points, front and back
  MappedPoints Mapped;
};
}

#endif
