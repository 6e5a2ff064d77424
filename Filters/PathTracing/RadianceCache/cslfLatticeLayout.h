// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Divides the surface of a scene into bricks: those of large triangles, and those of charts that
 * join all other triangles.
 */
#ifndef cslfLatticeLayout_h
#define cslfLatticeLayout_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Scene/cslfScene.h"
#include "cslfLayoutProgress.h"
#include "cslfMeshEdges.h"
#include "cslfOpenSides.h"
#include "cslfSurfaceChart.h"
#include "cslfSurfaceLattice.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT LatticeLayout
{
public:
  /// The size of a brick, as the binary logarithm of spacings.
  static constexpr int BrickLevels = 4;

  /// The finest points along a triangle's or chart's edges, as a binary logarithm.
  static constexpr int MaximumDepth = 12;

  /// The smallest distance between points, in scene space: it is larger than requested if the scene
  /// would need too many bricks.
  LatticeLayout(const Scene& scene, const OpenSides& sides, float spacing,
    const LayoutProgress& progress = LayoutProgress());

  float GetSpacing() const { return this->Spacing; }

  /// The binary logarithm of the spacings along a triangle's longest edge, rounded up; triangles
  /// are numbered by Scene::GetTriangleIndex.
  int GetDepth(std::size_t triangle) const { return this->Depths[triangle]; }

  bool IsOnChart(std::size_t triangle) const { return this->OnChart[triangle] != 0; }

  const std::vector<SurfaceChart>& GetCharts() const { return this->Charts; }

  /// The vertex of a smooth mesh whose point stands for that of another one nearby, or the same.
  std::uint32_t GetCluster(std::uint32_t mesh, std::uint32_t vertex) const
  {
    return this->Clusters[mesh][vertex];
  }

  /// The binary logarithm of the spacings along the longer side of a chart's cells, rounded up.
  int GetCellDepth(const SurfaceChart& chart) const;

  /// The lattice, 0 everywhere.
  SurfaceLattice MakeLattice() const;

private:
  void Divide(const Scene& scene, const OpenSides& sides, const LayoutProgress& progress);
  std::size_t CountFurtherBricks() const;
  int GetSplitDepth(std::size_t triangle) const;

  std::vector<std::size_t> FirstTriangles; // of the meshes
  float Spacing;
  std::vector<std::uint8_t> Depths;  // of the triangles
  std::vector<std::uint8_t> OnChart; // of the triangles
  std::vector<SurfaceChart> Charts;
  VertexClusters Clusters;
};
}

#endif
