// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The depth of a geometry as viewpoints of a field see it. Coded files can do without the channel
 * Depth where readers compute it in this way.
 */
#ifndef cslfGeometryDepths_h
#define cslfGeometryDepths_h

#include "vtkCSLFModule.h" // for export macro

#include "Geometry/cslfDepthTile.h"
#include "cslfLayout.h"

#include <atomic>
#include <cstddef>

class vtkPolyData;

namespace cslf
{
class VTKCSLF_EXPORT GeometryDepths
{
public:
  /// The depth of texels whose ray meets no triangle. No other texel has it.
  static constexpr unsigned short None = 65535;

  /// More triangles are not drawn, so that a file cannot ask for any amount of work.
  static constexpr std::size_t MaximumTriangles = std::size_t(1) << 22;

  /// Triangles in world coordinates.
  GeometryDepths(vtkPolyData* triangles, const Cube& box, const Layout& grid);

  const Layout& GetGrid() const { return this->Grid; }

  /// Fills the strip of a viewpoint: for each texel, the first triangle that the ray to its centre
  /// meets, as a fraction of the distance to the centre, from 0 to 65534. Triangles have two sides.
  /// May be called by several threads at once. Returns false early if `isStopped` becomes true.
  bool Draw(int slice, unsigned short* depths, const std::atomic<bool>& isStopped) const;

private:
  Layout Grid;
  DrawnTriangles Triangles;
};
}

#endif
