// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTexture.h"

#include "cslfColor.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
using Decoding = std::array<float, 256>;

Decoding MakeDecoding(TextureKind kind)
{
  Decoding decoding{};
  for (int i = 0; i < 256; ++i)
  {
    const double encoded = i / 255.0;
    decoding[i] = static_cast<float>(kind == TextureKind::Colors ? SRGBToLinear(encoded) : encoded);
  }
  return decoding;
}

const Decoding& GetDecoding(TextureKind kind)
{
  static const Decoding colors = MakeDecoding(TextureKind::Colors);
  static const Decoding numbers = MakeDecoding(TextureKind::Numbers);
  return kind == TextureKind::Colors ? colors : numbers;
}

/// A pixel's place on one axis.
int Wrap(int index, int size, bool repeat)
{
  if (!repeat)
  {
    return std::clamp(index, 0, size - 1);
  }
  const int remainder = index % size;
  return remainder < 0 ? remainder + size : remainder;
}

/// Coordinates in [0,1], so that pixels can be counted in whole numbers.
float Reduce(float coordinate, bool repeat)
{
  return repeat ? coordinate - std::floor(coordinate) : std::clamp(coordinate, 0.0f, 1.0f);
}
}

Texture::Texture(TextureImage image, TextureKind kind)
  : Image(std::move(image))
  , Kind(kind)
  , Translucent(false)
{
  for (std::size_t i = 3; i < this->Image.Pixels.size(); i += 4)
  {
    this->Translucent = this->Translucent || this->Image.Pixels[i] < 255;
  }
}

glm::vec4 Texture::GetPixel(int column, int row) const
{
  const std::size_t x = Wrap(column, this->Image.Width, this->Image.Repeat);
  const std::size_t y = Wrap(row, this->Image.Height, this->Image.Repeat);
  const std::uint8_t* pixel = this->Image.Pixels.data() + 4 * (y * this->Image.Width + x);
  const Decoding& decoding = GetDecoding(this->Kind);
  return { decoding[pixel[0]], decoding[pixel[1]], decoding[pixel[2]],
    static_cast<float>(pixel[3]) / 255.0f };
}

glm::vec4 Texture::Get(const glm::vec2& coordinates) const
{
  const glm::vec2 place(
    Reduce(coordinates.x, this->Image.Repeat) * static_cast<float>(this->Image.Width),
    Reduce(coordinates.y, this->Image.Repeat) * static_cast<float>(this->Image.Height));
  if (!this->Image.Interpolate)
  {
    return this->GetPixel(static_cast<int>(place.x), static_cast<int>(place.y));
  }
  const glm::vec2 corner = glm::floor(place - 0.5f);
  const glm::vec2 weight = place - 0.5f - corner;
  const int column = static_cast<int>(corner.x);
  const int row = static_cast<int>(corner.y);
  return glm::mix(glm::mix(this->GetPixel(column, row), this->GetPixel(column + 1, row), weight.x),
    glm::mix(this->GetPixel(column, row + 1), this->GetPixel(column + 1, row + 1), weight.x),
    weight.y);
}
}
