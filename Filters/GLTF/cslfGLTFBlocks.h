// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From a glTF file to polygonal data with materials.
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
/// The primitives of the nodes of the document's default scene, in the world. Notes what of the
/// file is wrong or not represented.
std::vector<vtkSmartPointer<vtkPolyData>> MakeGLTFBlocks(
  GLTFDocument& document, GLTFProblems& problems);
}

#endif
