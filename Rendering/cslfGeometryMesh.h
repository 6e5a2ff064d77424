// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The triangles of a field's geometry, as the graphics card gets them.
 */
#ifndef cslfGeometryMesh_h
#define cslfGeometryMesh_h

#include "Lookup/cslfSceneGrid.h"
#include "Pipeline/cslfColorMap.h"
#include "cslfBalls.h"
#include "cslfDescription.h"
#include "cslfMeshLevels.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace cslf
{
struct GeometryMesh
{
  std::vector<glm::vec3> PointsCC;
  glm::vec3 MinimumCC = glm::vec3(1.0f); ///< the bounds of the points that triangles have
  glm::vec3 MaximumCC = glm::vec3(-1.0f);
  /// Of the points, transparent where there is none. If any is exact, alpha is 1 where it is.
  /// Mapped points have their light instead, not associated with alpha.
  std::vector<glm::vec4> Colors;
  std::vector<glm::vec4> BackColors;  ///< on the back; empty if they are the same
  std::vector<std::uint32_t> Corners; ///< three for each triangle
  MappedPoints Mapped;                ///< without their light

  /// The number of corners of closed parts, which come first, counterclockwise from outside.
  std::size_t ClosedCorners = 0;

  /// What can be drawn instead of other triangles, if the geometry is alone: those of these
  /// corners, counterclockwise from outside.
  cslf::Balls Balls;
  std::vector<std::uint32_t> BallCorners;

  /// Whether all points have a colour, and whether any of these is exact.
  bool HasColors = false;
  bool IsBright = false; ///< some exact colours are above 1, or could be in another map
  bool HasExactColors = false;

  /// Whether the field's colours are linear, as mapped points must be then.
  bool IsLinear = false;

  /// Whether it has all surfaces: rays that miss it see none.
  bool IsComplete = false;

  /// Whether it alone shows the field: no viewpoint is needed.
  bool IsAlone = false;

  /// Where it is, if it has only the opaque surfaces: rays may meet others. Otherwise null.
  std::shared_ptr<const SurfaceCells> Cells;

  /// With fewer triangles, or null if they are not made yet: the first call begins to make them.
  const MeshLevels* FindLevels() const
  {
    return this->LevelMaker.Find(this->PointsCC, this->Corners, this->ClosedCorners);
  }

  /// The number of levels below the finest; 0 until they are made.
  std::size_t CountLevels() const;

  /// The triangles that are drawn at a level, with those of balls, and without.
  std::size_t CountTriangles(std::size_t level) const;
  MeshLevel GetLevel(std::size_t level) const;

  /// Whether GetLevel is part of the corners of MeshLevels, not of those above.
  bool IsCoarse(std::size_t level) const;

private:
  mutable MeshLevelMaker LevelMaker; ///< is destroyed before what it reads
};

/// The polygons and strips of a field's geometry as triangles, with its point data `Color`,
/// `BackColor` and `ExactColor`, and its mapped points. Null if there are none, if it lost too much
/// to be useful, or if it has a fault, which is told.
std::shared_ptr<const GeometryMesh> MakeGeometryMesh(
  vtkPolyData* geometry, const Description& field, std::string& fault);
}

#endif
