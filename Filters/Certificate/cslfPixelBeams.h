// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The pixels of random cameras at which a field is compared with its scene.
 */
#ifndef cslfPixelBeams_h
#define cslfPixelBeams_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfCube.h"

#include <glm/vec3.hpp>

#include <vector>

namespace cslf
{
/// The rays of one pixel, in the world. At (x,y) in [0,1]^2 of the pixel, the direction is Corner +
/// x Right + y Up. It ends beyond the cube.
struct PixelBeam
{
  glm::dvec3 Eye;
  glm::dvec3 Corner;
  glm::dvec3 Right;
  glm::dvec3 Up;

  glm::dvec3 GetDirection(double x, double y) const
  {
    return this->Corner + x * this->Right + y * this->Up;
  }
};

/// One pixel of each of `count` cameras. The cameras are spread evenly over a sphere around the
/// cube, of a radius of two of its longest edges, and look at its centre. Of the pixels whose
/// centre sees the cube, one is chosen at random. So each is an independent sample of what `cslf
/// evaluate` measures: pictures of 512 x 512 pixels of 40 degrees.
VTKCSLF_EXPORT std::vector<PixelBeam> MakePixelBeams(const Cube& box, int count, int seed);

/// The faces of the cube that are seen from a point outside, one bit each.
VTKCSLF_EXPORT int FindSeenFaces(const Cube& box, const glm::dvec3& eye);
}

#endif
