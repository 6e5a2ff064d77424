// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The noise of points, told by their neighbours, too.
 */
#ifndef cslfSampleNoise_h
#define cslfSampleNoise_h

#include "PathTracing/cslfDisplayCurve.h"
#include "cslfSurfaceEstimate.h"

#include <glm/vec3.hpp>

#include <vector>

namespace cslf
{
/**
 * The variances of points. To the standard error that a point's own samples tell, a part of its
 * neighbours' is added, and a part of the mean of all points. So a point that has not found a light
 * yet is not thought to be without noise while other points know of that light. Neighbours are the
 * points of the same groups.
 */
std::vector<glm::vec3> PoolVariances(
  const std::vector<glm::vec3>& variances, const std::vector<PointGroup>& groups);

/// What is seen of an error of a value, upwards or downwards, on a surface of some base colour: the
/// largest component. Downwards counts where the value is clipped.
float GetDisplayedError(const DisplayCurve& display, const glm::vec3& value, const glm::vec3& error,
  const glm::vec3& baseColor);
}

#endif
