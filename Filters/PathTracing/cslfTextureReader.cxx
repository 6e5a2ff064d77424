// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfTextureReader.h"

#include "cslfDisplayedColor.h"
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
void AppendPixel(const unsigned char* pixel, int components, std::vector<std::uint8_t>& pixels)
{
  const bool isGrey = components < 3;
  const bool hasAlpha = components == 2 || components == 4;
  pixels.push_back(pixel[0]);
  pixels.push_back(isGrey ? pixel[0] : pixel[1]);
  pixels.push_back(isGrey ? pixel[0] : pixel[2]);
  pixels.push_back(hasAlpha ? pixel[components - 1] : 255);
}
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
  if (!vtkCSLFMaterial::GetTexture(material, slot, source, image.Repeat, image.Interpolate))
  {
    return nullptr;
  }
  auto* pixels = vtkUnsignedCharArray::SafeDownCast(source->GetPointData()->GetScalars());
  const int components = pixels->GetNumberOfComponents();
  const glm::vec3 white = GetDisplayedWhite(material);
  if (kind == TextureKind::Colors && white != glm::vec3(0.0f))
  {
    // Emission is displayed as it is.
    image.DisplayedWhite = slot == vtkCSLFMaterial::EmissionTexture ? glm::vec3(1.0f) : white;
  }
  image.Width = source->GetDimensions()[0];
  image.Height = source->GetDimensions()[1];
  const Key key(pixels->GetPointer(0), image.Width, image.Height, components, image.Repeat,
    image.Interpolate, kind, image.DisplayedWhite.x, image.DisplayedWhite.y,
    image.DisplayedWhite.z);
  std::shared_ptr<const Texture>& known = this->Known[key];
  if (!known)
  {
    image.Pixels.reserve(4 * pixels->GetNumberOfTuples());
    for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
    {
      AppendPixel(pixels->GetPointer(i * components), components, image.Pixels);
    }
    known = std::make_shared<const Texture>(std::move(image), kind);
  }
  return known;
}
}
