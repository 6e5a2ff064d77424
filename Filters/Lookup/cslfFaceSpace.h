// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The face space (FC) of an entry face, in which lookups work: x and y are the face's (sc, tc), z
 * is the depth below it, from 0 on the face to 2 on the opposite one. The functions here and those
 * of cslfCube.glsl have the same names and the same results.
 */
#ifndef cslfFaceSpace_h
#define cslfFaceSpace_h

#include "cslfCube.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>

namespace cslf
{
/// A point from CC to the space of a face, and back.
glm::dvec3 CubeToFaceSpace(int face, const glm::dvec3& pointCC);
glm::dvec3 FaceSpaceToCube(int face, const glm::dvec3& pointFC);

/// 1 over the distances from a point of the entry face to the sides at +1 and -1.
glm::dvec2 InverseToPositive(const glm::dvec2& from);
glm::dvec2 InverseToNegative(const glm::dvec2& from);

/// The shares of the distances to the sides (x, y) and to the opposite face (z) that a direction
/// covers. The ray leaves by the face with the largest share.
glm::dvec3 ShareOfWays(const glm::dvec3& directionFC, const glm::dvec2& inverseToPositive,
  const glm::dvec2& inverseToNegative);

/// Maps points of an exit face, in FC, to its (s,t): each row has the factors of x, y and z - 1.
/// The factor of the coordinate that is constant on the face is 0.
struct ExitFrame
{
  int Tile;
  glm::dvec3 S;
  glm::dvec3 T;
};

/// Of the exit face at the end `sign` (>= 0 is positive) of an axis of FC.
ExitFrame FindExitFrame(int entryFace, int axis, double sign);

/// The opposite face, and those towards +x, -x, +y and -y.
std::array<ExitFrame, 5> ListExitFrames(int entryFace);
}

#endif
