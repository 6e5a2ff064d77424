// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts vtkGlyph3DMapper to instances.
 */
#ifndef cslfGlyphImporter_h
#define cslfGlyphImporter_h

#include "cslfImportedScene.h"

class vtkActor;
class vtkGlyph3DMapper;
class vtkMatrix4x4;

namespace cslf
{
/// The sources of an actor's glyph mapper as geometry, with an instance for each of its points.
/// Their inputs must be up to date.
std::vector<vtkSmartPointer<vtkPolyData>> ImportGlyphs(
  vtkActor* actor, vtkGlyph3DMapper* mapper, vtkMatrix4x4* matrix, ImportedScene& scene);
}

#endif
