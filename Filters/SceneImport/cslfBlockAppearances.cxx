// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfBlockAppearances.h"

#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfTriangleList.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "Pipeline/cslfValidPolyData.h"
#include "SceneData/cslfSurfaceAppearance.h"
#include "cslfActorParts.h"
#include "cslfColor.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFMaterial.h"

#include <vtkBoundingBox.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/vector_relational.hpp>

#include <cstdlib>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
// The smallest change of a texture's levels that is worth a copy of the texture.
constexpr int UnseenDifference = 1;

/// The new levels of red, green and blue, indexed by the old ones.
using LevelMap = std::array<std::array<unsigned char, 256>, 3>;

/// Calls `get(value)` with a grey value, which yields linear colours, for each of 256 levels.
template <typename Get>
LevelMap MakeLevelMap(const Get& get)
{
  LevelMap map;
  for (int level = 0; level < 256; ++level)
  {
    const glm::dvec3 encoded = LinearToSRGB(get(level / 255.0));
    for (int c = 0; c < 3; ++c)
    {
      map[c][level] = ToByte(encoded[c]);
    }
  }
  return map;
}

bool IsSame(const LevelMap& map)
{
  for (const auto& channel : map)
  {
    for (int level = 0; level < 256; ++level)
    {
      if (std::abs(channel[level] - level) > UnseenDifference)
      {
        return false;
      }
    }
  }
  return true;
}

/// Maps colours of 1 to 4 components to 3 components, or 4 with alpha.
vtkSmartPointer<vtkUnsignedCharArray> MapLevels(vtkUnsignedCharArray* colors, const LevelMap& map)
{
  const int components = colors->GetNumberOfComponents();
  const bool isGrey = components < 3;
  const bool hasAlpha = components == 2 || components == 4;
  auto mapped = vtkSmartPointer<vtkUnsignedCharArray>::New();
  mapped->SetName(colors->GetName());
  mapped->SetNumberOfComponents(hasAlpha ? 4 : 3);
  mapped->SetNumberOfTuples(colors->GetNumberOfTuples());
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      const unsigned char level = colors->GetTypedComponent(i, isGrey ? 0 : c);
      mapped->SetTypedComponent(i, c, map[c][level]);
    }
    if (hasAlpha)
    {
      mapped->SetTypedComponent(i, 3, colors->GetTypedComponent(i, components - 1));
    }
  }
  return mapped;
}

/// Makes colours the finished ones of points or cells.
void SetFinished(vtkDataSetAttributes* attributes, vtkUnsignedCharArray* colors)
{
  vtkNew<vtkUnsignedCharArray> finished;
  finished->ShallowCopy(colors);
  finished->SetName(vtkCSLFMaterial::ColorsName());
  attributes->SetScalars(finished);
}

/// The colour that a block has instead of the property's, or that of the property.
glm::dvec3 FindOwnColor(const BlockAppearance& appearance, const double* color)
{
  return appearance.HasTable ? glm::dvec3(1.0)
    : appearance.Color       ? glm::make_vec3(appearance.Color->data())
                             : glm::make_vec3(color);
}

/// `a / b`, or 0 where b is 0.
glm::dvec3 Divide(const glm::dvec3& a, const glm::dvec3& b)
{
  glm::dvec3 result(0.0);
  for (int i = 0; i < 3; ++i)
  {
    result[i] = b[i] > 0.0 ? a[i] / b[i] : 0.0;
  }
  return result;
}

/// The image of a texture, and its continuation beyond its edges.
struct TextureSource
{
  vtkNew<vtkImageData> Image;
  bool Interpolate = false;
  int Wraps[2];
  double Border[4];

  /// False if there is none.
  bool Read(vtkDataObject* holder, int slot)
  {
    bool repeat = false;
    return vtkCSLFMaterial::GetTexture(holder, slot, this->Image, repeat, this->Interpolate) &&
      vtkCSLFMaterial::GetTextureWrap(holder, slot, this->Wraps) &&
      vtkCSLFMaterial::GetTextureBorder(holder, slot, this->Border);
  }

  vtkUnsignedCharArray* GetColors() const
  {
    return vtkUnsignedCharArray::SafeDownCast(this->Image->GetPointData()->GetScalars());
  }

  /// The border's colour as a pixel.
  vtkSmartPointer<vtkUnsignedCharArray> MakeBorder() const
  {
    auto border = vtkSmartPointer<vtkUnsignedCharArray>::New();
    border->SetNumberOfComponents(4);
    border->SetNumberOfTuples(1);
    for (int c = 0; c < 4; ++c)
    {
      border->SetTypedComponent(0, c, ToByte(this->Border[c]));
    }
    return border;
  }
};

/// Sets the appearance of one block.
class BlockFinisher
{
public:
  BlockFinisher(const ImportedBlock& block, const LightLevel& level, bool isLit)
    : Data(block.Data)
    , Appearance(block.Appearance)
    , Level(level)
    , Kind(GetDrawing(block.Appearance, isLit))
    , Ambient(this->GetColor(block.Appearance.Property->GetAmbientColor()))
    , Diffuse(this->GetColor(block.Appearance.Property->GetDiffuseColor()))
    , Surface(block.Appearance.Property, level, this->Kind, this->GetTypicalColors())
  {
  }

  void Finish(bool interpolateDisplayed)
  {
    // Pieces of one block share their field data.
    vtkNew<vtkFieldData> fields;
    fields->ShallowCopy(this->Data->GetFieldData());
    this->Data->SetFieldData(fields);

    vtkNew<vtkPolyData> material;
    this->SetFromProperty(material);
    vtkCSLFMaterial::SetOpacity(material, this->Appearance.Opacity);
    vtkCSLFMaterial::SetMetallic(material, this->Surface.GetMetallic());
    vtkCSLFMaterial::SetRoughness(material, this->Surface.GetRoughness());
    vtkCSLFMaterial::SetIndexOfRefraction(material, this->Surface.GetIndexOfRefraction());
    const glm::dvec3 base = this->Surface.GetBaseColor(this->Ambient, this->Diffuse);
    vtkCSLFMaterial::SetBaseColor(material, base.x, base.y, base.z);
    if (!this->IsPhysical())
    {
      const glm::dvec3 emission = this->Surface.GetEmission(this->Ambient, this->Diffuse);
      vtkCSLFMaterial::SetEmission(material, emission.x, emission.y, emission.z);
    }
    if (interpolateDisplayed && this->IsInterpolatedAsDisplayed())
    {
      const glm::dvec3 white = this->GetDisplayedWhite();
      vtkCSLFMaterial::SetDisplayedWhite(material, white.x, white.y, white.z);
    }
    this->FinishTexture(material);
    vtkCSLFMaterial::Inherit(this->Data, material);
    vtkCSLFMaterial::SetFinishedColors(this->Data, true);
    this->FinishColors(this->Data->GetPointData());
    this->FinishColors(this->Data->GetCellData());
    this->FinishInstances();
    this->FinishMap();
  }

private:
  static Drawing GetDrawing(const BlockAppearance& appearance, bool isLit)
  {
    const bool illuminates = !appearance.Property->GetLighting() || !isLit;
    return illuminates ? Drawing::Illuminating : appearance.IsUnlit ? Drawing::Unlit : Drawing::Lit;
  }

  /// Whether the window shades the block by the physically based model, which needs lights.
  bool IsPhysical() const
  {
    return this->Kind == Drawing::Lit && this->Appearance.Property->GetInterpolation() == VTK_PBR;
  }

  /// Whether the window shows the block's own colours as the physically based model shows light.
  bool IsUnlitLight() const
  {
    return UnlitPhysicalIsLight && this->Kind != Drawing::Lit &&
      this->Appearance.Property->GetInterpolation() == VTK_PBR;
  }

  /// A colour that the window shows, of one that it has.
  glm::dvec3 ToShown(const glm::dvec3& color) const
  {
    constexpr double gamma = 2.2;
    return this->IsUnlitLight() ? glm::pow(color, glm::dvec3(1.0 / gamma)) : color;
  }

  /// The property's material. Without lights, the window shows nothing of the physically based
  /// model but its colour.
  void SetFromProperty(vtkDataObject* material) const
  {
    vtkSmartPointer<vtkProperty> property = this->Appearance.Property;
    if (!this->IsPhysical() && property->GetInterpolation() == VTK_PBR)
    {
      property = CopyProperty(this->Appearance.Property);
      property->SetInterpolationToPhong();
    }
    vtkCSLFMaterial::SetFromProperty(material, property);
  }

  /// Whether the window interpolates displayed values. Physically based shading treats textures,
  /// and in older versions of VTK scalars as well, as light.
  bool IsInterpolatedAsDisplayed() const
  {
    const bool hasTexture =
      this->Appearance.HasTable || this->Appearance.Property->GetNumberOfTextures() > 0;
    return !(this->IsPhysical() || this->IsUnlitLight()) ||
      (PhysicalScalarsAreEncoded && !hasTexture);
  }

  /// The radiance of a white surface in the block's light; 1 if there is none.
  glm::dvec3 GetDisplayedWhite() const
  {
    const glm::dvec3 light = this->Level.Direct + this->Level.Around;
    return glm::mix(glm::dvec3(1.0), light, glm::greaterThan(light, glm::dvec3(0.0)));
  }

  glm::dvec3 GetColor(const double* color) const
  {
    return this->ToShown(FindOwnColor(this->Appearance, color));
  }

  /// The texture that the window shows: the actor's, which only the classic models use, or that of
  /// the base colour.
  vtkTexture* GetShownTexture() const
  {
    const bool isPhysical = this->IsPhysical() || this->IsUnlitLight();
    return isPhysical ? this->Appearance.Property->GetTexture("albedoTex")
                      : this->Appearance.Texture.Get();
  }

  /// The colour of the property, or greys from black to white if colours vary. The block's own
  /// colours would make the pieces of one surface differ.
  std::vector<glm::dvec3> GetTypicalColors() const
  {
    const bool varies = this->Appearance.HasTable || this->Appearance.Texture ||
      this->Data->GetPointData()->GetScalars() || this->Data->GetCellData()->GetScalars() ||
      this->Data->GetFieldData()->GetArray(vtkCSLFInstances::InstanceColor());
    if (!varies)
    {
      return { this->Diffuse };
    }
    return { glm::dvec3(0.0), glm::dvec3(0.5), glm::dvec3(1.0) };
  }

  /// The texture that the window shows, or that of a lookup table.
  void FinishTexture(vtkDataObject* material)
  {
    constexpr int slot = vtkCSLFMaterial::BaseColorTexture;
    if (!this->IsPhysical() && this->GetShownTexture() && !this->Appearance.HasTable)
    {
      vtkCSLFMaterial::SetTextureFrom(material, slot, this->GetShownTexture());
    }
    TextureSource source;
    vtkDataObject* holder = material;
    if (this->Appearance.HasTable)
    {
      holder = this->Data;
    }
    if (!source.Read(holder, slot))
    {
      return;
    }
    const bool isLinear = this->IsLinearTexture();
    const auto decode = [this, isLinear](double value)
    { return this->ToShown(glm::dvec3(isLinear ? SRGBToLinear(value) : value)).x; };
    const glm::dvec3 full = this->Surface.GetReflectance(this->Ambient, this->Diffuse);
    const auto reflect = [&](double value)
    {
      const double factor = decode(value);
      return Divide(
        this->Surface.GetReflectance(factor * this->Ambient, factor * this->Diffuse), full);
    };
    const auto shine = [&](double value)
    {
      const double factor = decode(value);
      return Divide(this->Surface.GetEmission(factor * this->Ambient, factor * this->Diffuse),
        this->Surface.GetEmission(this->Ambient, this->Diffuse));
    };
    if (this->Surface.IsEmissive())
    {
      SetTexture(material, vtkCSLFMaterial::EmissionTexture, source, MakeLevelMap(shine));
    }
    SetTexture(holder, slot, source, MakeLevelMap(reflect));
  }

  /// Whether the window converts the texture's colours to linear values.
  bool IsLinearTexture() const
  {
    if (this->Appearance.HasTable)
    {
      return (this->IsPhysical() || this->IsUnlitLight()) && PhysicalScalarsAreEncoded;
    }
    vtkTexture* texture = this->GetShownTexture();
    return texture && texture->GetUseSRGBColorSpace();
  }

  static void SetTexture(
    vtkDataObject* holder, int slot, const TextureSource& source, const LevelMap& map)
  {
    vtkNew<vtkImageData> mapped;
    mapped->SetDimensions(source.Image->GetDimensions());
    vtkSmartPointer<vtkUnsignedCharArray> levels = source.GetColors();
    vtkSmartPointer<vtkUnsignedCharArray> border = source.MakeBorder();
    if (!IsSame(map))
    {
      levels = MapLevels(levels, map);
      border = MapLevels(border, map);
    }
    mapped->GetPointData()->SetScalars(levels);
    vtkCSLFMaterial::SetTexture(holder, slot, mapped, true, source.Interpolate);
    vtkCSLFMaterial::SetTextureWrap(holder, slot, source.Wraps[0], source.Wraps[1]);
    const auto get = [&border](int c) { return border->GetTypedComponent(0, c) / 255.0; };
    vtkCSLFMaterial::SetTextureBorder(holder, slot, get(0), get(1), get(2), get(3));
  }

  /// The colour that the window's shading uses for a scalar's level.
  glm::dvec3 Decode(double value) const
  {
    const bool isEncoded =
      (this->IsPhysical() || this->IsUnlitLight()) && PhysicalScalarsAreEncoded;
    return this->ToShown(glm::dvec3(isEncoded ? SRGBToLinear(value) : value));
  }

  vtkSmartPointer<vtkUnsignedCharArray> FinishLevels(vtkUnsignedCharArray* colors) const
  {
    return MapLevels(colors,
      MakeLevelMap(
        [this](double value) { return this->Surface.GetReflectance(this->Decode(value)); }));
  }

  template <typename Array>
  vtkSmartPointer<Array> MakeEmissions(vtkUnsignedCharArray* colors, const char* name) const
  {
    std::array<glm::dvec3, 256> table;
    for (int level = 0; level < 256; ++level)
    {
      table[level] = this->Surface.GetEmission(this->Decode(level / 255.0));
    }
    auto emissions = vtkSmartPointer<Array>::New();
    emissions->SetName(name);
    emissions->SetNumberOfComponents(3);
    emissions->SetNumberOfTuples(colors->GetNumberOfTuples());
    for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        emissions->SetComponent(i, c, table[colors->GetTypedComponent(i, c)][c]);
      }
    }
    return emissions;
  }

  /// Colours of points or cells.
  void FinishColors(vtkDataSetAttributes* attributes)
  {
    auto* colors = vtkUnsignedCharArray::SafeDownCast(attributes->GetScalars());
    if (!colors || colors->GetNumberOfComponents() < 3)
    {
      return;
    }
    if (this->Surface.IsEmissive() && !attributes->GetArray(vtkCSLFMaterial::EmissionName()))
    {
      attributes->AddArray(
        this->MakeEmissions<vtkFloatArray>(colors, vtkCSLFMaterial::EmissionName()));
    }
    SetFinished(attributes, this->FinishLevels(colors));
  }

  void FinishInstances()
  {
    vtkFieldData* fields = this->Data->GetFieldData();
    auto* colors =
      vtkUnsignedCharArray::SafeDownCast(fields->GetArray(vtkCSLFInstances::InstanceColor()));
    if (!colors || colors->GetNumberOfComponents() < 3)
    {
      return;
    }
    if (this->Surface.IsEmissive())
    {
      fields->AddArray(
        this->MakeEmissions<vtkFloatArray>(colors, vtkCSLFInstances::InstanceEmission()));
    }
    fields->AddArray(this->FinishLevels(colors));
  }

  /// The map of the colours above.
  void FinishMap()
  {
    vtkFieldData* fields = this->Data->GetFieldData();
    auto* colors = vtkUnsignedCharArray::SafeDownCast(fields->GetArray(ColorMapColorsName));
    if (colors && colors->GetNumberOfComponents() == 4)
    {
      fields->AddArray(this->FinishLevels(colors));
    }
  }

  vtkPolyData* Data;
  const BlockAppearance& Appearance;
  LightLevel Level;
  Drawing Kind;
  glm::dvec3 Ambient;
  glm::dvec3 Diffuse;
  SurfaceAppearance Surface;
};

/// The middle of a box and half its largest side. For an empty box, the origin and 1.
std::pair<glm::dvec3, double> GetExtent(const vtkBoundingBox& box)
{
  if (!box.IsValid())
  {
    return { glm::dvec3(0.0), 1.0 };
  }
  double center[3];
  box.GetCenter(center);
  return { glm::make_vec3(center), 0.5 * box.GetMaxLength() };
}

void AddTo(ShadingModels& models, const BlockAppearance& appearance)
{
  if (!appearance.Property || !appearance.Property->GetLighting())
  {
    return;
  }
  if (appearance.IsUnlit)
  {
    models.Classic.emplace(0.0, 1.0);
  }
  else if (appearance.Property->GetInterpolation() == VTK_PBR)
  {
    models.Physical = true;
  }
  else
  {
    models.Classic.emplace(appearance.Property->GetAmbient(), appearance.Property->GetDiffuse());
  }
}
}

vtkBoundingBox GetPlacedBounds(vtkPolyData* data)
{
  vtkBoundingBox own;
  for (vtkCellArray* cells :
    { data->GetVerts(), data->GetLines(), data->GetPolys(), data->GetStrips() })
  {
    ForEachCell(cells,
      [&](vtkIdType, vtkIdType count, const vtkIdType* points)
      {
        for (vtkIdType i = 0; i < count; ++i)
        {
          double point[3];
          data->GetPoint(points[i], point);
          if (IsFinite({ point[0], point[1], point[2] }))
          {
            own.AddPoint(point);
          }
        }
      });
  }
  vtkDataArray* matrices = data->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix());
  if (!matrices || matrices->GetNumberOfComponents() != 16 || !own.IsValid())
  {
    return own;
  }
  double bounds[6];
  own.GetBounds(bounds);
  vtkBoundingBox all;
  for (vtkIdType i = 0; i < matrices->GetNumberOfTuples(); ++i)
  {
    double matrix[16];
    matrices->GetTuple(i, matrix);
    for (int corner = 0; corner < 8; ++corner)
    {
      const double point[4] = { bounds[corner & 1], bounds[2 + (corner >> 1 & 1)],
        bounds[4 + (corner >> 2)], 1.0 };
      double moved[4];
      vtkMatrix4x4::MultiplyPoint(matrix, point, moved);
      all.AddPoint(moved);
    }
  }
  return all;
}

void FinishAppearances(ImportedScene& scene, WindowLights& lights, bool interpolateDisplayed)
{
  ShadingModels models;
  vtkBoundingBox bounds;
  for (const ImportedBlock& block : scene.Blocks)
  {
    bounds.AddBox(GetPlacedBounds(block.Data));
    AddTo(models, block.Appearance);
  }
  if (scene.HasEnvironment && !models.Classic.empty())
  {
    scene.Meet(ImportLimit::ClassicEnvironments);
  }
  if (models.Classic.empty() && !models.Physical)
  {
    models.Classic.emplace(0.0, 1.0);
  }
  const auto whole = GetExtent(bounds);
  lights.Calibrate(whole.first, whole.second, models);
  for (const ImportedBlock& block : scene.Blocks)
  {
    if (!block.Appearance.Property)
    {
      continue;
    }
    const auto extent = GetExtent(GetPlacedBounds(block.Data));
    const bool physical = block.Appearance.Property->GetInterpolation() == VTK_PBR;
    const bool isLit = lights.IsLit() || (physical && scene.HasEnvironment);
    BlockFinisher finisher(block, lights.GetLevel(extent.first, extent.second), isLit);
    finisher.Finish(interpolateDisplayed);
  }
}

void FinishExactColors(ImportedScene& scene)
{
  for (const ImportedBlock& block : scene.Blocks)
  {
    const BlockAppearance& appearance = block.Appearance;
    if (!appearance.Property)
    {
      continue;
    }
    vtkNew<vtkPolyData> material;
    vtkCSLFMaterial::SetFromProperty(material, appearance.Property);
    vtkCSLFMaterial::SetOpacity(material, appearance.Opacity);
    const glm::dvec3 color = FindOwnColor(appearance, appearance.Property->GetDiffuseColor());
    vtkCSLFMaterial::SetBaseColor(material, color.x, color.y, color.z);
    vtkCSLFMaterial::SetEmission(material, 0.0, 0.0, 0.0);
    vtkCSLFMaterial::SetTexture(material, vtkCSLFMaterial::EmissionTexture, nullptr);
    vtkCSLFMaterial::SetDisplayedWhite(material, 1.0, 1.0, 1.0);
    if (appearance.Texture && appearance.Property->GetInterpolation() != VTK_PBR)
    {
      vtkCSLFMaterial::SetTextureFrom(
        material, vtkCSLFMaterial::BaseColorTexture, appearance.Texture);
    }
    // Pieces of one block share their field data.
    vtkNew<vtkFieldData> fields;
    fields->ShallowCopy(block.Data->GetFieldData());
    block.Data->SetFieldData(fields);
    vtkCSLFMaterial::Inherit(block.Data, material);
    vtkCSLFMaterial::SetFinishedColors(block.Data, true);
    for (vtkDataSetAttributes* attributes :
      { static_cast<vtkDataSetAttributes*>(block.Data->GetPointData()),
        static_cast<vtkDataSetAttributes*>(block.Data->GetCellData()) })
    {
      if (auto* colors = vtkUnsignedCharArray::SafeDownCast(attributes->GetScalars()))
      {
        SetFinished(attributes, colors);
      }
    }
  }
}
}
