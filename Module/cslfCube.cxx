// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfCube.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cslf
{
namespace
{
struct FaceTableRow
{
  int AxisS;
  int SignS;
  int AxisT;
  int SignT;
};

// OpenGL 4.6 core specification, table 8.19: the axes of sc and tc for each major axis direction.
constexpr FaceTableRow FaceTable[FaceCount] = {
  { 2, -1, 1, -1 }, // +X: sc = -rz, tc = -ry
  { 2, +1, 1, -1 }, // -X: sc = +rz, tc = -ry
  { 0, +1, 2, +1 }, // +Y: sc = +rx, tc = +rz
  { 0, +1, 2, -1 }, // -Y: sc = +rx, tc = -rz
  { 0, +1, 1, -1 }, // +Z: sc = +rx, tc = -ry
  { 0, -1, 1, -1 }, // -Z: sc = -rx, tc = -ry
};
}

glm::dvec3 FaceToCube(int face, const glm::dvec2& coordinates)
{
  const FaceTableRow& row = FaceTable[face];
  glm::dvec3 point;
  point[FaceAxis(face)] = FaceSign(face);
  point[row.AxisS] = row.SignS * coordinates.x;
  point[row.AxisT] = row.SignT * coordinates.y;
  return point;
}

glm::dvec2 CubeToFace(int face, const glm::dvec3& pointCC)
{
  const FaceTableRow& row = FaceTable[face];
  return { row.SignS * pointCC[row.AxisS], row.SignT * pointCC[row.AxisT] };
}

CubePoint DirectionToFace(const glm::dvec3& directionCC)
{
  const glm::dvec3 size = glm::abs(directionCC);
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const int face = FaceOf(axis, directionCC[axis]);
  return { face, CubeToFace(face, directionCC / size[axis]) };
}

std::optional<RayCoordinates> RayToCoordinates(
  const glm::dvec3& originCC, const glm::dvec3& directionCC)
{
  double entryDistance = -std::numeric_limits<double>::infinity();
  double exitDistance = std::numeric_limits<double>::infinity();
  int entryAxis = -1;
  int exitAxis = -1;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double origin = originCC[axis];
    const double direction = directionCC[axis];
    if (!std::isfinite(origin) || !std::isfinite(direction))
    {
      return std::nullopt;
    }
    if (direction == 0.0)
    {
      if (std::abs(origin) > 1.0)
      {
        return std::nullopt;
      }
      continue;
    }
    const double sign = direction < 0.0 ? -1.0 : 1.0;
    const double nearDistance = (-sign - origin) / direction;
    const double farDistance = (sign - origin) / direction;
    if (nearDistance > entryDistance)
    {
      entryDistance = nearDistance;
      entryAxis = axis;
    }
    if (farDistance < exitDistance)
    {
      exitDistance = farDistance;
      exitAxis = axis;
    }
  }
  if (entryAxis < 0 || exitAxis < 0 || !(entryDistance < exitDistance))
  {
    return std::nullopt;
  }

  RayCoordinates ray;
  ray.EntryDistance = entryDistance;
  ray.ExitDistance = exitDistance;
  const auto toSurface = [&](double distance, int face) -> CubePoint
  {
    const glm::dvec3 point = originCC + distance * directionCC;
    return { face, glm::clamp(CubeToFace(face, point), -1.0, 1.0) };
  };
  ray.Entry = toSurface(entryDistance, FaceOf(entryAxis, -directionCC[entryAxis]));
  ray.Exit = toSurface(exitDistance, FaceOf(exitAxis, directionCC[exitAxis]));
  return ray;
}

Cube Cube::FromBounds(const double bounds[6], double offset)
{
  Cube cube;
  double longest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    cube.Center[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
    longest = std::max(longest, bounds[2 * axis + 1] - bounds[2 * axis]);
  }
  cube.Edges = glm::dvec3(longest > 0.0 ? longest * (1.0 + 2.0 * offset) : 1.0);
  return cube;
}

bool Cube::Contains(const double bounds[6]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double half = 0.5 * this->Edges[axis];
    if (!(bounds[2 * axis] > this->Center[axis] - half) ||
      !(bounds[2 * axis + 1] < this->Center[axis] + half))
    {
      return false;
    }
  }
  return true;
}

glm::dvec3 Cube::PointToCube(const glm::dvec3& pointWC) const
{
  return 2.0 * (pointWC - this->Center) / this->Edges;
}

glm::dvec3 Cube::PointToWorld(const glm::dvec3& pointCC) const
{
  return this->Center + 0.5 * pointCC * this->Edges;
}

glm::dvec3 Cube::VectorToCube(const glm::dvec3& vectorWC) const
{
  return 2.0 * vectorWC / this->Edges;
}

glm::dvec3 Cube::VectorToWorld(const glm::dvec3& vectorCC) const
{
  return 0.5 * vectorCC * this->Edges;
}

void Cube::GetBounds(double bounds[6]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = this->Center[axis] - 0.5 * this->Edges[axis];
    bounds[2 * axis + 1] = this->Center[axis] + 0.5 * this->Edges[axis];
  }
}
}
