// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * From the textures of vtkCSLFMaterial to those that are traced.
 */
#ifndef cslfTextureReader_h
#define cslfTextureReader_h

#include "cslfMesh.h"

#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

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

  /// The textures, and the pixels that they were made of: the address of pixels that are gone could
  /// be that of others.
  std::map<Key, std::pair<vtkSmartPointer<vtkDataArray>, std::shared_ptr<const Texture>>> Known;
};
}

#endif
