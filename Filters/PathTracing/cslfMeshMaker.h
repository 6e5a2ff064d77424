// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From blocks to meshes.
 */
#ifndef cslfMeshMaker_h
#define cslfMeshMaker_h

#include "cslfScene.h"
#include "cslfSceneBlock.h"
#include "cslfSurfaceColors.h"

namespace cslf
{
/// Copies what has an extent, and the points that it uses, into scene space; what has instances
/// into a space of its own, in which it is of about the size of 1.
Mesh MakeMesh(const SceneBlock& block, const SceneFrame& frame, SurfaceColors& colors);
}

#endif
