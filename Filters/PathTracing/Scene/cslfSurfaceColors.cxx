// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSurfaceColors.h"

#include "PathTracing/Materials/cslfDisplayedColor.h"
#include "Pipeline/cslfArrayLayout.h"
#include "SceneData/cslfTextureImage.h"
#include "cslfColor.h"
#include "cslfFingerprint.h"
#include "vtkCSLFMaterial.h"

#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkDiscretizableColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkScalarsToColors.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cslf
{
namespace
{
std::array<float, 256> MakeLinearTable()
{
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i)
  {
    table[i] = static_cast<float>(SRGBToLinear(i / 255.0));
  }
  return table;
}

/// A map as a texture. The second row is the colour of NaN.
std::shared_ptr<const Texture> MakeTexture(const ColorMap& map)
{
  TextureImage image;
  image.Width = static_cast<int>(map.Colors.size());
  image.Height = 2;
  image.Wraps[0] = TextureWrap::Edge;
  image.Wraps[1] = TextureWrap::Edge;
  image.Interpolate = false;
  for (const ColorMap::Pixel& color : map.Colors)
  {
    image.Pixels.insert(image.Pixels.end(), color.begin(), color.end());
  }
  for (int i = 0; i < image.Width; ++i)
  {
    image.Pixels.insert(image.Pixels.end(), map.NanColor.begin(), map.NanColor.end());
  }
  return std::make_shared<const Texture>(std::move(image), TextureKind::Colors);
}

std::string Identify(const ColorMap& map)
{
  const std::string text = DescribeColorMap(map);
  Fingerprint name;
  name.Add(std::vector<char>(text.begin(), text.end()));
  name.Add(map.Colors);
  name.Add(std::vector<ColorMap::Pixel>{ map.NanColor });
  return name.Finish();
}
}

SurfaceColors::SurfaceColors(vtkScalarsToColors* lookupTable)
  : LookupTable(lookupTable)
  , Range{ VTK_DOUBLE_MAX, VTK_DOUBLE_MIN }
{
}

void SurfaceColors::AddToRange(vtkDataArray* array)
{
  if (!HoldsColors(array) && array->GetNumberOfTuples() > 0)
  {
    double range[2];
    array->GetFiniteRange(range, 0);
    this->Range[0] = std::min(this->Range[0], range[0]);
    this->Range[1] = std::max(this->Range[1], range[1]);
  }
}

vtkScalarsToColors* SurfaceColors::FindTable(vtkDataArray* array) const
{
  return this->LookupTable ? this->LookupTable : array->GetLookupTable();
}

bool SurfaceColors::CanMap(vtkDataArray* array) const
{
  vtkScalarsToColors* table = this->FindTable(array);
  return HoldsColors(array) || !table || HasColors(table);
}

vtkScalarsToColors* SurfaceColors::GetTable(vtkDataArray* array)
{
  vtkScalarsToColors* table = this->FindTable(array);
  if (!table)
  {
    if (!this->DefaultTable)
    {
      this->DefaultTable = vtkSmartPointer<vtkLookupTable>::New();
      if (this->Range[0] <= this->Range[1])
      {
        this->DefaultTable->SetTableRange(this->Range);
      }
    }
    table = this->DefaultTable;
  }
  table->Build();
  return table;
}

vtkSmartPointer<vtkUnsignedCharArray> SurfaceColors::MapThroughTable(vtkDataArray* array)
{
  const std::lock_guard<std::mutex> lock(this->Mapping);
  vtkScalarsToColors* table = this->GetTable(array);
  return vtk::TakeSmartPointer(table->MapScalars(array, VTK_COLOR_MODE_MAP_SCALARS, -1));
}

MappedColors SurfaceColors::Map(vtkDataArray* array)
{
  vtkSmartPointer<vtkUnsignedCharArray> colors = vtkUnsignedCharArray::SafeDownCast(array);
  if (!HoldsColors(array))
  {
    colors = this->MapThroughTable(array);
  }

  static const std::array<float, 256> linear = MakeLinearTable();
  const int components = colors->GetNumberOfComponents();
  MappedColors result;
  result.Colors.reserve(colors->GetNumberOfTuples());
  bool translucent = false;
  const unsigned char* values = colors->GetPointer(0);
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i, values += components)
  {
    result.Colors.emplace_back(linear[values[0]], linear[values[1]], linear[values[2]]);
    if (components == 4)
    {
      result.Opacities.push_back(static_cast<float>(values[3]) / 255.0f);
      translucent = translucent || values[3] < 255;
    }
  }
  if (!translucent)
  {
    result.Opacities.clear();
  }
  return result;
}

MappedTable SurfaceColors::FindPlaces(vtkDataArray* array)
{
  MappedTable result;
  if (HoldsColors(array))
  {
    return result;
  }
  const std::lock_guard<std::mutex> lock(this->Mapping);
  vtkScalarsToColors* table = this->GetTable(array);
  const int components = array->GetNumberOfComponents();
  const int mode = table->GetVectorMode();
  if (components > 1 && mode == vtkScalarsToColors::RGBCOLORS)
  {
    return result;
  }
  auto known = this->Maps.find(table);
  if (known == this->Maps.end())
  {
    ColorMap map = MakeColorMap(table);
    const auto texture = map.Colors.empty() ? nullptr : MakeTexture(map);
    known = this->Maps.emplace(table, std::make_pair(std::move(map), texture)).first;
  }
  if (!known->second.second)
  {
    return result;
  }
  ColorMap map = known->second.first;
  const int component = std::clamp(table->GetVectorComponent(), 0, components - 1);
  const bool isMagnitude = components > 1 && mode == vtkScalarsToColors::MAGNITUDE;
  map.Array = array->GetName() ? array->GetName() : "";
  map.Component = NameComponent(array, isMagnitude ? -1 : component);
  result.Colors = known->second.second;
  result.Name = Identify(map);
  result.Places.reserve(array->GetNumberOfTuples());
  const glm::vec2 size(float(map.Colors.size()), 2.0f);
  std::vector<double> tuple(components);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    array->GetTuple(i, tuple.data());
    const glm::vec2 place(
      map.GetPlace(isMagnitude ? vtkMath::Norm(tuple.data(), components) : tuple[component]));
    result.Places.push_back((place + glm::vec2(0.0f, 0.5f)) / size);
  }
  result.Map = std::make_shared<const ColorMap>(std::move(map));
  return result;
}

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
