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
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace cslf
{
/// The meaning of an image's numbers.
enum class TextureKind
{
  Colors, ///< red, green and blue are sRGB-encoded
  Numbers
};

/// The image beyond coordinates in [0,1]. The numbers are those of vtkCSLFMaterial::TextureWraps.
enum class TextureWrap
{
  Edge,   ///< its edge is extended
  Repeat, ///< it repeats
  Mirror, ///< it repeats, every other time mirrored
  Border  ///< one colour
};

struct TextureImage
{
  int Width = 0;
  int Height = 0;
  TextureWrap Wraps[2] = { TextureWrap::Repeat, TextureWrap::Repeat }; ///< along u, along v
  bool Interpolate = true;          ///< bilinear interpolation; else the nearest pixel
  std::vector<std::uint8_t> Pixels; ///< red, green, blue, alpha; the first row is v = 0

  /// If above 0, colours are interpolated as displayed (sRGB-encoded) values, in light that gives a
  /// white surface this radiance. Otherwise pixels are converted to linear values first.
  glm::vec3 DisplayedWhite{ 0.0f };

  std::array<std::uint8_t, 4> Border{}; ///< a pixel; used if a wrap says so
};

class VTKCSLF_EXPORT Texture
{
public:
  Texture(TextureImage image, TextureKind kind);

  /// Linear red, green, blue and alpha in [0,1].
  glm::vec4 Get(const glm::vec2& coordinates) const;

  int GetWidth() const { return this->Image.Width; }
  const TextureImage& GetImage() const { return this->Image; }

  /// Whether any alpha is below 1.
  bool IsTranslucent() const { return this->Translucent; }

private:
  using Decoding = std::array<glm::vec3, 256>;

  /// The interpolated values, by the levels of pixels.
  Decoding MakeDecoding(TextureKind kind) const;

  glm::vec4 GetPixel(int column, int row) const;

  TextureImage Image;
  Decoding Levels;
  bool Translucent;
};
}

#endif
