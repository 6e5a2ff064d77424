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

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/**
 * Triangles of a mesh that meet at an edge belong to one region unless their base colours,
 * emissions, places on a map or arrays differ there: those of cells do, and those of points where
 * there are several at one place. Between parts of equal values that are about as wide as
 * a texel, or wider, any difference that files can tell counts; between narrower ones, such as fine
 * cells, only a large one. Regions that are much narrower are none of their own: all those of a
 * mesh count as one. Spheres, and tubes that follow each other, belong to one region if they are
 * alike. Each mesh has regions of its own.
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

  /// The base colour, and the place on the map, if the mesh has one of its own, at a point of a
  /// triangle. Colours of narrow cells are interpolated between their
  /// corners, which have the means of the cells around them, within the region.
  glm::vec3 GetBaseColor(const Mesh& mesh, const TrianglePoint& point) const;
  glm::vec2 GetMapPlace(const Mesh& mesh, const TrianglePoint& point) const;

  bool HasSeveral(const Mesh& mesh) const
  {
    return this->First && !this->OfShapes[this->Number(mesh)].empty();
  }

  /// What corners of small cells have.
  struct Corner
  {
    glm::vec3 Color{ 0.0f };
    glm::vec2 Place{ 0.0f };
  };

  /// Three corners of each small cell of a mesh.
  struct SmallCells
  {
    std::vector<std::uint32_t> Rows; ///< of each triangle, that of its corners, or None; or none
    std::vector<std::array<Corner, 3>> Corners;
  };

  static constexpr std::uint32_t None = 0xffffffffU;

private:
  /// The corners of a small cell, or null.
  const std::array<Corner, 3>* FindCorners(const Mesh& mesh, std::uint32_t triangle) const
  {
    const SmallCells* cells = this->First ? &this->Small[this->Number(mesh)] : nullptr;
    return cells && !cells->Rows.empty() && cells->Rows[triangle] != None
      ? &cells->Corners[cells->Rows[triangle]]
      : nullptr;
  }

  std::size_t Number(const Mesh& mesh) const
  {
    return static_cast<std::size_t>(&mesh - this->First);
  }

  const Mesh* First = nullptr;
  std::vector<std::vector<std::uint32_t>> OfShapes; // of each mesh, or none
  std::vector<SmallCells> Small;                    // of each mesh
};
}

#endif
