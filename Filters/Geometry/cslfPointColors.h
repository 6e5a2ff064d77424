// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colours of the points of a mesh, as viewpoints of a field see them.
 */
#ifndef cslfPointColors_h
#define cslfPointColors_h

#include "vtkCSLFModule.h" // for export macro

#include "Pipeline/cslfPhase.h"
#include "cslfDepthViews.h"
#include "cslfSideColors.h"
#include "cslfSurfaceMesh.h"
#include "cslfViewpointSamples.h"

#include <vector>

namespace cslf
{
/// Each side of a point takes its colour from the viewpoint that sees it least obliquely.
class VTKCSLF_EXPORT PointColors
{
public:
  /// Chooses the viewpoints. The mesh is in mesh space. Throws Aborted.
  PointColors(const DepthViews& views, const SurfaceMesh& mesh, const Progress& progress);

  /// Whether anything takes its colour from that view.
  bool IsNeeded(int view) const { return !this->SightsOf[view].empty(); }

  /// Reads the colours from a view. The samples may have another resolution than the depths.
  void Read(int view, int resolution, const ViewpointSamples& samples);

  const SideColors& Get() const { return this->Colors; }

private:
  /// Where a view sees a side of a point.
  struct Sight
  {
    unsigned Point;
    int Side;
    StripPlace Place; ///< in parts of a tile, which all resolutions have
  };

  std::vector<std::vector<Sight>> SightsOf; ///< of each view
  SideColors Colors;
};
}

#endif
