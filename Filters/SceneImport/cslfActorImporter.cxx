// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfActorImporter.h"

#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "Pipeline/cslfValidPolyData.h"
#include "SceneData/cslfTextureImage.h"
#include "cslfAMRSurface.h"
#include "cslfActorParts.h"
#include "cslfCellKinds.h"
#include "cslfClippedBlock.h"
#include "cslfFaceSides.h"
#include "cslfGlyphImporter.h"
#include "cslfMappedScalars.h"
#include "vtkCSLFInstances.h"
#include "vtkCSLFMaterial.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkCellData.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkDataObjectTree.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkMapper.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkMatrixToLinearTransform.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkReverseSense.h>
#include <vtkScalarsToColors.h>
#include <vtkShaderProperty.h>
#include <vtkStringArray.h>
#include <vtkTexture.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkUniformGridAMR.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace cslf
{
namespace
{
/// How a block of composite data differs from its actor.
struct BlockStyle
{
  bool Visible = true;
  std::optional<std::array<double, 3>> Color;
  std::optional<double> Opacity;

  /// The mapper's attributes of a data object, which its children inherit.
  BlockStyle Of(vtkCompositeDataDisplayAttributes* attributes, vtkDataObject* data) const
  {
    BlockStyle style = *this;
    if (!attributes)
    {
      return style;
    }
    if (attributes->HasBlockVisibility(data))
    {
      style.Visible = attributes->GetBlockVisibility(data);
    }
    if (attributes->HasBlockColor(data))
    {
      style.Color.emplace();
      attributes->GetBlockColor(data, style.Color->data());
    }
    if (attributes->HasBlockOpacity(data))
    {
      style.Opacity = attributes->GetBlockOpacity(data);
    }
    return style;
  }
};

void UpdateInputs(vtkMapper* mapper)
{
  for (int port = 0; port < mapper->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < mapper->GetNumberOfInputConnections(port); ++i)
    {
      mapper->GetInputAlgorithm(port, i)->Update();
    }
  }
}

// The radii that points may have. They are in the world, like those of materials: VTK's mappers of
// spheres and sticks do not scale them by the actor's matrix either.
const char* const RadiusNames[] = { vtkCSLFMaterial::LineRadiusName(),
  vtkCSLFMaterial::PointRadiusName() };

/// Whether points or lines are also spheres and tubes in the window.
bool HasRadii(vtkPolyData* data)
{
  return vtkCSLFMaterial::GetLineRadius(data) > 0.0 ||
    vtkCSLFMaterial::GetPointRadius(data) > 0.0 ||
    std::any_of(std::begin(RadiusNames), std::end(RadiusNames),
      [data](const char* name) { return data->GetPointData()->HasArray(name) != 0; });
}

/// Keeps only the geometry: points, cells, normals of both, texture coordinates, flags of edges,
/// radii, and emissions of points and cells.
vtkSmartPointer<vtkPolyData> CopyGeometry(vtkPolyData* source)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->CopyStructure(source);
  copy->GetPointData()->SetNormals(source->GetPointData()->GetNormals());
  copy->GetCellData()->SetNormals(source->GetCellData()->GetNormals());
  copy->GetPointData()->SetTCoords(source->GetPointData()->GetTCoords());
  CopyEdgeFlags(source, copy);
  for (const char* name : RadiusNames)
  {
    if (vtkDataArray* radii = source->GetPointData()->GetArray(name))
    {
      copy->GetPointData()->AddArray(radii);
    }
  }
  const char* emission = vtkCSLFMaterial::EmissionName();
  if (vtkDataArray* radiance = source->GetPointData()->GetArray(emission))
  {
    copy->GetPointData()->AddArray(radiance);
  }
  if (vtkDataArray* radiance = source->GetCellData()->GetArray(emission))
  {
    copy->GetCellData()->AddArray(radiance);
  }
  return copy;
}

/// Whether the actor has shaders that may change its appearance in the window.
bool HasShaders(vtkActor* actor)
{
  vtkShaderProperty* shaders = actor->GetShaderProperty();
  return shaders->GetNumberOfShaderReplacements() > 0 || shaders->HasVertexShaderCode() ||
    shaders->HasFragmentShaderCode() || shaders->HasGeometryShaderCode();
}

bool IsProjective(vtkMatrix4x4* matrix)
{
  const double* row = matrix->GetData() + 12;
  return row[0] != 0.0 || row[1] != 0.0 || row[2] != 0.0 || row[3] != 1.0;
}

/// Records what is not imported from any actor, whatever its mapper.
void FindActorLimits(vtkActor* actor, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  if (HasShaders(actor))
  {
    scene.Meet(ImportLimit::Shaders);
  }
  if (IsProjective(matrix ? matrix : actor->GetMatrix()))
  {
    scene.Meet(ImportLimit::ProjectiveMatrices);
  }
  if (actor->GetForceOpaque() && actor->GetProperty()->GetOpacity() < 1.0)
  {
    scene.Meet(ImportLimit::ForcedOpaque);
  }
}

/// Imports one actor.
class Importer
{
public:
  Importer(vtkActor* actor, vtkMatrix4x4* matrix, ImportedScene& scene)
    : Actor(actor)
    , Mapper(actor->GetMapper())
    , Property(actor->GetProperty())
    , Matrix(matrix)
    , Scene(scene)
    , Attributes(GetDisplayAttributes(actor->GetMapper()))
  {
  }

  /// Returns whether geometry was found or reported as broken.
  bool Import()
  {
    this->FindLimits();
    this->Appearance.Property = this->Property;
    this->Appearance.Texture = this->FindTexture();
    this->Appearance.Opacity = this->Property->GetOpacity();
    if (auto* glyphs = vtkGlyph3DMapper::SafeDownCast(this->Mapper))
    {
      for (vtkPolyData* source : ImportGlyphs(this->Actor, glyphs, this->Matrix, this->Scene))
      {
        this->AddRepresentation(source);
      }
      return true; // sources without instances show nothing, and broken ones were reported
    }
    this->ImportData(this->Mapper->GetInputDataObject(0, 0), BlockStyle());
    return this->Found;
  }

private:
  void MeetIf(bool present, ImportLimit limit)
  {
    if (present)
    {
      this->Scene.Meet(limit);
    }
  }

  void FindLimits()
  {
    const bool physical = this->Property->GetInterpolation() == VTK_PBR;
    this->MeetIf(
      this->Actor->GetBackfaceProperty() && (physical || this->Mapper->IsA("vtkGlyph3DMapper")),
      ImportLimit::BackfaceProperties);
    this->MeetIf((this->Property->GetBackfaceCulling() || this->Property->GetFrontfaceCulling()) &&
        this->Property->GetEdgeVisibility() && this->Property->GetRepresentation() == VTK_SURFACE,
      ImportLimit::CulledEdges);
    this->MeetIf(physical && this->Property->GetCoatStrength() > 0.0, ImportLimit::Coats);
    this->MeetIf(physical && this->Property->GetAnisotropy() != 0.0, ImportLimit::Anisotropy);
  }

  /// The texture of the actor. Classic shading also multiplies by those that its property has under
  /// names other than those of PBR's textures; the first of them is used if the actor has none.
  vtkTexture* FindTexture()
  {
    vtkTexture* found = this->Actor->GetTexture();
    if (this->Property->GetInterpolation() == VTK_PBR)
    {
      return found;
    }
    static const std::set<std::string> physical = { "albedoTex", "materialTex", "normalTex",
      "emissiveTex", "brdfTex", "anisotropyTex", "coatNormalTex" };
    for (const auto& [name, texture] : this->Property->GetAllTextures())
    {
      if (texture && physical.count(name) == 0)
      {
        this->MeetIf(found != nullptr, ImportLimit::PropertyTextures);
        found = found ? found : texture;
      }
    }
    return found;
  }

  void ImportData(vtkDataObject* data, const BlockStyle& inherited)
  {
    const BlockStyle style = inherited.Of(this->Attributes, data);
    // Grids of several levels are trees in newer versions of VTK.
    if (auto* grids = vtkUniformGridAMR::SafeDownCast(data))
    {
      this->ImportData(ExtractAMRSurface(grids), style);
      return;
    }
    if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
    {
      vtkSmartPointer<vtkDataObjectTreeIterator> child;
      child.TakeReference(tree->NewTreeIterator());
      child->VisitOnlyLeavesOff();
      child->TraverseSubTreeOff();
      for (child->InitTraversal(); !child->IsDoneWithTraversal(); child->GoToNextItem())
      {
        this->ImportData(child->GetCurrentDataObject(), style);
      }
      return;
    }
    auto* leaf = vtkDataSet::SafeDownCast(data);
    if (!leaf || leaf->GetNumberOfPoints() == 0 || leaf->GetNumberOfCells() == 0 || !style.Visible)
    {
      return;
    }
    if (auto* polyData = vtkPolyData::SafeDownCast(leaf))
    {
      const ValidPolyData sound = MakeSound(polyData);
      sound.AddRemoved(this->Scene.Omitted);
      this->Found = this->Found || !sound.IsWhole();
      this->ImportLeaf(sound.Data, style);
      return;
    }
    this->ImportLeaf(leaf, style);
  }

  void ImportLeaf(vtkDataSet* leaf, const BlockStyle& style)
  {
    vtkSmartPointer<vtkPolyData> surface = ExtractSurface(leaf, this->Matrix);
    MappedScalars mapped;
    this->Appearance.Color = style.Color;
    if (!style.Color)
    {
      this->Appearance.Color = FindColorOfMissing(this->Mapper, surface);
      mapped = MapScalars(this->Mapper, surface, !this->IsTextured(), this->Scene);
      this->MeetIf(mapped.Colors && mapped.WantsTable, ImportLimit::TexturedTables);
    }
    vtkSmartPointer<vtkPolyData> block = CopyGeometry(surface);
    this->CopyKeptArrays(surface->GetPointData(), block->GetPointData());
    this->CopyKeptArrays(surface->GetCellData(), block->GetCellData());
    TransformTCoords(this->Actor, block);
    // The data's own material takes precedence over the property.
    this->Scene.Materials.FindUnused(leaf);
    vtkCSLFMaterial::Inherit(block, leaf);
    this->Appearance.Opacity = style.Opacity.value_or(this->Property->GetOpacity());
    this->Appearance.HasTable = mapped.Table != nullptr;
    SetColors(block, mapped);
    this->AddRepresentation(block);
  }

  /// Keeps arrays that the mapper does not show. None takes the place of what there is.
  void CopyKeptArrays(vtkDataSetAttributes* from, vtkDataSetAttributes* block) const
  {
    for (int i = 0; i < from->GetNumberOfArrays() && this->Scene.KeepsArray; ++i)
    {
      vtkDataArray* array = from->GetArray(i);
      const char* name = array ? array->GetName() : nullptr;
      if (name && !block->HasArray(name) && this->Scene.KeepsArray(name))
      {
        block->AddArray(array);
      }
    }
  }

  void AddRepresentation(vtkPolyData* block)
  {
    if (this->Property->GetInterpolation() == VTK_FLAT)
    {
      block->GetPointData()->SetNormals(nullptr);
    }
    switch (this->Property->GetRepresentation())
    {
      case VTK_POINTS:
        this->Appearance.IsUnlit = this->IsDrawnUnlit(block, CellKind::Vertices);
        this->Add(MakePoints(block));
        break;
      case VTK_WIREFRAME:
        this->AddWireframe(block);
        break;
      default:
        this->AddSurface(block);
    }
    this->AddDecoration(block);
  }

  void AddSurface(vtkPolyData* block)
  {
    const auto [lit, unlit] = this->DivideByLighting(block);
    for (const bool isUnlit : { true, false })
    {
      this->Appearance.IsUnlit = isUnlit;
      this->AddFaces(SpreadCellNormals(SelectCells(block, isUnlit ? unlit : lit)));
    }
  }

  void AddWireframe(vtkPolyData* block)
  {
    for (const CellKind kind : { CellKind::Vertices, CellKind::Lines, CellKind::Faces })
    {
      if (CountCells(block, kind) > 0)
      {
        this->Appearance.IsUnlit = this->IsDrawnUnlit(block, kind);
        this->Add(
          kind == CellKind::Vertices ? SelectCells(block, { kind }) : MakeEdges(block, kind));
      }
    }
  }

  /// The two sides of faces may look different.
  void AddFaces(vtkPolyData* block)
  {
    const BlockAppearance appearance = this->Appearance;
    const bool isReflected = this->Matrix && this->Matrix->Determinant() < 0.0;
    for (const FaceSide& side :
      DivideBySides(this->Actor, block, isReflected, this->IsColored(block)))
    {
      this->Appearance.Property = side.Property;
      if (side.IsBack)
      {
        this->Appearance.Opacity = side.Property->GetOpacity();
      }
      this->Add(side.Block);
      this->Appearance = appearance;
    }
    this->Found = this->Found || block->GetNumberOfCells() > 0;
  }

  /// Whether a block gets its colours from scalars or from its attributes.
  bool IsColored(vtkPolyData* block) const
  {
    return this->Appearance.HasTable || this->Appearance.Color ||
      block->GetPointData()->GetScalars() || block->GetCellData()->GetScalars() ||
      block->GetFieldData()->HasArray(vtkCSLFInstances::InstanceColor());
  }

  /// Whether the window omits the lights, as for lines and points without normals. Points of any
  /// cell are drawn like vertices.
  bool IsDrawnUnlit(vtkPolyData* block, CellKind kind) const
  {
    if (kind == CellKind::Faces || block->GetPointData()->GetNormals() || HasRadii(block))
    {
      return false;
    }
    return kind == CellKind::Lines
      ? !this->Property->GetRenderLinesAsTubes() || this->Property->GetLineWidth() <= 1.0
      : !this->Property->GetRenderPointsAsSpheres();
  }

  /// The kinds of a block's cells that the window lights, and those for which it omits the lights.
  std::pair<CellKinds, CellKinds> DivideByLighting(vtkPolyData* block) const
  {
    std::pair<CellKinds, CellKinds> kinds;
    for (const CellKind kind : { CellKind::Vertices, CellKind::Lines, CellKind::Faces })
    {
      (this->IsDrawnUnlit(block, kind) ? kinds.second : kinds.first).insert(kind);
    }
    return kinds;
  }

  /// The physically based model shows the property's textures, the other models those of
  /// FindTexture.
  bool IsTextured() const
  {
    return this->Property->GetInterpolation() == VTK_PBR ? this->Property->GetNumberOfTextures() > 0
                                                         : this->Appearance.Texture != nullptr;
  }

  static void SetColors(vtkPolyData* block, const MappedScalars& mapped)
  {
    if (mapped.Table)
    {
      vtkCSLFMaterial::SetTexture(
        block, vtkCSLFMaterial::BaseColorTexture, mapped.Table, false, false);
      mapped.Coordinates->SetName("TextureCoordinates");
      block->GetPointData()->SetTCoords(mapped.Coordinates);
      vtkNew<vtkStringArray> map;
      map->SetName(ColorMapsName);
      map->InsertNextValue(mapped.Map);
      block->GetFieldData()->AddArray(map);
    }
    if (mapped.Colors)
    {
      mapped.Colors->SetName("Colors");
      vtkDataSetAttributes* attributes = block->GetPointData();
      if (mapped.OfCells)
      {
        attributes = block->GetCellData();
      }
      if (mapped.Scalars)
      {
        attributes->AddArray(mapped.Scalars);
        AddColorMaps({ mapped.ColorsOfScalars }, block);
      }
      attributes->SetScalars(mapped.Colors);
    }
  }

  /// Adds the part of a block that clipping planes leave.
  void Add(vtkPolyData* block)
  {
    this->Found = this->Found || block->GetNumberOfCells() > 0;
    if (this->Mapper->GetNumberOfClippingPlanes() == 0)
    {
      this->AddPiece(block);
      return;
    }
    this->MeetIf(
      block->GetNumberOfLines() + block->GetNumberOfVerts() > 0, ImportLimit::ClippedLines);
    for (const auto& piece :
      ClipBlock(block, this->Mapper->GetClippingPlanes(), this->Scene.Omitted))
    {
      this->AddPiece(piece);
    }
  }

  void AddPiece(vtkPolyData* piece)
  {
    if (piece->GetNumberOfCells() > 0)
    {
      this->Scene.Blocks.push_back({ piece, this->Property->GetLineWidth(),
        this->Property->GetPointSize(), this->Appearance });
    }
  }

  /// Edges and vertices that are drawn over the block with their own colours.
  void AddDecoration(vtkPolyData* block)
  {
    const BlockAppearance appearance = this->Appearance;
    const bool hasEdges =
      this->Property->GetEdgeVisibility() && this->Property->GetRepresentation() == VTK_SURFACE;
    if (hasEdges)
    {
      this->SetBareAppearance(
        this->Property->GetEdgeColor(), this->Property->GetRenderLinesAsTubes());
      this->Add(MakeBare(MakeEdges(SelectCells(block, { CellKind::Faces }), CellKind::Faces)));
    }
    if (this->Property->GetVertexVisibility() && (hasEdges || !VerticesNeedEdges))
    {
      this->SetBareAppearance(
        this->Property->GetVertexColor(), this->Property->GetRenderPointsAsSpheres());
      this->Appearance.Property->SetSpecular(0.0);
      this->Add(MakeBare(MakePoints(block, true)));
    }
    this->Appearance = appearance;
  }

  /// One colour, drawn with the property's lighting or without lights.
  void SetBareAppearance(const double* color, bool isLit)
  {
    const double opacity = this->Appearance.Opacity;
    this->Appearance = BlockAppearance();
    this->Appearance.Opacity = opacity;
    this->Appearance.IsUnlit = !isLit;
    this->Appearance.Property =
      isLit ? CopyProperty(this->Property) : vtkSmartPointer<vtkProperty>::New();
    this->Appearance.Property->RemoveAllTextures();
    this->Appearance.Property->SetLighting(this->Property->GetLighting());
    this->Appearance.Property->SetColor(color[0], color[1], color[2]);
  }

  /// Only a block's geometry, with the block's instances.
  static vtkSmartPointer<vtkPolyData> MakeBare(vtkPolyData* block)
  {
    auto bare = vtkSmartPointer<vtkPolyData>::New();
    bare->CopyStructure(block);
    if (vtkDataArray* places = block->GetFieldData()->GetArray(vtkCSLFInstances::InstanceMatrix()))
    {
      bare->GetFieldData()->AddArray(places);
    }
    return bare;
  }

  vtkActor* Actor;
  vtkMapper* Mapper;
  vtkProperty* Property;
  vtkMatrix4x4* Matrix;
  ImportedScene& Scene;
  vtkCompositeDataDisplayAttributes* Attributes;
  bool Found = false;
  BlockAppearance Appearance;
};

/// The time of a data object and all its leaves.
vtkMTimeType GetDataTime(vtkDataObject* data)
{
  vtkMTimeType time = data ? data->GetMTime() : 0;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      time = std::max(time, leaf->GetCurrentDataObject()->GetMTime());
    }
  }
  return time;
}

vtkMTimeType GetTextureTime(vtkTexture* texture)
{
  vtkMTimeType time = texture->GetMTime();
  if (texture->GetTransform())
  {
    time = std::max(time, texture->GetTransform()->GetMTime());
  }
  if (texture->GetLookupTable())
  {
    time = std::max(time, texture->GetLookupTable()->GetMTime());
  }
  if (texture->GetInputAlgorithm())
  {
    texture->GetInputAlgorithm()->Update();
    time = std::max(time, GetDataTime(texture->GetInput()));
  }
  return time;
}
}

bool IsImportable(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  // A light field in the scene that is being sampled would show itself.
  return mapper && !mapper->IsA("vtkCSLFMapper") && !actor->IsA("vtkSkybox") &&
    mapper->GetNumberOfInputConnections(0) > 0;
}

vtkMTimeType GetImportTime(vtkActor* actor)
{
  vtkMapper* mapper = actor->GetMapper();
  vtkMTimeType time = std::max({ actor->GetMTime(), mapper->GetMTime(),
    actor->GetProperty()->GetMTime(), actor->GetShaderProperty()->GetMTime() });
  UpdateInputs(mapper);
  for (int port = 0; port < mapper->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < mapper->GetNumberOfInputConnections(port); ++i)
    {
      time = std::max(time, GetDataTime(mapper->GetInputDataObject(port, i)));
    }
  }
  if (mapper->GetClippingPlanes())
  {
    vtkCollectionSimpleIterator cookie;
    mapper->GetClippingPlanes()->InitTraversal(cookie);
    while (vtkPlane* plane = mapper->GetClippingPlanes()->GetNextPlane(cookie))
    {
      time = std::max(time, plane->GetMTime());
    }
  }
  if (vtkCompositeDataDisplayAttributes* attributes = GetDisplayAttributes(mapper))
  {
    time = std::max(time, attributes->GetMTime());
  }
  if (actor->GetTexture())
  {
    time = std::max(time, GetTextureTime(actor->GetTexture()));
  }
  for (const auto& texture : actor->GetProperty()->GetAllTextures())
  {
    time = std::max(time, GetTextureTime(texture.second));
  }
  return time;
}

bool ImportActor(vtkActor* actor, vtkMatrix4x4* matrix, ImportedScene& scene)
{
  UpdateInputs(actor->GetMapper());
  FindActorLimits(actor, matrix, scene);
  bool found = false;
  if (const std::optional<ActorParts> parts = TakeApart(actor, matrix, scene))
  {
    for (const ActorPart& part : *parts)
    {
      found = ImportActor(part.Actor, part.Matrix, scene) || found;
    }
  }
  else
  {
    found = Importer(actor, matrix, scene).Import();
  }
  // For any kind of mapper: if it shows something, something must be imported.
  const double* bounds = found ? nullptr : actor->GetMapper()->GetBounds();
  if (bounds && vtkMath::AreBoundsInitialized(bounds))
  {
    scene.Meet(ImportLimit::NoGeometry, actor->GetMapper()->GetClassName());
  }
  return found;
}

vtkSmartPointer<vtkPolyData> ExtractSurface(vtkDataSet* data, vtkMatrix4x4* matrix)
{
  vtkSmartPointer<vtkPolyData> surface = vtkPolyData::SafeDownCast(data);
  if (!surface)
  {
    vtkNew<vtkDataSetSurfaceFilter> filter;
    filter->SetInputData(data);
    filter->Update();
    surface = filter->GetOutput();
  }
  if (!matrix || matrix->IsIdentity())
  {
    return surface;
  }
  vtkNew<vtkMatrixToLinearTransform> transform;
  transform->SetInput(matrix);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(surface);
  filter->SetTransform(transform);
  // Far from the origin, floats would lose precision.
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->Update();
  if (matrix->Determinant() > 0.0)
  {
    return filter->GetOutput();
  }
  // A reflection exchanges fronts and backs.
  vtkNew<vtkReverseSense> reverse;
  reverse->SetInputConnection(filter->GetOutputPort());
  reverse->ReverseCellsOn();
  reverse->Update();
  return reverse->GetOutput();
}
}
