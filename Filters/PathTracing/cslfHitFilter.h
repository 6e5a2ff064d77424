// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surfaces that rays pass: by chance, or where they come from a hidden side.
 */
#ifndef cslfHitFilter_h
#define cslfHitFilter_h

#include "cslfEmbree.h"

namespace cslf
{
struct Mesh;

/// Makes rays pass a mesh's surface as its visible sides, its opacity and their query's rule say.
/// The mesh must outlive the geometry.
void FilterHits(RTCGeometry geometry, const Mesh& mesh);
}

#endif
