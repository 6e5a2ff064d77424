// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From a loaded glTF model to polygonal data with materials.
 */
#ifndef cslfGLTFBlocks_h
#define cslfGLTFBlocks_h

#include "cslfGLTFExtensions.h"
#include "cslfImportedScene.h"

#include <vtkGLTFDocumentLoader.h>

#include <vector>

namespace cslf
{
/// Adds the primitives of the default scene, whose nodes' transforms must have been built.
void BuildGLTFBlocks(const vtkGLTFDocumentLoader::Model& model,
  const std::vector<GLTFMaterialExtension>& extensions, ImportedScene& scene);
}

#endif
