// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts blocks to meshes.
 */
#ifndef cslfMeshMaker_h
#define cslfMeshMaker_h

#include "cslfScene.h"
#include "cslfSceneBlock.h"
#include "cslfSurfaceColors.h"

namespace cslf
{
/// Copies shapes that have an extent, and the points that they use, to scene space. Those with
/// instances are copied to their own space, in which their size is about 1.
Mesh MakeMesh(const SceneBlock& block, const SceneFrame& frame, SurfaceColors& colors);
}

#endif
