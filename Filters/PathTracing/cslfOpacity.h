// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surfaces that light passes by chance.
 */
#ifndef cslfOpacity_h
#define cslfOpacity_h

#include "cslfEmbree.h"

namespace cslf
{
struct Mesh;

/// Makes rays pass a mesh's surface as its opacity and their query's rule say. The mesh must
/// outlive the geometry.
void PassByOpacity(RTCGeometry geometry, const Mesh& mesh);
}

#endif
