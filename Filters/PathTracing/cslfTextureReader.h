// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From the textures of vtkCSLFMaterial to those that are traced.
 */
#ifndef cslfTextureReader_h
#define cslfTextureReader_h

#include "cslfMesh.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>

class vtkDataObject;

namespace cslf
{
/// Reads each image once, however many blocks share its pixels.
class TextureReader
{
public:
  MaterialTextures Read(vtkDataObject* material);

private:
  using Key = std::tuple<const void*, int, int, int, TextureWrap, TextureWrap, bool,
    std::array<std::uint8_t, 4>, TextureKind, float, float, float>;

  std::shared_ptr<const Texture> ReadSlot(vtkDataObject* material, int slot, TextureKind kind);

  std::map<Key, std::shared_ptr<const Texture>> Known;
};
}

#endif
