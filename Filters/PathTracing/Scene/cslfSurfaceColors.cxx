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
// The largest number of steps of a table as a texture. Tables of continuous colours have it.
constexpr int MaximumSteps = 4096;

// The distance of values in the range from its ends, as a fraction of the texture, so that floats
// never round them to values outside.
constexpr double Inset = 1e-6;

std::array<float, 256> MakeLinearTable()
{
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i)
  {
    table[i] = static_cast<float>(SRGBToLinear(i / 255.0));
  }
  return table;
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

double SurfaceColors::Scale::GetPosition(double value) const
{
  const auto convert = [this](double number)
  { return this->IsLogarithmic ? std::log10(std::max(number, VTK_DBL_MIN)) : number; };
  const double first = convert(this->Range[0]);
  return (convert(value) - first) / (convert(this->Range[1]) - first);
}

glm::vec2 SurfaceColors::Scale::GetPlace(double value) const
{
  if (std::isnan(value))
  {
    return { 0.0f, 0.75f };
  }
  double column = 1.0 + this->Steps * this->GetPosition(value);
  if (value >= this->Range[0] && value <= this->Range[1])
  {
    const double inset = Inset * (this->Steps + 2);
    column = std::clamp(column, 1.0 + inset, 1.0 + this->Steps - inset);
  }
  // Far outside, it must remain a number that floats can interpolate.
  const double place = std::clamp(column / (this->Steps + 2), -1e6, 1e6);
  return { static_cast<float>(place), 0.25f };
}

SurfaceColors::Scale SurfaceColors::MakeScale(vtkScalarsToColors* table)
{
  Scale scale;
  std::copy_n(table->GetRange(), 2, scale.Range);
  scale.IsLogarithmic = table->UsingLogScale() != 0;
  const bool isValid = scale.Range[0] < scale.Range[1] &&
    std::isfinite(scale.Range[1] - scale.Range[0]) &&
    !(scale.IsLogarithmic && scale.Range[0] <= 0.0);
  if (!isValid)
  {
    return scale;
  }
  const vtkIdType colors = table->GetNumberOfAvailableColors();
  scale.Steps = colors > 0 && colors <= MaximumSteps ? static_cast<int>(colors) : MaximumSteps;
  const int columns = scale.Steps + 2;
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfTuples(2 * columns);
  for (int i = 0; i < columns; ++i)
  {
    double part = (i - 0.5) / scale.Steps;
    part = i == 0 ? -1.0 : i == columns - 1 ? 2.0 : part;
    values->SetValue(i,
      scale.IsLogarithmic ? scale.Range[0] * std::pow(scale.Range[1] / scale.Range[0], part)
                          : scale.Range[0] + part * (scale.Range[1] - scale.Range[0]));
    values->SetValue(columns + i, vtkMath::Nan());
  }
  const auto mapped =
    vtk::TakeSmartPointer(table->MapScalars(values, VTK_COLOR_MODE_MAP_SCALARS, 0, VTK_RGBA));
  TextureImage image;
  image.Width = columns;
  image.Height = 2;
  image.Wraps[0] = TextureWrap::Edge;
  image.Wraps[1] = TextureWrap::Edge;
  image.Interpolate = false;
  image.Pixels.assign(
    mapped->GetPointer(0), mapped->GetPointer(0) + 4 * mapped->GetNumberOfTuples());
  Fingerprint name;
  name.Add(image.Pixels);
  scale.Name = name.Finish();
  scale.Colors = std::make_shared<const Texture>(std::move(image), TextureKind::Colors);
  return scale;
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
  if (table->GetIndexedLookup() || (components > 1 && mode == vtkScalarsToColors::RGBCOLORS))
  {
    return result;
  }
  const auto known = this->Scales.find(table);
  const Scale& scale =
    known != this->Scales.end() ? known->second : this->Scales[table] = MakeScale(table);
  if (!scale.Colors)
  {
    return result;
  }
  result.Colors = scale.Colors;
  result.Name = scale.Name;
  result.Places.reserve(array->GetNumberOfTuples());
  const int component = std::clamp(table->GetVectorComponent(), 0, components - 1);
  std::vector<double> tuple(components);
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    array->GetTuple(i, tuple.data());
    const bool isVector = components > 1 && mode == vtkScalarsToColors::MAGNITUDE;
    result.Places.push_back(
      scale.GetPlace(isVector ? vtkMath::Norm(tuple.data(), components) : tuple[component]));
  }
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
