// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Joins surfaces that were divided into pieces.
 */
#ifndef cslfMeshJoin_h
#define cslfMeshJoin_h

#include "PathTracing/Shapes/cslfMesh.h"

#include <vector>

namespace cslf
{
/// Joins meshes of equal materials and equal instances, merges equal vertices, and sorts meshes,
/// shapes and vertices by their values. So the result depends neither on how the surfaces were
/// divided into pieces nor on the order of these.
std::vector<Mesh> JoinMeshes(std::vector<Mesh>&& pieces);
}

#endif
