// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The materials and colours of imported blocks, when all lights and surfaces are known.
 */
#ifndef cslfBlockLooks_h
#define cslfBlockLooks_h

#include "cslfImportedScene.h"
#include "cslfWindowLights.h"

namespace cslf
{
/// Works the lights out for the blocks, and sets the blocks' materials,
/// colours and textures so that they are traced as the window shows them: see cslfSurfaceLook.h.
/// What the data says of its material itself is kept. `interpolateDisplayed` tells whether colours
/// are interpolated as in the window where that does so as displayed values.
void FinishLooks(ImportedScene& scene, WindowLights& lights, bool interpolateDisplayed);
}

#endif
