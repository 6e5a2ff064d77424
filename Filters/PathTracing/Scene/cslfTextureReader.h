// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Converts the textures of vtkCSLFMaterial to those of the tracer.
 */
#ifndef cslfTextureReader_h
#define cslfTextureReader_h

#include "PathTracing/Shapes/cslfMesh.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

class vtkDataObject;

namespace cslf
{
/// The CSLF:DisplayedWhite of a material; 0 in all components unless all are above 0.
glm::vec3 GetDisplayedWhite(vtkDataObject* material);

/// Reads each image once, even if many blocks share its pixels.
class TextureReader
{
public:
  MaterialTextures Read(vtkDataObject* material);

private:
  using Key = std::tuple<const void*, int, int, int, TextureWrap, TextureWrap, bool,
    std::array<std::uint8_t, 4>, TextureKind, float, float, float>;

  std::shared_ptr<const Texture> ReadSlot(vtkDataObject* material, int slot, TextureKind kind);

  /// The textures and their pixels, which are kept because the address of freed pixels could be
  /// reused.
  std::map<Key, std::pair<vtkSmartPointer<vtkDataArray>, std::shared_ptr<const Texture>>> Known;
};
}

#endif
