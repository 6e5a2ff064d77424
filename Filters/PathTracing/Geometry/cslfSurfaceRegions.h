// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The parts of a scene's surfaces within which colours and arrays do not jump.
 */
#ifndef cslfSurfaceRegions_h
#define cslfSurfaceRegions_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Shapes/cslfMesh.h"
#include "Pipeline/cslfPhase.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/**
 * Triangles of a mesh that meet at an edge belong to one region unless their base colours,
 * emissions, places on a map or arrays differ there: those of cells do, and those of points where
 * there are several at one place. Regions that are smaller than a texel are none of their own: all
 * those of a mesh count as one. Each mesh has regions of its own, one if it has spheres or tubes.
 */
class VTKCSLF_EXPORT SurfaceRegions
{
public:
  /// Everything is one region.
  SurfaceRegions() = default;

  /// Given the size of a texel at the cube's centre, in scene space. The meshes must not change.
  /// Throws Aborted.
  SurfaceRegions(const std::vector<Mesh>& meshes, float texel, const Progress& progress);

  /// The number of the region of a shape of one of the meshes. Without regions it is 0.
  std::uint32_t Get(const Mesh& mesh, std::uint32_t shape) const
  {
    return this->HasSeveral(mesh) ? this->OfShapes[this->Number(mesh)][shape]
      : this->First               ? static_cast<std::uint32_t>(this->Number(mesh))
                                  : 0;
  }

  bool HasSeveral(const Mesh& mesh) const
  {
    return this->First && !this->OfShapes[this->Number(mesh)].empty();
  }

private:
  std::size_t Number(const Mesh& mesh) const
  {
    return static_cast<std::size_t>(&mesh - this->First);
  }

  const Mesh* First = nullptr;
  std::vector<std::vector<std::uint32_t>> OfShapes; // of each mesh, or none
};
}

#endif
