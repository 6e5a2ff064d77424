// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * An image on a surface.
 */
#ifndef cslfTexture_h
#define cslfTexture_h

#include "vtkCSLFModule.h" // for export macro

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <vector>

namespace cslf
{
/// What an image's numbers stand for.
enum class TextureKind
{
  Colors, ///< red, green and blue are sRGB-encoded
  Numbers
};

struct TextureImage
{
  int Width = 0;
  int Height = 0;
  bool Repeat = true;               ///< beyond [0,1]; else the edge goes on
  bool Interpolate = true;          ///< bilinear; else the nearest pixel
  std::vector<std::uint8_t> Pixels; ///< red, green, blue, alpha; the first row is v = 0
};

class VTKCSLF_EXPORT Texture
{
public:
  Texture(TextureImage image, TextureKind kind);

  /// Linear red, green, blue and alpha in [0,1], interpolated as such.
  glm::vec4 Get(const glm::vec2& coordinates) const;

  /// Whether any alpha is below 1.
  bool IsTranslucent() const { return this->Translucent; }

private:
  glm::vec4 GetPixel(int column, int row) const;

  TextureImage Image;
  TextureKind Kind;
  bool Translucent;
};
}

#endif
