// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Where the surfaces of a light field's scene may be: a coarse grid over the scene's bounds, which
 * the search along a ray skips the empty parts of. Made from the depth that the viewpoints see, in
 * a time that depends on the field alone. The functions here and those of cslfSceneGrid.glsl have
 * the same names and the same results.
 */
#ifndef cslfSceneGrid_h
#define cslfSceneGrid_h

#include "cslfDescription.h"
#include "cslfViewpointSource.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

class vtkImageData;

namespace cslf
{
class SceneGrid
{
public:
  /// Along each side.
  static constexpr int Cells = 64;

  /// Of a viewpoint: a bit for each.
  static constexpr int AllTiles = (1 << TileCount) - 1;

  SceneGrid() = default;

  /// Of a field of which nothing was looked at yet: all cells are empty. Without depth none is.
  explicit SceneGrid(const Description& description);

  /// Marks what a viewpoint sees by these tiles, a bit for each, unless that is known. The rings
  /// follow with Spread, which says whether anything is new.
  void Add(int slice, const ViewpointSamples& samples, int tiles = AllTiles);
  bool Spread();

  /// `image` holds these slices of the field, in that order, with colour and perhaps depth; without
  /// depth no cell counts as empty.
  SceneGrid(const Description& description, vtkImageData* image, const std::vector<int>& slices);

  /// Per cell, x fastest, how many rings of empty cells are around it, itself included: 0 where a
  /// surface may be. At most 255.
  const std::vector<std::uint8_t>& GetRings() const { return this->Rings; }

  /// What the grid covers, in CC: the scene's bounds, widened so that surfaces on them are crossed.
  const glm::dvec3& GetMinimum() const { return this->Minimum; }
  const glm::dvec3& GetMaximum() const { return this->Maximum; }

  /// A ray in units of the grid's cells.
  struct Ray
  {
    glm::dvec3 Entry;
    glm::dvec3 Chord;
  };

  Ray CastGridRay(const glm::dvec3& entryCC, const glm::dvec3& chordCC) const;

  /// The first and last fraction of the chord that the scene can fill; empty where first >= last.
  static void ClipToScene(const Ray& ray, double& first, double& last);

  /// Whether the cell around the ray's point at w may hold a surface.
  bool IsOccupied(const Ray& ray, double w) const;

  /// The first w from `w` on where the grid is not empty; 0 where there is none before `last`.
  double SkipEmpty(const Ray& ray, double w, double last) const;

private:
  void Mark(const glm::dvec3& position, const glm::dvec3& reach);
  static glm::ivec3 FindCell(const Ray& ray, double t);

  Layout Field;
  glm::dvec3 Minimum{ -1.0 };
  glm::dvec3 Maximum{ 1.0 };
  std::vector<std::uint8_t> Rings;
  std::vector<int> Known;      ///< the tiles of each slice that were added
  std::vector<glm::ivec3> New; ///< marks that the rings do not know of
};
}

#endif
