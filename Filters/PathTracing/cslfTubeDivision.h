// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Tubes that are short enough to be intersected exactly.
 */
#ifndef cslfTubeDivision_h
#define cslfTubeDivision_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfMesh.h"

namespace cslf
{
/// Divides each tube that is longer than 32 of its radii into shorter ones that together have its
/// shape and its values. Embree computes in floats, so its error grows with the square of this
/// ratio: at 600 it is percents of the radius, and the points that are sampled on a lamp lie so
/// deep below the surface that rays find that the lamp hides them. A mesh gets at most 2^20 tubes
/// more; where these do not suffice, the tubes stay longer.
VTKCSLF_EXPORT void DivideLongTubes(Mesh& mesh);
}

#endif
