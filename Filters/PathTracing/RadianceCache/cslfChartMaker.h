// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Finds the triangles that are too small or too thin for their own lattices, and joins neighbours
 * into charts.
 */
#ifndef cslfChartMaker_h
#define cslfChartMaker_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Scene/cslfScene.h"
#include "cslfLayoutProgress.h"
#include "cslfMeshEdges.h"
#include "cslfOpenSides.h"
#include "cslfSurfaceChart.h"

#include <vector>

namespace cslf
{
struct ChartSettings
{
  /// The smallest distance between points, in scene space.
  float Spacing = 0.01f;

  /// The width of a brick, in scene space.
  float BrickSize = 0.16f;
};

/// The charts of a scene. Each triangle with an open side that is too small or too thin for its own
/// lattice is a member of one chart. A chart
/// - consists of triangles of one mesh that are connected by edges,
/// - is flat enough to be projected onto a plane without folds,
/// - has continuous light, because shading normals hardly differ where two triangles meet,
/// - has fewer points than its triangles would have if they shared those at the given vertices.
VTKCSLF_EXPORT std::vector<SurfaceChart> MakeCharts(const Scene& scene, const OpenSides& sides,
  const VertexClusters& clusters, const ChartSettings& settings,
  const LayoutProgress& progress = LayoutProgress());
}

#endif
