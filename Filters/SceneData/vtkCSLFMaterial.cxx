// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFMaterial.h"

#include "Pipeline/cslfArrayLayout.h"
#include "SceneData/cslfMaterialProblems.h"
#include "SceneData/cslfSurfaceAppearance.h"
#include "SceneData/cslfTextureImage.h"
#include "cslfColor.h"

#include <vtkAlgorithm.h>
#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

vtkStandardNewMacro(vtkCSLFMaterial);

namespace
{
using namespace cslf::material;

// Indexed by vtkCSLFMaterial::TextureSlots.
constexpr const char* TextureNames[] = { "CSLF:BaseColorTexture", "CSLF:MetallicRoughnessTexture",
  "CSLF:NormalTexture", "CSLF:EmissionTexture" };
constexpr const char* LayoutNames[] = { "CSLF:BaseColorTextureLayout",
  "CSLF:MetallicRoughnessTextureLayout", "CSLF:NormalTextureLayout", "CSLF:EmissionTextureLayout" };

enum LayoutComponents
{
  LayoutWidth,
  LayoutHeight,
  LayoutWrapU,
  LayoutInterpolate,
  LayoutSize,
  LayoutWrapV = LayoutSize, // of layouts with a border, from here on
  LayoutBorder,
  LayoutSizeWithBorder = LayoutBorder + 4
};

int ToWrap(double value)
{
  return static_cast<int>(std::clamp(value, 0.0, double(vtkCSLFMaterial::ClampToBorder)));
}

bool IsSlot(int slot)
{
  return slot >= 0 && slot < static_cast<int>(std::size(TextureNames));
}

void RemoveTexture(vtkDataObject* data, int slot)
{
  data->GetFieldData()->RemoveArray(TextureNames[slot]);
  data->GetFieldData()->RemoveArray(LayoutNames[slot]);
}

using PixelsAndLayout = std::pair<vtkSmartPointer<vtkUnsignedCharArray>, vtkDataArray*>;

/// The pixels and layout of a texture. Null if there is none that can be used.
PixelsAndLayout FindTexture(vtkDataObject* data, int slot)
{
  vtkFieldData* fields = data->GetFieldData();
  const auto pixels = cslf::ToAOS<vtkUnsignedCharArray>(fields->GetArray(TextureNames[slot]));
  vtkDataArray* layout = fields->GetArray(LayoutNames[slot]);
  if (!pixels || !layout || layout->GetNumberOfTuples() < 1 ||
    pixels->GetNumberOfComponents() > 4 ||
    (layout->GetNumberOfComponents() != LayoutSize &&
      layout->GetNumberOfComponents() != LayoutSizeWithBorder))
  {
    return {};
  }
  const double width = layout->GetComponent(0, LayoutWidth);
  const double height = layout->GetComponent(0, LayoutHeight);
  const bool fits = width >= 1.0 && height >= 1.0 && width <= VTK_INT_MAX &&
    height <= VTK_INT_MAX && width * height == static_cast<double>(pixels->GetNumberOfTuples());
  return fits ? PixelsAndLayout(pixels, layout) : PixelsAndLayout();
}

/// The layout of a texture, with its border, for changes. Null if there is no texture. Data sets
/// may share the existing array.
vtkSmartPointer<vtkIntArray> CopyLayout(vtkDataObject* data, int slot)
{
  vtkDataArray* layout = data && IsSlot(slot) ? FindTexture(data, slot).second : nullptr;
  if (!layout)
  {
    return nullptr;
  }
  auto copy = vtkSmartPointer<vtkIntArray>::New();
  copy->SetName(LayoutNames[slot]);
  copy->SetNumberOfComponents(LayoutSizeWithBorder);
  copy->SetNumberOfTuples(1);
  for (int i = 0; i < LayoutSizeWithBorder; ++i)
  {
    const bool isOnlyHere = i >= layout->GetNumberOfComponents();
    const double other = i == LayoutWrapV ? layout->GetComponent(0, LayoutWrapU) : 0.0;
    copy->SetComponent(0, i, isOnlyHere ? other : layout->GetComponent(0, i));
  }
  return copy;
}

void SetColors(vtkDataObject* data, const glm::dvec3& base, const glm::dvec3& emission)
{
  vtkCSLFMaterial::SetBaseColor(data, base.x, base.y, base.z);
  vtkCSLFMaterial::SetEmission(data, emission.x, emission.y, emission.z);
}

/// What the window shows without textures, in light that displays colours unchanged.
void SetFromClassicProperty(vtkDataObject* data, vtkProperty* property)
{
  const double* color = property->GetDiffuseColor();
  const glm::dvec3 diffuse(color[0], color[1], color[2]);
  color = property->GetAmbientColor();
  const glm::dvec3 ambient(color[0], color[1], color[2]);
  const cslf::Drawing drawing =
    property->GetLighting() ? cslf::Drawing::Lit : cslf::Drawing::Illuminating;
  const cslf::SurfaceAppearance look(property, cslf::LightLevel(), drawing, { diffuse });
  SetColors(data, look.GetBaseColor(ambient, diffuse), look.GetEmission(ambient, diffuse));
  vtkCSLFMaterial::SetMetallic(data, look.GetMetallic());
  vtkCSLFMaterial::SetRoughness(data, look.GetRoughness());
  vtkCSLFMaterial::SetIndexOfRefraction(data, look.GetIndexOfRefraction());
  vtkCSLFMaterial::SetNormalScale(data, Parameters[NormalScale].Default);
  for (int slot = 0; IsSlot(slot); ++slot)
  {
    RemoveTexture(data, slot);
  }
}

void SetFromPhysicalProperty(vtkDataObject* data, vtkProperty* property)
{
  const double* color = property->GetDiffuseColor();
  SetColors(data,
    cslf::LinearToSRGB(property->GetDiffuse() * glm::dvec3(color[0], color[1], color[2])),
    glm::dvec3(0.0));
  vtkCSLFMaterial::SetMetallic(data, property->GetMetallic());
  vtkCSLFMaterial::SetRoughness(data, property->GetRoughness());
  vtkCSLFMaterial::SetIndexOfRefraction(data, property->GetBaseIOR());
  vtkCSLFMaterial::SetNormalScale(data, property->GetNormalScale());
  const char* const names[] = { "albedoTex", "materialTex", "normalTex", "emissiveTex" };
  bool emissive = false;
  for (int slot = 0; IsSlot(slot); ++slot)
  {
    const bool textured =
      vtkCSLFMaterial::SetTextureFrom(data, slot, property->GetTexture(names[slot]));
    emissive = textured && slot == vtkCSLFMaterial::EmissionTexture;
  }
  const double* factor = property->GetEmissiveFactor();
  vtkCSLFMaterial::SetEmission(
    data, emissive ? factor[0] : 0.0, emissive ? factor[1] : 0.0, emissive ? factor[2] : 0.0);
}

/// The sides that culling leaves. VTK culls back faces if both kinds are to be culled.
int FindVisibleSides(vtkProperty* property)
{
  return property->GetBackfaceCulling() ? vtkCSLFMaterial::FrontSide
    : property->GetFrontfaceCulling()   ? vtkCSLFMaterial::BackSide
                                        : vtkCSLFMaterial::BothSides;
}

int FindWrap(vtkTexture* texture)
{
  switch (texture->GetWrap())
  {
    case vtkTexture::Repeat:
      return vtkCSLFMaterial::Repeat;
    case vtkTexture::MirroredRepeat:
      return vtkCSLFMaterial::MirroredRepeat;
    case vtkTexture::ClampToBorder:
      return vtkCSLFMaterial::ClampToBorder;
    default:
      return vtkCSLFMaterial::ClampToEdge;
  }
}

void Set(vtkDataObject* data, ParameterIndex index, const double* values)
{
  if (!data)
  {
    return;
  }
  const Parameter& parameter = Parameters[index];
  vtkNew<vtkDoubleArray> array;
  array->SetName(parameter.Name);
  array->SetNumberOfComponents(parameter.Components);
  array->SetNumberOfTuples(1);
  for (int i = 0; i < parameter.Components; ++i)
  {
    array->SetTypedComponent(0, i, Clamp(parameter, values[i]));
  }
  data->GetFieldData()->AddArray(array);
}

void Set(vtkDataObject* data, ParameterIndex index, double value)
{
  Set(data, index, &value);
}

vtkDataArray* Find(vtkDataObject* data, const Parameter& parameter)
{
  vtkDataArray* array = data ? data->GetFieldData()->GetArray(parameter.Name) : nullptr;
  return array && array->GetNumberOfTuples() > 0 &&
      array->GetNumberOfComponents() == parameter.Components
    ? array
    : nullptr;
}

void Get(vtkDataObject* data, ParameterIndex index, double* values)
{
  const Parameter& parameter = Parameters[index];
  vtkDataArray* array = Find(data, parameter);
  for (int i = 0; i < parameter.Components; ++i)
  {
    values[i] = array ? Clamp(parameter, array->GetComponent(0, i)) : parameter.Default;
  }
}

double Get(vtkDataObject* data, ParameterIndex index)
{
  double value = 0.0;
  Get(data, index, &value);
  return value;
}
}

void vtkCSLFMaterial::SetFromProperty(vtkDataObject* data, vtkProperty* property)
{
  if (!data || !property)
  {
    return;
  }
  SetTransmission(data, Parameters[Transmission].Default);
  SetThinWalled(data, false);
  SetOpacity(data, property->GetOpacity());
  SetOpacityCutoff(data, Parameters[OpacityCutoff].Default);
  SetVisibleSides(data, FindVisibleSides(property));
  if (property->GetInterpolation() == VTK_PBR && property->GetLighting())
  {
    SetFromPhysicalProperty(data, property);
  }
  else
  {
    SetFromClassicProperty(data, property);
  }
}

// Defines the methods of a parameter that is a colour.
#define cslfColorMacro(name)                                                                       \
  void vtkCSLFMaterial::Set##name(vtkDataObject* data, double red, double green, double blue)      \
  {                                                                                                \
    const double color[3] = { red, green, blue };                                                  \
    Set(data, name, color);                                                                        \
  }                                                                                                \
  void vtkCSLFMaterial::Get##name(vtkDataObject* data, double color[3])                            \
  {                                                                                                \
    Get(data, name, color);                                                                        \
  }

// Defines the methods of a parameter that is a number.
#define cslfNumberMacro(name, type)                                                                \
  void vtkCSLFMaterial::Set##name(vtkDataObject* data, type value)                                 \
  {                                                                                                \
    Set(data, name, value);                                                                        \
  }                                                                                                \
  type vtkCSLFMaterial::Get##name(vtkDataObject* data)                                             \
  {                                                                                                \
    return static_cast<type>(Get(data, name));                                                     \
  }

cslfColorMacro(BaseColor);
cslfNumberMacro(Metallic, double);
cslfNumberMacro(Roughness, double);
cslfColorMacro(Emission);
cslfNumberMacro(IndexOfRefraction, double);
cslfNumberMacro(Transmission, double);
cslfNumberMacro(ThinWalled, bool);
cslfNumberMacro(Opacity, double);
cslfNumberMacro(OpacityCutoff, double);
cslfNumberMacro(NormalScale, double);
cslfNumberMacro(LineRadius, double);
cslfNumberMacro(PointRadius, double);
cslfColorMacro(DisplayedWhite);
cslfNumberMacro(FinishedColors, bool);

void vtkCSLFMaterial::SetVisibleSides(vtkDataObject* data, int sides)
{
  Set(data, VisibleSides, sides);
}

int vtkCSLFMaterial::GetVisibleSides(vtkDataObject* data)
{
  return static_cast<int>(std::lround(Get(data, VisibleSides)));
}

const char* vtkCSLFMaterial::TextureName(int slot)
{
  return IsSlot(slot) ? TextureNames[slot] : nullptr;
}

const char* vtkCSLFMaterial::TextureLayoutName(int slot)
{
  return IsSlot(slot) ? LayoutNames[slot] : nullptr;
}

bool vtkCSLFMaterial::SetTexture(
  vtkDataObject* data, int slot, vtkImageData* image, bool repeat, bool interpolate)
{
  if (!data || !IsSlot(slot))
  {
    return false;
  }
  RemoveTexture(data, slot);
  if (!image)
  {
    return false;
  }
  int dimensions[3];
  image->GetDimensions(dimensions);
  const auto scalars = cslf::ToAOS<vtkUnsignedCharArray>(image->GetPointData()->GetScalars());
  if (!scalars || scalars->GetNumberOfComponents() > 4 || dimensions[0] < 1 || dimensions[1] < 1 ||
    dimensions[2] != 1)
  {
    vtkGenericWarningMacro("A texture was left out: its image must be two-dimensional, of unsigned "
                           "chars of 1 to 4 components.");
    return false;
  }
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->ShallowCopy(scalars);
  pixels->SetName(TextureNames[slot]);
  vtkNew<vtkIntArray> layout;
  layout->SetName(LayoutNames[slot]);
  layout->SetNumberOfComponents(LayoutSize);
  layout->InsertNextTuple4(dimensions[0], dimensions[1], repeat ? 1 : 0, interpolate ? 1 : 0);
  data->GetFieldData()->AddArray(pixels);
  data->GetFieldData()->AddArray(layout);
  return true;
}

bool vtkCSLFMaterial::SetTextureFrom(vtkDataObject* data, int slot, vtkTexture* texture)
{
  if (!texture)
  {
    return SetTexture(data, slot, nullptr);
  }
  if (texture->GetCubeMap() || !texture->GetInputAlgorithm())
  {
    vtkGenericWarningMacro("A texture was left out: it is a cube map or has no image.");
    return SetTexture(data, slot, nullptr);
  }
  texture->GetInputAlgorithm()->Update();
  const vtkSmartPointer<vtkImageData> image = cslf::MakeTextureImage(texture);
  if (!image)
  {
    vtkGenericWarningMacro(
      "A texture was left out: its image is three-dimensional or has no scalars, or its lookup "
      "table has no values.");
  }
  if (!SetTexture(data, slot, image, true, texture->GetInterpolate() != 0))
  {
    return false;
  }
  const int wrap = FindWrap(texture);
  SetTextureWrap(data, slot, wrap, wrap);
  if (wrap == ClampToBorder)
  {
    // OpenGL treats the border of sRGB-encoded textures as linear.
    const float* border = texture->GetBorderColor();
    const glm::dvec3 color(border[0], border[1], border[2]);
    const glm::dvec3 encoded = texture->GetUseSRGBColorSpace() ? cslf::LinearToSRGB(color) : color;
    SetTextureBorder(data, slot, encoded.x, encoded.y, encoded.z, border[3]);
  }
  return true;
}

bool vtkCSLFMaterial::GetTexture(
  vtkDataObject* data, int slot, vtkImageData* image, bool& repeat, bool& interpolate)
{
  if (!data || !image || !IsSlot(slot))
  {
    return false;
  }
  const auto [pixels, layout] = FindTexture(data, slot);
  if (!pixels)
  {
    return false;
  }
  image->Initialize();
  image->SetDimensions(static_cast<int>(layout->GetComponent(0, LayoutWidth)),
    static_cast<int>(layout->GetComponent(0, LayoutHeight)), 1);
  image->GetPointData()->SetScalars(pixels);
  repeat = ToWrap(layout->GetComponent(0, LayoutWrapU)) == Repeat;
  interpolate = layout->GetComponent(0, LayoutInterpolate) != 0.0;
  return true;
}

bool vtkCSLFMaterial::SetTextureWrap(vtkDataObject* data, int slot, int wrapU, int wrapV)
{
  const vtkSmartPointer<vtkIntArray> layout = CopyLayout(data, slot);
  if (layout)
  {
    layout->SetTypedComponent(0, LayoutWrapU, ToWrap(wrapU));
    layout->SetTypedComponent(0, LayoutWrapV, ToWrap(wrapV));
    data->GetFieldData()->AddArray(layout);
  }
  return layout != nullptr;
}

bool vtkCSLFMaterial::GetTextureWrap(vtkDataObject* data, int slot, int wraps[2])
{
  const vtkSmartPointer<vtkIntArray> layout = CopyLayout(data, slot);
  if (layout)
  {
    wraps[0] = ToWrap(layout->GetTypedComponent(0, LayoutWrapU));
    wraps[1] = ToWrap(layout->GetTypedComponent(0, LayoutWrapV));
  }
  return layout != nullptr;
}

bool vtkCSLFMaterial::SetTextureBorder(
  vtkDataObject* data, int slot, double red, double green, double blue, double alpha)
{
  const vtkSmartPointer<vtkIntArray> layout = CopyLayout(data, slot);
  if (layout)
  {
    const double color[4] = { red, green, blue, alpha };
    for (int i = 0; i < 4; ++i)
    {
      layout->SetTypedComponent(0, LayoutBorder + i, cslf::ToByte(color[i]));
    }
    data->GetFieldData()->AddArray(layout);
  }
  return layout != nullptr;
}

bool vtkCSLFMaterial::GetTextureBorder(vtkDataObject* data, int slot, double color[4])
{
  const vtkSmartPointer<vtkIntArray> layout = CopyLayout(data, slot);
  for (int i = 0; layout && i < 4; ++i)
  {
    color[i] = std::clamp(layout->GetTypedComponent(0, LayoutBorder + i) / 255.0, 0.0, 1.0);
  }
  return layout != nullptr;
}

void vtkCSLFMaterial::Inherit(vtkDataObject* data, vtkDataObject* fallback)
{
  for (const Parameter& parameter : Parameters)
  {
    vtkDataArray* array = Find(fallback, parameter);
    if (data && array && !Find(data, parameter))
    {
      data->GetFieldData()->AddArray(array);
    }
  }
  for (int slot = 0; data && fallback && IsSlot(slot); ++slot)
  {
    const auto [pixels, layout] = FindTexture(fallback, slot);
    if (pixels && !FindTexture(data, slot).first)
    {
      data->GetFieldData()->AddArray(pixels);
      data->GetFieldData()->AddArray(layout);
    }
  }
}

void vtkCSLFMaterial::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
