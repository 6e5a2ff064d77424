// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts actors to polygonal data with materials.
 */
#ifndef cslfActorImporter_h
#define cslfActorImporter_h

#include "cslfImportedScene.h"

#include <vtkType.h>

class vtkActor;
class vtkMatrix4x4;
class vtkPolyData;
class vtkDataSet;

namespace cslf
{
/// Whether an actor can be imported: all except those without a mapper of surfaces.
bool IsImportable(vtkActor* actor);

/// The time of the last change of anything that ImportActor reads. Updates the pipelines of its
/// mapper.
vtkMTimeType GetImportTime(vtkActor* actor);

/// Adds the surfaces of an importable actor, placed by a matrix. Returns whether there are any.
bool ImportActor(vtkActor* actor, vtkMatrix4x4* matrix, ImportedScene& scene);

/// The surface of a data set, in the world. Points that a matrix transforms become doubles.
vtkSmartPointer<vtkPolyData> ExtractSurface(vtkDataSet* data, vtkMatrix4x4* matrix);
}

#endif
