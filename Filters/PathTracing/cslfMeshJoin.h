// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Surfaces that came in pieces, made whole.
 */
#ifndef cslfMeshJoin_h
#define cslfMeshJoin_h

#include "cslfMesh.h"

#include <vector>

namespace cslf
{
/// Joins meshes of equal materials and equal instances, and sorts meshes, shapes and vertices by
/// what they are, vertices that are alike becoming one. So the result does not depend on how the
/// surfaces were cut into pieces, nor on the order of these.
std::vector<Mesh> JoinMeshes(std::vector<Mesh> pieces);
}

#endif
