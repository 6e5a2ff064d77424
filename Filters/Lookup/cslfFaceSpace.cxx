// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lookup/cslfFaceSpace.h"

#include "Lookup/cslfLookupConstants.h"
#include "cslfLayout.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace cslf
{
using namespace lookup;

glm::dvec3 CubeToFaceSpace(int face, const glm::dvec3& pointCC)
{
  return { CubeToFace(face, pointCC), 1.0 - FaceSign(face) * pointCC[FaceAxis(face)] };
}

glm::dvec3 FaceSpaceToCube(int face, const glm::dvec3& pointFC)
{
  glm::dvec3 pointCC = FaceToCube(face, glm::dvec2(pointFC));
  pointCC[FaceAxis(face)] -= FaceSign(face) * pointFC.z;
  return pointCC;
}

glm::dvec2 InverseToPositive(const glm::dvec2& from)
{
  return 1.0 / glm::max(1.0 - from, MinimumSideDistance);
}

glm::dvec2 InverseToNegative(const glm::dvec2& from)
{
  return 1.0 / glm::max(1.0 + from, MinimumSideDistance);
}

glm::dvec3 ShareOfWays(const glm::dvec3& directionFC, const glm::dvec2& inverseToPositive,
  const glm::dvec2& inverseToNegative)
{
  const glm::dvec2 along(directionFC);
  return { glm::max(along * inverseToPositive, -along * inverseToNegative), 0.5 * directionFC.z };
}

ExitFrame FindExitFrame(int entryFace, int axis, double sign)
{
  const glm::dvec3 origin(0.0, 0.0, 1.0);
  glm::dvec3 outward(0.0);
  outward[axis] = sign < 0.0 ? -1.0 : 1.0;
  // The origin is the cube's centre, so directions are transformed like points.
  const glm::dvec3 outwardCC = FaceSpaceToCube(entryFace, origin + outward);
  const int axisCC = outwardCC.x != 0.0 ? 0 : (outwardCC.y != 0.0 ? 1 : 2);
  const int face = FaceOf(axisCC, outwardCC[axisCC]);
  ExitFrame frame;
  frame.Tile = TileOf(entryFace, face);
  for (int a = 0; a < 3; ++a)
  {
    glm::dvec3 unit(0.0);
    unit[a] = 1.0;
    const glm::dvec2 coordinates = CubeToFace(face, FaceSpaceToCube(entryFace, origin + unit));
    frame.S[a] = coordinates.x;
    frame.T[a] = coordinates.y;
  }
  return frame;
}

std::array<ExitFrame, 5> ListExitFrames(int entryFace)
{
  return { FindExitFrame(entryFace, 2, 1.0), FindExitFrame(entryFace, 0, 1.0),
    FindExitFrame(entryFace, 0, -1.0), FindExitFrame(entryFace, 1, 1.0),
    FindExitFrame(entryFace, 1, -1.0) };
}
}
