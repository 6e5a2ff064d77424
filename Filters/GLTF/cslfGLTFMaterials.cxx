// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFMaterials.h"

#include "Files/cslfEncodedImage.h"
#include "cslfColor.h"
#include "vtkCSLFMaterial.h"

#include <algorithm>
#include <string>
#include <utility>

#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

namespace cslf
{
namespace
{
vtkSmartPointer<vtkImageData> Decode(const GLTFValue& owner, const GLTFBytes& bytes)
{
  std::string error;
  auto image = DecodeImage(bytes.Data, bytes.Size, "", error);
  if (!image)
  {
    owner.Fail(error);
  }
  return image;
}

/// An image without its alpha.
vtkSmartPointer<vtkImageData> DropAlpha(vtkImageData* image)
{
  auto* source = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  if (source->GetNumberOfComponents() % 2 != 0)
  {
    return image;
  }
  const int components = source->GetNumberOfComponents() - 1;
  vtkNew<vtkUnsignedCharArray> pixels;
  pixels->SetNumberOfComponents(components);
  pixels->SetNumberOfTuples(source->GetNumberOfTuples());
  for (vtkIdType i = 0; i < source->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      pixels->SetTypedComponent(i, c, source->GetTypedComponent(i, c));
    }
  }
  auto copy = vtkSmartPointer<vtkImageData>::New();
  copy->CopyStructure(image);
  copy->GetPointData()->SetScalars(pixels);
  return copy;
}
}

GLTFImages::GLTFImages(GLTFDocument& document)
  : Document(document)
{
}

vtkSmartPointer<vtkImageData> GLTFImages::Get(std::size_t index, bool dropAlpha)
{
  const std::pair<std::size_t, bool> key(index, dropAlpha);
  const auto found = this->Known.find(key);
  if (found != this->Known.end())
  {
    return found->second;
  }
  vtkSmartPointer<vtkImageData> image =
    dropAlpha ? DropAlpha(this->Get(index, false)) : this->Read(index);
  this->Known[key] = image;
  return image;
}

vtkSmartPointer<vtkImageData> GLTFImages::Read(std::size_t index)
{
  const GLTFValue image = this->Document.GetElement("images", index);
  if (const std::optional<std::size_t> view = image["bufferView"].GetIndex())
  {
    return Decode(image, this->Document.GetBufferView(*view));
  }
  const GLTFValue uri = image["uri"];
  if (!uri.IsPresent())
  {
    image.Fail("has neither a uri nor a bufferView");
  }
  const std::string bytes = this->Document.ReadResource(uri);
  return Decode(image, { reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), 0 });
}

namespace
{
// OpenGL's numbers: glTF 2.0, section 5.26.
constexpr std::size_t Nearest = 9728;
constexpr std::size_t ClampToEdge = 33071;
constexpr std::size_t MirroredRepeat = 33648;
constexpr std::size_t Repeat = 10497;

int ToWrap(std::size_t wrap)
{
  return wrap == ClampToEdge ? vtkCSLFMaterial::ClampToEdge
    : wrap == MirroredRepeat ? vtkCSLFMaterial::MirroredRepeat
                             : vtkCSLFMaterial::Repeat;
}
}

GLTFMaterials::GLTFMaterials(GLTFDocument& document, GLTFErrors& errors)
  : Document(document)
  , Errors(errors)
  , Images(document)
{
}

const GLTFMaterial& GLTFMaterials::Get(std::size_t index)
{
  const auto found = this->Known.find(index);
  if (found != this->Known.end())
  {
    return found->second;
  }
  const GLTFValue source = this->Document.GetElement("materials", index);
  GLTFMaterial& material = this->Known[index];
  material.Arrays = vtkSmartPointer<vtkPolyData>::New();
  // An error in one part does not affect the others.
  this->Errors.Attempt([&] { this->ReadFactors(source, material); });
  this->Errors.Attempt([&] { this->ReadAlpha(source, material); });
  this->Errors.Attempt([&] { this->ReadExtensions(source, material); });
  this->Errors.Attempt([&] { this->ReadTextures(source, material); });
  return material;
}

void GLTFMaterials::ReadFactors(const GLTFValue& source, GLTFMaterial& material)
{
  const GLTFValue base = source["pbrMetallicRoughness"];
  vtkPolyData* arrays = material.Arrays;
  vtkCSLFMaterial::SetMetallic(arrays, base["metallicFactor"].GetNumber(1.0));
  vtkCSLFMaterial::SetRoughness(arrays, base["roughnessFactor"].GetNumber(1.0));
  material.Color = base["baseColorFactor"].GetNumbers<4>({ 1.0, 1.0, 1.0, 1.0 });
  const auto& color = material.Color;
  vtkCSLFMaterial::SetBaseColor(
    arrays, LinearToSRGB(color[0]), LinearToSRGB(color[1]), LinearToSRGB(color[2]));
}

void GLTFMaterials::ReadAlpha(const GLTFValue& source, GLTFMaterial& material)
{
  const std::string mode = source["alphaMode"].GetText("OPAQUE");
  material.UsesAlpha = mode == "BLEND" || mode == "MASK";
  vtkCSLFMaterial::SetOpacity(material.Arrays, material.UsesAlpha ? material.Color[3] : 1.0);
  if (mode == "MASK")
  {
    const double cutoff = source["alphaCutoff"].GetNumber(0.5);
    vtkCSLFMaterial::SetOpacityCutoff(material.Arrays, std::max(cutoff, 1e-6));
  }
  else if (!material.UsesAlpha && mode != "OPAQUE")
  {
    source["alphaMode"].Fail("is not OPAQUE, MASK or BLEND");
  }
}

void GLTFMaterials::ReadExtensions(const GLTFValue& source, GLTFMaterial& material)
{
  const GLTFValue extensions = source["extensions"];
  const GLTFValue transmission = extensions["KHR_materials_transmission"];
  vtkPolyData* arrays = material.Arrays;
  vtkCSLFMaterial::SetIndexOfRefraction(
    arrays, extensions["KHR_materials_ior"]["ior"].GetNumber(1.5));
  vtkCSLFMaterial::SetTransmission(arrays, transmission["transmissionFactor"].GetNumber(0.0));
  this->Errors.Omit(transmission["transmissionTexture"].IsPresent(), "transmission textures");
  vtkCSLFMaterial::SetThinWalled(
    arrays, !(extensions["KHR_materials_volume"]["thicknessFactor"].GetNumber(0.0) > 0.0));
  this->Errors.Omit(
    extensions["KHR_materials_unlit"].IsPresent(), "unlit materials, which are lit");
  const double strength =
    extensions["KHR_materials_emissive_strength"]["emissiveStrength"].GetNumber(1.0);
  const auto emission = source["emissiveFactor"].GetNumbers<3>({ 0.0, 0.0, 0.0 });
  vtkCSLFMaterial::SetEmission(
    arrays, strength * emission[0], strength * emission[1], strength * emission[2]);
}

void GLTFMaterials::ReadTextures(const GLTFValue& source, GLTFMaterial& material)
{
  const GLTFValue base = source["pbrMetallicRoughness"];
  const GLTFValue normal = source["normalTexture"];
  const std::pair<int, GLTFValue> slots[] = {
    { vtkCSLFMaterial::BaseColorTexture, base["baseColorTexture"] },
    { vtkCSLFMaterial::MetallicRoughnessTexture, base["metallicRoughnessTexture"] },
    { vtkCSLFMaterial::NormalTexture, normal },
    { vtkCSLFMaterial::EmissionTexture, source["emissiveTexture"] },
  };
  for (const auto& slot : slots)
  {
    if (slot.second.IsPresent())
    {
      this->Errors.Attempt([&] { this->ReadTexture(slot.first, slot.second, material); });
    }
  }
  if (normal.IsPresent())
  {
    vtkCSLFMaterial::SetNormalScale(material.Arrays, normal["scale"].GetNumber(1.0));
  }
}

void GLTFMaterials::ReadTexture(int slot, const GLTFValue& info, GLTFMaterial& material)
{
  const std::optional<std::size_t> index = info["index"].GetIndex();
  if (!index)
  {
    info.Fail("has no index");
  }
  const GLTFValue texture = this->Document.GetElement("textures", *index);
  const bool dropAlpha = !material.UsesAlpha && slot == vtkCSLFMaterial::BaseColorTexture;
  const vtkSmartPointer<vtkImageData> image = this->Images.Get(this->FindImage(texture), dropAlpha);
  std::size_t wrap[2] = { Repeat, Repeat };
  std::size_t filter = 0;
  if (const std::optional<std::size_t> found = texture["sampler"].GetIndex())
  {
    const GLTFValue sampler = this->Document.GetElement("samplers", *found);
    wrap[0] = sampler["wrapS"].GetIndex(Repeat);
    wrap[1] = sampler["wrapT"].GetIndex(Repeat);
    filter = sampler["magFilter"].GetIndex(0);
  }
  if (this->TakeMapping(info, material))
  {
    vtkCSLFMaterial::SetTexture(material.Arrays, slot, image, true, filter != Nearest);
    vtkCSLFMaterial::SetTextureWrap(material.Arrays, slot, ToWrap(wrap[0]), ToWrap(wrap[1]));
  }
}

/// Uses the coordinates of the first texture for all. False if another texture needs different
/// ones.
bool GLTFMaterials::TakeMapping(const GLTFValue& info, GLTFMaterial& material)
{
  GLTFTextureMapping mapping;
  const GLTFValue transform = info["extensions"]["KHR_texture_transform"];
  mapping.Set = transform["texCoord"].GetIndex(info["texCoord"].GetIndex(0));
  mapping.Offset = transform["offset"].GetNumbers<2>(mapping.Offset);
  mapping.Scale = transform["scale"].GetNumbers<2>(mapping.Scale);
  mapping.Rotation = transform["rotation"].GetNumber(0.0);
  if (!material.HasTextures)
  {
    material.HasTextures = true;
    material.Mapping = mapping;
  }
  const bool fits = material.Mapping == mapping;
  this->Errors.Omit(!fits, "textures with a second set of coordinates");
  return fits;
}

std::size_t GLTFMaterials::FindImage(const GLTFValue& texture)
{
  const GLTFValue webp = texture["extensions"]["EXT_texture_webp"]["source"];
  const GLTFValue source = texture["source"];
  const std::optional<std::size_t> image = source.IsPresent() ? source.GetIndex() : webp.GetIndex();
  if (!image)
  {
    texture.Fail("has no readable image");
  }
  return *image;
}
}
