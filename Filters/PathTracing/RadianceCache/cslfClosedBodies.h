// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sides of triangles that face the inside of a closed body.
 */
#ifndef cslfClosedBodies_h
#define cslfClosedBodies_h

#include "PathTracing/Shapes/cslfMesh.h"
#include "cslfLayoutProgress.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/// For each triangle of a mesh 1 for the front or 2 for the back, if that side faces the inside of
/// a body that the mesh closes by itself; else 0. Vertices at the same place count as one. A body
/// is closed if each edge belongs to two triangles that run along it in opposite directions.
std::vector<std::uint8_t> FindInsides(
  const Mesh& mesh, const LayoutProgress& progress = LayoutProgress());
}

#endif
