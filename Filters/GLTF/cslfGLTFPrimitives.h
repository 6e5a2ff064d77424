// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads the primitives of a glTF file's meshes.
 */
#ifndef cslfGLTFPrimitives_h
#define cslfGLTFPrimitives_h

#include "cslfGLTFDocument.h"
#include "cslfGLTFMaterials.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <cstddef>
#include <map>
#include <vector>

namespace cslf
{
class GLTFPrimitives
{
public:
  GLTFPrimitives(GLTFDocument& document, GLTFErrors& errors);

  /// The primitives of a mesh with their materials, which are read once. Primitives that have no
  /// cells or cannot be read are left out.
  const std::vector<vtkSmartPointer<vtkPolyData>>& Get(std::size_t mesh);

private:
  vtkSmartPointer<vtkPolyData> Read(const GLTFValue& primitive);
  void AddNormals(const GLTFValue& attributes, vtkPolyData* data);
  void AddTexCoords(
    const GLTFValue& attributes, const GLTFTextureMapping& mapping, vtkPolyData* data);
  void AddColors(const GLTFValue& attributes, const GLTFMaterial* material, vtkPolyData* data);

  GLTFDocument& Document;
  GLTFErrors& Errors;
  GLTFMaterials Materials;
  std::map<std::size_t, std::vector<vtkSmartPointer<vtkPolyData>>> Known;
};
}

#endif
