// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From a renderer's lights and environment to those in field data.
 */
#ifndef cslfLightImporter_h
#define cslfLightImporter_h

#include "cslfImportedScene.h"

#include <vtkType.h>

class vtkRenderer;

namespace cslf
{
/// The time of the last change of what ImportLights reads.
vtkMTimeType GetLightTime(vtkRenderer* renderer, bool headlightsAllAround);

/// Adds the lights that are switched on, and the environment: see vtkCSLFSceneImporter.
void ImportLights(vtkRenderer* renderer, bool headlightsAllAround, ImportedScene& scene);
}

#endif
