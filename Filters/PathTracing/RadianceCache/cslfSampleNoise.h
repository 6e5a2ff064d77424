// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Estimates the noise of points with the help of their neighbours.
 */
#ifndef cslfSampleNoise_h
#define cslfSampleNoise_h

#include "Quality/cslfDisplayCurve.h"
#include "cslfMeshEdges.h"

#include <glm/vec3.hpp>

#include <vector>

namespace cslf
{
/**
 * The variances of points. The standard error of a point's own samples is mixed with a fraction of
 * its neighbours' and of the mean of all points. So a point that has not found a light yet does not
 * count as free of noise while other points have found it. Neighbours are those of the
 * graph.
 */
std::vector<glm::vec3> PoolVariances(
  const std::vector<glm::vec3>& variances, const PointGraph& graph);

/// The displayed error of a value, upwards or downwards, on a surface with a base colour: the
/// largest component. If the value is clipped, the error downwards counts.
float GetDisplayedError(const DisplayCurve& display, const glm::vec3& value, const glm::vec3& error,
  const glm::vec3& baseColor);
}

#endif
