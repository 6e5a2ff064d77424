// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Lets rays pass surfaces: at random by opacity, or if they come from a hidden side.
 */
#ifndef cslfHitFilter_h
#define cslfHitFilter_h

#include "cslfEmbree.h"

namespace cslf
{
struct Mesh;

/// Makes rays pass a mesh's surface according to its visible sides, its opacity and the rule of
/// their query. The mesh must outlive the geometry.
void FilterHits(RTCGeometry geometry, const Mesh& mesh);
}

#endif
