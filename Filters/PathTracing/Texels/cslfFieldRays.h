// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The rays of a light field: from a viewpoint through the texels of one of its tiles.
 */
#ifndef cslfFieldRays_h
#define cslfFieldRays_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Rays/cslfRayGrid.h"
#include "PathTracing/Scene/cslfScene.h"
#include "cslfCube.h"
#include "cslfLayout.h"

namespace cslf
{
/// The rays from a slice's viewpoint to the texels of one of its tiles, in the space of a scene of
/// that frame. Their parameter is 1 on the exit face.
VTKCSLF_EXPORT RayGrid MakeFieldRays(
  const Layout& layout, const Cube& box, const SceneFrame& frame, int slice, int tile);

/// The rays of one texel of these, as `cells` x `cells` texels that share its area.
VTKCSLF_EXPORT RayGrid MakeTexelRays(const RayGrid& tile, int x, int y, int cells);
}

#endif
