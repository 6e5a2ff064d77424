// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Reads the materials of a glTF file.
 */
#ifndef cslfGLTFMaterials_h
#define cslfGLTFMaterials_h

#include "cslfGLTFDocument.h"

#include <vtkImageData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstddef>
#include <map>
#include <utility>

namespace cslf
{
class GLTFImages
{
public:
  explicit GLTFImages(GLTFDocument& document);

  /// An image of 8 bits with 1 to 4 components, with or without its alpha. It is decoded once.
  /// Throws a GLTFError on failure.
  vtkSmartPointer<vtkImageData> Get(std::size_t index, bool dropAlpha);

private:
  vtkSmartPointer<vtkImageData> Read(std::size_t index);

  GLTFDocument& Document;
  std::map<std::pair<std::size_t, bool>, vtkSmartPointer<vtkImageData>> Known;
};

/// Which texture coordinates a texture uses, and how it changes them (KHR_texture_transform).
struct GLTFTextureMapping
{
  std::size_t Set = 0;
  std::array<double, 2> Offset{ 0.0, 0.0 };
  std::array<double, 2> Scale{ 1.0, 1.0 };
  double Rotation = 0.0; ///< in radians

  bool operator==(const GLTFTextureMapping& other) const
  {
    return this->Set == other.Set && this->Offset == other.Offset && this->Scale == other.Scale &&
      this->Rotation == other.Rotation;
  }
};

struct GLTFMaterial
{
  vtkSmartPointer<vtkPolyData> Arrays; ///< its field data holds the arrays of vtkCSLFMaterial
  std::array<double, 4> Color{ 1.0, 1.0, 1.0, 1.0 }; ///< linear; multiplies vertex colours
  bool UsesAlpha = false;
  bool HasTextures = false;
  GLTFTextureMapping Mapping;
};

class GLTFMaterials
{
public:
  GLTFMaterials(GLTFDocument& document, GLTFErrors& errors);

  /// A material, which is read once. Throws a GLTFError if there is none.
  const GLTFMaterial& Get(std::size_t index);

private:
  void ReadFactors(const GLTFValue& source, GLTFMaterial& material);
  void ReadAlpha(const GLTFValue& source, GLTFMaterial& material);
  void ReadExtensions(const GLTFValue& source, GLTFMaterial& material);
  void ReadTextures(const GLTFValue& source, GLTFMaterial& material);
  void ReadTexture(int slot, const GLTFValue& info, GLTFMaterial& material);
  bool TakeMapping(const GLTFValue& info, GLTFMaterial& material);
  std::size_t FindImage(const GLTFValue& texture);

  GLTFDocument& Document;
  GLTFErrors& Errors;
  GLTFImages Images;
  std::map<std::size_t, GLTFMaterial> Known;
};
}

#endif
