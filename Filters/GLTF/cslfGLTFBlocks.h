// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts a glTF file to polygonal data with materials.
 */
#ifndef cslfGLTFBlocks_h
#define cslfGLTFBlocks_h

#include "cslfGLTFDocument.h"
#include "cslfGLTFProblems.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace cslf
{
/// The primitives of the nodes of the document's default scene, in world coordinates. Collects what
/// is invalid or not supported in the file.
std::vector<vtkSmartPointer<vtkPolyData>> MakeGLTFBlocks(
  GLTFDocument& document, GLTFProblems& problems);
}

#endif
