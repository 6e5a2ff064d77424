// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Divides tubes so that they are short enough to be intersected exactly.
 */
#ifndef cslfTubeDivision_h
#define cslfTubeDivision_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfMesh.h"

namespace cslf
{
/// Divides each tube that is longer than 32 of its radii into shorter ones that together have its
/// shape and its values. Embree computes in floats, so its error grows with the square of this
/// ratio. At 600 it is several percent of the radius, and sampled points of a lamp lie so deep
/// below the traced surface that the lamp hides them. A mesh gets at most 2^20 more tubes. If these
/// are not enough, the tubes stay longer.
VTKCSLF_EXPORT void DivideLongTubes(Mesh& mesh);
}

#endif
