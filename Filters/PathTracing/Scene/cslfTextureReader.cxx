// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTextureReader.h"

#include "PathTracing/Materials/cslfDisplayedColor.h"
#include "Pipeline/cslfArrayLayout.h"
#include "cslfColor.h"
#include "vtkCSLFMaterial.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <utility>

namespace cslf
{
namespace
{
/// A pixel of 1 to 4 components as red, green, blue, alpha.
std::array<std::uint8_t, 4> ToPixel(const unsigned char* pixel, int components)
{
  const bool isGrey = components < 3;
  const bool hasAlpha = components == 2 || components == 4;
  return { pixel[0], isGrey ? pixel[0] : pixel[1], isGrey ? pixel[0] : pixel[2],
    hasAlpha ? pixel[components - 1] : std::uint8_t(255) };
}

/// The border colour of an image with that many components.
std::array<std::uint8_t, 4> ReadBorder(vtkDataObject* material, int slot, int components)
{
  double color[4];
  vtkCSLFMaterial::GetTextureBorder(material, slot, color);
  const bool hasAlpha = components % 2 == 0;
  return { ToByte(color[0]), ToByte(color[1]), ToByte(color[2]),
    hasAlpha ? ToByte(color[3]) : std::uint8_t(255) };
}
}

glm::vec3 GetDisplayedWhite(vtkDataObject* material)
{
  double white[3];
  vtkCSLFMaterial::GetDisplayedWhite(material, white);
  const bool isSet = white[0] > 0.0 && white[1] > 0.0 && white[2] > 0.0;
  return isSet ? glm::vec3(white[0], white[1], white[2]) : glm::vec3(0.0f);
}

MaterialTextures TextureReader::Read(vtkDataObject* material)
{
  MaterialTextures textures;
  textures.BaseColor =
    this->ReadSlot(material, vtkCSLFMaterial::BaseColorTexture, TextureKind::Colors);
  textures.MetallicRoughness =
    this->ReadSlot(material, vtkCSLFMaterial::MetallicRoughnessTexture, TextureKind::Numbers);
  textures.Normal = this->ReadSlot(material, vtkCSLFMaterial::NormalTexture, TextureKind::Numbers);
  textures.Emission =
    this->ReadSlot(material, vtkCSLFMaterial::EmissionTexture, TextureKind::Colors);
  return textures;
}

std::shared_ptr<const Texture> TextureReader::ReadSlot(
  vtkDataObject* material, int slot, TextureKind kind)
{
  TextureImage image;
  vtkNew<vtkImageData> source;
  bool repeat = false;
  if (!vtkCSLFMaterial::GetTexture(material, slot, source, repeat, image.Interpolate))
  {
    return nullptr;
  }
  int wraps[2];
  vtkCSLFMaterial::GetTextureWrap(material, slot, wraps);
  image.Wraps[0] = static_cast<TextureWrap>(wraps[0]);
  image.Wraps[1] = static_cast<TextureWrap>(wraps[1]);
  const auto pixels = ToAOS<vtkUnsignedCharArray>(source->GetPointData()->GetScalars());
  const int components = pixels->GetNumberOfComponents();
  const glm::vec3 white = GetDisplayedWhite(material);
  if (kind == TextureKind::Colors && white != glm::vec3(0.0f))
  {
    // Emission is displayed unchanged.
    image.DisplayedWhite = slot == vtkCSLFMaterial::EmissionTexture ? glm::vec3(1.0f) : white;
  }
  image.Width = source->GetDimensions()[0];
  image.Height = source->GetDimensions()[1];
  image.Border = ReadBorder(material, slot, components);
  const Key key(pixels->GetPointer(0), image.Width, image.Height, components, image.Wraps[0],
    image.Wraps[1], image.Interpolate, image.Border, kind, image.DisplayedWhite.x,
    image.DisplayedWhite.y, image.DisplayedWhite.z);
  auto& [held, known] = this->Known[key];
  if (!known)
  {
    image.Pixels.reserve(4 * pixels->GetNumberOfTuples());
    for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
    {
      const auto pixel = ToPixel(pixels->GetPointer(i * components), components);
      image.Pixels.insert(image.Pixels.end(), pixel.begin(), pixel.end());
    }
    held = pixels;
    known = std::make_shared<const Texture>(std::move(image), kind);
  }
  return known;
}
}
