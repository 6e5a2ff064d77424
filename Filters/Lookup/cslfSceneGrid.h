// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The places where the surfaces of a light field's scene may be: a coarse grid over the scene's
 * bounds. The search along a ray skips its empty cells. A second one may have only what a geometry
 * of the opaque surfaces lacks. It is made from the viewpoints' depth, in a
 * time that depends only on the field. The functions here and those of cslfSceneGrid.glsl have the
 * same names and the same results.
 */
#ifndef cslfSceneGrid_h
#define cslfSceneGrid_h

#include "Lookup/cslfLookupConstants.h"
#include "cslfDescription.h"
#include "cslfViewpointSamples.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkImageData;

namespace cslf
{
/// The places where a field's geometry has its triangles: small cells, and those around them. They
/// are as large as a texel at the cube's centre, or larger.
class VTKCSLF_EXPORT SurfaceCells
{
public:
  /// `corners` are the numbers of the points of all triangles, three for each.
  SurfaceCells(const Description& description, const std::vector<glm::vec3>& pointsCC,
    const std::vector<std::uint32_t>& corners);

  /// Whether a point is nearly as close to the geometry as `reach`.
  bool AreNear(const glm::dvec3& pointCC, double reach) const;

private:
  void Mark(const glm::dvec3& pointCC);
  std::size_t IndexOf(const glm::ivec3& cell) const;
  bool IsInside(const glm::ivec3& cell) const;
  glm::ivec3 FindCell(const glm::dvec3& pointCC) const;

  glm::dvec3 Minimum;
  double Edge;      ///< of a cell
  glm::ivec3 Cells; ///< along each side
  std::vector<bool> Marks;
};

class SceneGrid
{
public:
  /// The number of cells along each side.
  static constexpr int Cells = lookup::GridCells;

  /// A set of a viewpoint's tiles, one bit each.
  static constexpr int AllTiles = (1 << TileCount) - 1;

  SceneGrid() = default;

  /// For a field that was not examined yet: all cells are empty. Without depth, none is. With the
  /// cells of a geometry, the grid only has what lies elsewhere.
  explicit SceneGrid(const Description& description,
    std::shared_ptr<const SurfaceCells> known = std::shared_ptr<const SurfaceCells>());

  /// Marks what a viewpoint sees in these tiles, one bit each, unless it is known. Spread then
  /// updates the rings, and returns whether anything is new.
  void Add(int slice, const ViewpointSamples& samples, int tiles = AllTiles);
  bool Spread();

  /// `image` contains these slices of the field, in that order, with colour and perhaps depth.
  /// Without depth, no cell counts as empty.
  SceneGrid(const Description& description, vtkImageData* image, const std::vector<int>& slices);

  /// Per cell, x fastest, the number of rings of empty cells around it, including the cell: 0 if it
  /// may contain a surface. At most 255.
  const std::vector<std::uint8_t>& GetRings() const { return this->Rings; }

  /// The grid's bounds in CC: those of the scene, widened so that surfaces on them are crossed.
  const glm::dvec3& GetMinimum() const { return this->Minimum; }
  const glm::dvec3& GetMaximum() const { return this->Maximum; }

  /// A ray in units of the grid's cells.
  struct Ray
  {
    glm::dvec3 Entry;
    glm::dvec3 Chord;
    const SceneGrid* Grid;
  };

  Ray CastGridRay(const glm::dvec3& entryCC, const glm::dvec3& chordCC) const;

  /// The first (x) and last (y) fraction of the chord at which the scene may lie. Empty if x >= y.
  static glm::dvec2 ClipToScene(const Ray& ray);

  /// Whether the cell around the ray's point at w may contain a surface.
  bool IsOccupied(const Ray& ray, double w) const;

  /// The first w from `w` on where the grid is not empty. 0 if there is none before `last`.
  double SkipEmpty(const Ray& ray, double w, double last) const;

private:
  void Mark(const glm::dvec3& position, const glm::dvec3& reach);
  static glm::ivec3 FindCell(const Ray& ray, double t);

  std::shared_ptr<const SurfaceCells> Known;
  Layout Field;
  glm::dvec3 Minimum{ -1.0 };
  glm::dvec3 Maximum{ 1.0 };
  std::vector<std::uint8_t> Rings;
  std::vector<int> Added;      ///< the tiles of each slice
  std::vector<glm::ivec3> New; ///< new marks that the rings do not include yet
};
}

#endif
