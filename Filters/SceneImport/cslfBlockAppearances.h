// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Sets the materials and colours of imported blocks once all lights and surfaces are known.
 */
#ifndef cslfBlockAppearances_h
#define cslfBlockAppearances_h

#include "SceneData/cslfWindowLights.h"
#include "cslfImportedScene.h"

#include <vtkBoundingBox.h>

namespace cslf
{
/// The bounds of the finite points of a block's cells, in all its instances.
VTKCSLF_EXPORT vtkBoundingBox GetPlacedBounds(vtkPolyData* data);

/// Computes the lights for the blocks, and sets the blocks' materials, colours and textures so that
/// tracing shows what the window shows: see cslfSurfaceAppearance.h. Material arrays of the data
/// are kept. `interpolateDisplayed` selects interpolation of displayed values if the window
/// interpolates them.
void FinishAppearances(ImportedScene& scene, WindowLights& lights, bool interpolateDisplayed);

/// Sets the blocks' materials to the colours and textures of the properties themselves, for tracing
/// without light. Material arrays of the data are kept.
void FinishExactColors(ImportedScene& scene);
}

#endif
