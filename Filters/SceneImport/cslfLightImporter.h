// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts a renderer's environment to field data, and finds when its lights changed.
 */
#ifndef cslfLightImporter_h
#define cslfLightImporter_h

#include "cslfImportedScene.h"

#include <vtkType.h>

class vtkRenderer;

namespace cslf
{
/// The time of the last change of anything that ImportLights reads, with or without the camera,
/// which lights may follow.
vtkMTimeType GetLightTime(vtkRenderer* renderer, bool headlightsAllAround, bool withCamera);

/// Finds out whether an environment texture lights the scene, and records what cannot be imported.
void FindEnvironment(vtkRenderer* renderer, ImportedScene& scene);

/// Adds that texture, with its radiance times a factor.
void ImportEnvironment(vtkRenderer* renderer, double factor, ImportedScene& scene);
}

#endif
