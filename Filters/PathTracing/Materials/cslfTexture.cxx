// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexture.h"

#include "cslfColor.h"
#include "cslfDisplayedColor.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
constexpr int OnBorder = -1;

int Modulo(int index, int size)
{
  const int remainder = index % size;
  return remainder < 0 ? remainder + size : remainder;
}

/// The index of a pixel on one axis, or OnBorder.
int FindPixel(int index, int size, TextureWrap wrap)
{
  switch (wrap)
  {
    case TextureWrap::Edge:
      return std::clamp(index, 0, size - 1);
    case TextureWrap::Repeat:
      return Modulo(index, size);
    case TextureWrap::Mirror:
    {
      const int place = Modulo(index, 2 * size);
      return std::min(place, 2 * size - 1 - place);
    }
    default:
      return index < 0 || index >= size ? OnBorder : index;
  }
}

/// Equivalent small coordinates, so that pixels can be counted in integers.
float Reduce(float coordinate, TextureWrap wrap)
{
  switch (wrap)
  {
    case TextureWrap::Edge:
      return std::clamp(coordinate, 0.0f, 1.0f);
    case TextureWrap::Repeat:
      return coordinate - std::floor(coordinate);
    case TextureWrap::Mirror:
      return coordinate - 2.0f * std::floor(0.5f * coordinate);
    default:
      return std::clamp(coordinate, -1.0f, 2.0f);
  }
}
}

Texture::Texture(TextureImage image, TextureKind kind)
  : Image(std::move(image))
  , Translucent(false)
{
  if (kind != TextureKind::Colors || !this->Image.Interpolate)
  {
    this->Image.DisplayedWhite = glm::vec3(0.0f);
  }
  this->Levels = this->MakeDecoding(kind);
  for (const TextureWrap wrap : this->Image.Wraps)
  {
    this->Translucent =
      this->Translucent || (wrap == TextureWrap::Border && this->Image.Border[3] < 255);
  }
  for (std::size_t i = 3; i < this->Image.Pixels.size(); i += 4)
  {
    this->Translucent = this->Translucent || this->Image.Pixels[i] < 255;
  }
}

Texture::Decoding Texture::MakeDecoding(TextureKind kind) const
{
  const glm::vec3& white = this->Image.DisplayedWhite;
  Decoding decoding;
  for (int i = 0; i < 256; ++i)
  {
    const double encoded = i / 255.0;
    decoding[i] =
      glm::vec3(static_cast<float>(kind == TextureKind::Colors ? SRGBToLinear(encoded) : encoded));
    decoding[i] = white.x > 0.0f ? ToDisplayed(white * decoding[i]) : decoding[i];
  }
  return decoding;
}

glm::vec4 Texture::GetPixel(int column, int row) const
{
  const int x = FindPixel(column, this->Image.Width, this->Image.Wraps[0]);
  const int y = FindPixel(row, this->Image.Height, this->Image.Wraps[1]);
  const std::uint8_t* pixel = x == OnBorder || y == OnBorder
    ? this->Image.Border.data()
    : this->Image.Pixels.data() + 4 * (std::size_t(y) * this->Image.Width + x);
  return { this->Levels[pixel[0]].x, this->Levels[pixel[1]].y, this->Levels[pixel[2]].z,
    static_cast<float>(pixel[3]) / 255.0f };
}

glm::vec4 Texture::Get(const glm::vec2& coordinates) const
{
  const glm::vec2 place(
    Reduce(coordinates.x, this->Image.Wraps[0]) * static_cast<float>(this->Image.Width),
    Reduce(coordinates.y, this->Image.Wraps[1]) * static_cast<float>(this->Image.Height));
  if (!this->Image.Interpolate)
  {
    return this->GetPixel(
      static_cast<int>(std::floor(place.x)), static_cast<int>(std::floor(place.y)));
  }
  const glm::vec2 corner = glm::floor(place - 0.5f);
  const glm::vec2 weight = place - 0.5f - corner;
  const int column = static_cast<int>(corner.x);
  const int row = static_cast<int>(corner.y);
  const glm::vec4 value =
    glm::mix(glm::mix(this->GetPixel(column, row), this->GetPixel(column + 1, row), weight.x),
      glm::mix(this->GetPixel(column, row + 1), this->GetPixel(column + 1, row + 1), weight.x),
      weight.y);
  const glm::vec3& white = this->Image.DisplayedWhite;
  return white.x > 0.0f ? glm::vec4(FromDisplayed(glm::vec3(value)) / white, value.w) : value;
}
}
