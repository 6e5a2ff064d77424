// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The colours that the points of a geometry have themselves, for what no viewpoint sees.
 */
#ifndef cslfSideColors_h
#define cslfSideColors_h

#include "vtkCSLFModule.h" // for export macro

#include "Pipeline/cslfColorMap.h"
#include "cslfSurfaceMesh.h"

#include <glm/vec4.hpp>

#include <array>
#include <vector>

class vtkPolyData;

namespace cslf
{
/// The colours of a mesh's points, as a field stores them, from 0 to 1 if it stores bytes, with
/// alpha, which is 0 where there is no colour.
struct SideColors
{
  /// On the front, where corners run counterclockwise, and on the back.
  std::array<std::vector<glm::vec4>, 2> Sides;

  /// ToExactCode, if a point's colour alone shows the surface around it well, from all directions,
  /// otherwise 0. Empty if none does.
  std::array<std::vector<unsigned char>, 2> Exact;

  /// The points whose colours a map tells, without their light: that is what `Sides` has. Empty if
  /// there are none.
  MappedPoints Mapped;

  /// The side's colour of a mapped point becomes light, and the opposite.
  glm::vec4 ToLight(std::size_t point, const glm::vec4& color) const;
  glm::vec4 ToColor(std::size_t point, const glm::vec4& light) const;

  /// Makes mapped points like others.
  void DropMaps();
};

/// Gives the points their colours, as point data `Color` and `BackColor` of that type, and
/// `ExactColor` if any is exact, with the arrays that tell of mapped points. The second is left out
/// if nothing has a colour on the back. Points without colour on a side have that of points next to
/// them or, if no point around them has one, that of the other side or gray.
VTKCSLF_EXPORT void AddSideColors(
  const SurfaceMesh& mesh, SideColors colors, int type, vtkPolyData* geometry);
}

#endif
