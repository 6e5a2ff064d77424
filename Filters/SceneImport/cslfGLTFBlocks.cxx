// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGLTFBlocks.h"

#include "cslfActorImporter.h"
#include "cslfColor.h"
#include "vtkCSLFMaterial.h"

#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <map>
#include <string>

namespace cslf
{
namespace
{
using Loader = vtkGLTFDocumentLoader;

template <typename Value>
const Value* Find(const std::vector<Value>& values, int index)
{
  return index >= 0 && index < static_cast<int>(values.size()) ? &values[index] : nullptr;
}

/// What an array's number of an integer type stands for in [0,1].
double GetUnit(vtkDataArray* array)
{
  switch (array->GetDataType())
  {
    case VTK_UNSIGNED_CHAR:
      return VTK_UNSIGNED_CHAR_MAX;
    case VTK_UNSIGNED_SHORT:
      return VTK_UNSIGNED_SHORT_MAX;
    default:
      return 1.0;
  }
}

/// Linear colours times a linear factor, as sRGB bytes; alpha if it counts.
vtkSmartPointer<vtkUnsignedCharArray> MakeColors(
  vtkDataArray* linear, const double factor[3], bool useAlpha)
{
  const double unit = GetUnit(linear);
  const int components = useAlpha && linear->GetNumberOfComponents() > 3 ? 4 : 3;
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetName("Colors");
  colors->SetNumberOfComponents(components);
  colors->SetNumberOfTuples(linear->GetNumberOfTuples());
  for (vtkIdType i = 0; i < linear->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < components; ++c)
    {
      const double value = linear->GetComponent(i, c) / unit;
      colors->SetTypedComponent(i, c, ToByte(c < 3 ? LinearToSRGB(factor[c] * value) : value));
    }
  }
  return colors;
}

/// An image without its alpha.
vtkSmartPointer<vtkImageData> DropAlpha(vtkImageData* image)
{
  auto* source = vtkUnsignedCharArray::SafeDownCast(image->GetPointData()->GetScalars());
  if (!source || source->GetNumberOfComponents() % 2 != 0)
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

class Builder
{
public:
  Builder(const Loader::Model& model, const std::vector<GLTFMaterialExtension>& extensions,
    ImportedScene& scene)
    : Model(model)
    , Extensions(extensions)
    , Scene(scene)
  {
  }

  void Build()
  {
    this->Omit(!this->Model.ExtensionMetaData.KHRLightsPunctualMetaData.Lights.empty(), "lights");
    if (const Loader::Scene* scene = Find(this->Model.Scenes, this->Model.DefaultScene))
    {
      for (unsigned int node : scene->Nodes)
      {
        this->AddNode(static_cast<int>(node));
      }
    }
  }

private:
  void Omit(bool present, const char* what)
  {
    if (present)
    {
      this->Scene.Omitted.insert(what);
    }
  }

  void AddNode(int index)
  {
    const Loader::Node* node = Find(this->Model.Nodes, index);
    if (!node)
    {
      return;
    }
    if (const Loader::Mesh* mesh = Find(this->Model.Meshes, node->Mesh))
    {
      this->Omit(node->Skin >= 0, "skins, which are shown at rest");
      for (const Loader::Primitive& primitive : mesh->Primitives)
      {
        this->AddPrimitive(primitive, node->GlobalTransform);
      }
    }
    for (int child : node->Children)
    {
      this->AddNode(child);
    }
  }

  void AddPrimitive(const Loader::Primitive& primitive, vtkMatrix4x4* transform)
  {
    if (!primitive.Geometry || primitive.Geometry->GetNumberOfPoints() == 0)
    {
      return;
    }
    this->Omit(!primitive.Targets.empty(), "morph targets, which are shown at rest");
    vtkSmartPointer<vtkPolyData> placed = ExtractSurface(primitive.Geometry, transform);
    vtkNew<vtkPolyData> block;
    block->CopyStructure(placed);
    block->GetPointData()->SetNormals(placed->GetPointData()->GetNormals());
    const double white[] = { 1.0, 1.0, 1.0 };
    const double* factor = white;
    bool useAlpha = false;
    const Loader::Material* material = Find(this->Model.Materials, primitive.Material);
    if (material)
    {
      this->SetMaterial(block, primitive, *material);
      useAlpha = material->AlphaMode != Loader::Material::AlphaModeType::OPAQUE;
      const std::vector<double>& color = material->PbrMetallicRoughness.BaseColorFactor;
      factor = color.size() >= 3 ? color.data() : white;
    }
    vtkDataArray* colors = primitive.Geometry->GetPointData()->GetArray("COLOR_0");
    if (colors && colors->GetNumberOfComponents() >= 3)
    {
      block->GetPointData()->SetScalars(MakeColors(colors, factor, useAlpha));
    }
    this->Scene.Blocks.push_back({ block, 1.0, 1.0 });
  }

  void SetMaterial(
    vtkPolyData* block, const Loader::Primitive& primitive, const Loader::Material& material)
  {
    using AlphaMode = Loader::Material::AlphaModeType;
    const auto& base = material.PbrMetallicRoughness;
    std::vector<double> color = base.BaseColorFactor;
    color.resize(4, 1.0);
    vtkCSLFMaterial::SetBaseColor(
      block, LinearToSRGB(color[0]), LinearToSRGB(color[1]), LinearToSRGB(color[2]));
    vtkCSLFMaterial::SetMetallic(block, base.MetallicFactor);
    vtkCSLFMaterial::SetRoughness(block, base.RoughnessFactor);
    const bool opaque = material.AlphaMode == AlphaMode::OPAQUE;
    vtkCSLFMaterial::SetOpacity(block, opaque ? 1.0 : color[3]);
    if (material.AlphaMode == AlphaMode::MASK)
    {
      vtkCSLFMaterial::SetOpacityCutoff(block, std::max(material.AlphaCutoff, 1e-6));
    }
    this->SetExtensions(block, primitive.Material, material);
    this->SetTextures(block, primitive, material, opaque);
    this->Omit(material.Unlit, "unlit materials, which are lit");
  }

  void SetExtensions(vtkPolyData* block, int index, const Loader::Material& material)
  {
    const GLTFMaterialExtension* found = Find(this->Extensions, index);
    const GLTFMaterialExtension extension = found ? *found : GLTFMaterialExtension();
    vtkCSLFMaterial::SetIndexOfRefraction(block, extension.IndexOfRefraction);
    vtkCSLFMaterial::SetTransmission(block, extension.Transmission);
    vtkCSLFMaterial::SetThinWalled(block, !extension.IsSolid);
    std::vector<double> emission = material.EmissiveFactor;
    emission.resize(3, 0.0);
    const double strength = extension.EmissiveStrength;
    vtkCSLFMaterial::SetEmission(
      block, strength * emission[0], strength * emission[1], strength * emission[2]);
  }

  void SetTextures(vtkPolyData* block, const Loader::Primitive& primitive,
    const Loader::Material& material, bool dropAlpha)
  {
    const auto& base = material.PbrMetallicRoughness;
    const std::pair<int, const Loader::TextureInfo*> slots[] = {
      { vtkCSLFMaterial::BaseColorTexture, &base.BaseColorTexture },
      { vtkCSLFMaterial::MetallicRoughnessTexture, &base.MetallicRoughnessTexture },
      { vtkCSLFMaterial::NormalTexture, &material.NormalTexture },
      { vtkCSLFMaterial::EmissionTexture, &material.EmissiveTexture },
    };
    const Loader::TextureInfo* first = nullptr;
    for (const auto& [slot, info] : slots)
    {
      const Loader::Texture* texture = Find(this->Model.Textures, info->Index);
      if (!texture)
      {
        continue;
      }
      first = first ? first : info;
      if (info->TexCoord != first->TexCoord)
      {
        this->Omit(true, "textures with a second set of coordinates");
        continue;
      }
      this->SetTexture(block, slot, *texture, dropAlpha);
    }
    if (material.NormalTexture.Index >= 0)
    {
      vtkCSLFMaterial::SetNormalScale(block, material.NormalTextureScale);
    }
    if (first)
    {
      this->SetCoordinates(block, primitive, first->TexCoord);
    }
  }

  void SetTexture(vtkPolyData* block, int slot, const Loader::Texture& texture, bool dropAlpha)
  {
    const Loader::Image* image = Find(this->Model.Images, texture.Source);
    if (!image || !image->ImageData)
    {
      this->Omit(true, "textures without an image");
      return;
    }
    bool repeat = true;
    bool interpolate = true;
    if (const Loader::Sampler* sampler = Find(this->Model.Samplers, texture.Sampler))
    {
      using Wrap = Loader::Sampler::WrapType;
      repeat = sampler->WrapS != Wrap::CLAMP_TO_EDGE && sampler->WrapT != Wrap::CLAMP_TO_EDGE;
      interpolate = sampler->MagFilter != Loader::Sampler::FilterType::NEAREST;
      this->Omit(sampler->WrapS == Wrap::MIRRORED_REPEAT || sampler->WrapT == Wrap::MIRRORED_REPEAT,
        "mirrored repetition of textures");
    }
    vtkSmartPointer<vtkImageData> pixels = image->ImageData;
    if (dropAlpha && slot == vtkCSLFMaterial::BaseColorTexture)
    {
      vtkSmartPointer<vtkImageData>& opaque = this->OpaqueImages[texture.Source];
      opaque = opaque ? opaque : DropAlpha(pixels);
      pixels = opaque;
    }
    vtkCSLFMaterial::SetTexture(block, slot, pixels, repeat, interpolate);
  }

  /// glTF's v grows downwards from the image's upper edge.
  void SetCoordinates(vtkPolyData* block, const Loader::Primitive& primitive, int set)
  {
    const std::string name = "TEXCOORD_" + std::to_string(set);
    vtkDataArray* source = primitive.Geometry->GetPointData()->GetArray(name.c_str());
    if (!source || source->GetNumberOfComponents() < 2)
    {
      return;
    }
    const double unit = GetUnit(source);
    vtkNew<vtkFloatArray> coordinates;
    coordinates->SetName("TextureCoordinates");
    coordinates->SetNumberOfComponents(2);
    coordinates->SetNumberOfTuples(source->GetNumberOfTuples());
    for (vtkIdType i = 0; i < source->GetNumberOfTuples(); ++i)
    {
      coordinates->SetTypedComponent(i, 0, static_cast<float>(source->GetComponent(i, 0) / unit));
      coordinates->SetTypedComponent(
        i, 1, static_cast<float>(1.0 - source->GetComponent(i, 1) / unit));
    }
    block->GetPointData()->SetTCoords(coordinates);
  }

  const Loader::Model& Model;
  const std::vector<GLTFMaterialExtension>& Extensions;
  ImportedScene& Scene;
  std::map<int, vtkSmartPointer<vtkImageData>> OpaqueImages; // by the number of the image
};
}

void BuildGLTFBlocks(const vtkGLTFDocumentLoader::Model& model,
  const std::vector<GLTFMaterialExtension>& extensions, ImportedScene& scene)
{
  Builder(model, extensions, scene).Build();
}
}
