// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The places where the surfaces of a light field's scene may be: a coarse grid over the scene's
 * bounds. The search along a ray skips its empty cells. It is made from the viewpoints' depth, in a
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

#include <cstdint>
#include <vector>

class vtkImageData;

namespace cslf
{
class SceneGrid
{
public:
  /// The number of cells along each side.
  static constexpr int Cells = lookup::GridCells;

  /// A set of a viewpoint's tiles, one bit each.
  static constexpr int AllTiles = (1 << TileCount) - 1;

  SceneGrid() = default;

  /// For a field that was not examined yet: all cells are empty. Without depth, none is.
  explicit SceneGrid(const Description& description);

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

  Layout Field;
  glm::dvec3 Minimum{ -1.0 };
  glm::dvec3 Maximum{ 1.0 };
  std::vector<std::uint8_t> Rings;
  std::vector<int> Known;      ///< the tiles of each slice that were added
  std::vector<glm::ivec3> New; ///< new marks that the rings do not include yet
};
}

#endif
