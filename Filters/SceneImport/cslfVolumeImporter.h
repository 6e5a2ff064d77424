// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Imports the volumes of a renderer.
 */
#ifndef cslfVolumeImporter_h
#define cslfVolumeImporter_h

#include "cslfImportedScene.h"

class vtkMatrix4x4;
class vtkVolume;

namespace cslf
{
/// Whether a volume can be imported: all that have a mapper with an input, and no others inside.
bool IsImportable(vtkVolume* volume);

/// The time of the last change of anything that ImportVolume reads. Updates the pipelines of its
/// mapper.
vtkMTimeType GetImportTime(vtkVolume* volume);

/// Adds what an importable volume shows, placed by a matrix.
void ImportVolume(vtkVolume* volume, vtkMatrix4x4* matrix, ImportedScene& scene);
}

#endif
