// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLatticeLayout.h"

#include "cslfChartMaker.h"

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// The most bricks of a scene in addition to one for each triangle and chart. Beyond that, the
// spacing grows.
constexpr std::size_t MaximumBricks = std::size_t(1) << 23;
constexpr float SpacingGrowth = 1.5f;

// The largest spacing, of a scene whose radius is 1.
constexpr float MaximumSpacing = 0.5f;

// The size of clusters of vertices, in spacings. The point of a cluster lies anywhere in it.
constexpr float ClusterSize = 0.5f;

/// How often a length must be halved until it is at most the spacing.
int FindDepth(float length, float spacing, int largest)
{
  return std::clamp(static_cast<int>(std::ceil(std::log2(length / spacing))), 0, largest);
}
}

LatticeLayout::LatticeLayout(
  const Scene& scene, const OpenSides& sides, float spacing, const LayoutProgress& progress)
  : Spacing(spacing)
{
  for (std::uint32_t mesh = 0; mesh < scene.GetMeshes().size(); ++mesh)
  {
    this->FirstTriangles.push_back(scene.GetTriangleIndex(mesh, 0));
  }
  this->Divide(scene, sides, progress);
  while (this->CountFurtherBricks() > MaximumBricks && this->Spacing < MaximumSpacing)
  {
    this->Spacing *= SpacingGrowth;
    this->Divide(scene, sides, progress);
  }
}

void LatticeLayout::Divide(
  const Scene& scene, const OpenSides& sides, const LayoutProgress& progress)
{
  this->Depths.clear();
  this->Clusters.clear();
  for (const Mesh& mesh : scene.GetMeshes())
  {
    this->Clusters.push_back(mesh.CanHoldLattice()
        ? FindVertexClusters(mesh, ClusterSize * this->Spacing, progress)
        : std::vector<std::uint32_t>());
    for (std::uint32_t i = 0; mesh.CanHoldLattice() && i < mesh.Triangles.size(); ++i)
    {
      progress.Step();
      this->Depths.push_back(
        static_cast<std::uint8_t>(FindDepth(mesh.GetLongestEdge(i), this->Spacing, MaximumDepth)));
    }
  }
  ChartSettings settings;
  settings.Spacing = this->Spacing;
  settings.BrickSize = this->Spacing * static_cast<float>(1 << BrickLevels);
  this->Charts = MakeCharts(scene, sides, this->Clusters, settings, progress);
  this->OnChart.assign(this->Depths.size(), 0);
  for (const SurfaceChart& chart : this->Charts)
  {
    progress.Step(chart.GetMembers().size());
    for (const SurfaceChart::Member& member : chart.GetMembers())
    {
      this->OnChart[this->FirstTriangles[chart.GetMesh()] + member.Triangle] = 1;
    }
  }
}

int LatticeLayout::GetSplitDepth(std::size_t triangle) const
{
  return std::max(0, this->Depths[triangle] - BrickLevels);
}

int LatticeLayout::GetCellDepth(const SurfaceChart& chart) const
{
  const float size = std::max(chart.GetCellSize().x, chart.GetCellSize().y);
  return FindDepth(size, this->Spacing, BrickLevels);
}

std::size_t LatticeLayout::CountFurtherBricks() const
{
  std::size_t count = 0;
  for (std::size_t triangle = 0; triangle < this->Depths.size(); ++triangle)
  {
    const int depth = this->IsOnChart(triangle) ? 0 : this->GetSplitDepth(triangle);
    count += (std::size_t(2) << (2 * depth)) - 2;
  }
  for (const SurfaceChart& chart : this->Charts)
  {
    count += 2 * (chart.GetBricksOfSide() - 2);
  }
  return count;
}

SurfaceLattice LatticeLayout::MakeLattice() const
{
  std::vector<std::uint8_t> splits;
  for (std::size_t triangle = 0; triangle < this->Depths.size(); ++triangle)
  {
    splits.push_back(static_cast<std::uint8_t>(this->GetSplitDepth(triangle)));
  }
  std::vector<LatticeChart> charts;
  for (const SurfaceChart& chart : this->Charts)
  {
    LatticeChart result{ chart.GetColumns(), chart.GetRows(), {} };
    for (const SurfaceChart::Member& member : chart.GetMembers())
    {
      const std::size_t triangle = this->FirstTriangles[chart.GetMesh()] + member.Triangle;
      const glm::vec2 first = chart.GetPlace(member, 0);
      result.Members.push_back({ static_cast<std::uint32_t>(triangle), first,
        chart.GetPlace(member, 1) - first, chart.GetPlace(member, 2) - first });
    }
    charts.push_back(result);
  }
  return SurfaceLattice(splits, charts);
}
}
