// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The typical distance between neighbours in a cloud of points.
 */
#ifndef cslfPointSpacing_h
#define cslfPointSpacing_h

#include "cslfSceneBlock.h"

#include <vector>

namespace cslf
{
/// The spacing of a cloud, which are the spheres of some blocks: the median distance of a point
/// from its fourth neighbour at another place, or from the last one if there are fewer. Points of
/// a square grid and points at random have about the same spacing if they are equally dense; the
/// distance to the nearest one would be half as large at random. The median is that of a sample of
/// 50 to 200 points. 0 if all points are at one place.
double FindPointSpacing(const std::vector<const SceneBlock*>& cloud);
}

#endif
