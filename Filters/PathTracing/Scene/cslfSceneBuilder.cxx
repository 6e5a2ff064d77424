// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneBuilder.h"

#include "PathTracing/Materials/cslfDisplayedColor.h"
#include "PathTracing/Shapes/cslfTriangles.h"
#include "PathTracing/Volumes/cslfVolumeReader.h"
#include "PathTracing/Volumes/cslfVolumeSet.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "Pipeline/cslfParallelFor.h"
#include "Pipeline/cslfValidPolyData.h"
#include "SceneData/cslfMaterialProblems.h"
#include "SceneData/cslfTextureImage.h"
#include "cslfColor.h"
#include "cslfFingerprint.h"
#include "cslfLightReader.h"
#include "cslfMeshJoin.h"
#include "cslfMeshMaker.h"
#include "cslfPointSpacing.h"
#include "cslfSceneBlock.h"
#include "cslfSurfaceColors.h"
#include "vtkCSLFMaterial.h"

#include <vtkCellData.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iomanip>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

namespace cslf
{
namespace
{
// Arrays of these names are this library's own.
constexpr const char* OwnArrays = "CSLF:";

// The default radius of lines, in diagonals of the scene's bounding box.
constexpr double StandardRadius = 0.0005;

// The default radius of points is half of their spacing, so that neighbours of a regular cloud
// touch. Its limits, in the same unit: few points do not hide the scene, and points are not much
// smaller than a texel where most of a cloud's points are in small parts of it.
constexpr double MaximumPointRadius = 0.02;
constexpr double MinimumPointRadius = 0.0001;

// The smallest and largest diagonal of the scene's bounding box. VTK's cameras are at least 1e-20
// away from what they look at, and floats hold intensities of lights, which are squares of lengths,
// up to 1e38. A few powers of ten are left for cameras near the scene and for lights far from it.
constexpr double MinimumSize = 1e-15;
constexpr double MaximumSize = 1e15;

///@{
/// The progress of reading when shapes are selected, and when meshes are made.
constexpr double ShapesShare = 0.4;
constexpr double MeshesShare = 0.8;
///@}

/// Warnings for the user, each given once.
struct Omissions
{
  vtkIdType Triangles = 0;
  vtkIdType WithoutArea = 0;
  vtkIdType Tangled = 0;
  vtkIdType Round = 0;
  vtkIdType WithoutRadius = 0;
  vtkIdType RoundGlass = 0;
  vtkIdType InstanceArrays = 0;
  vtkIdType Instances = 0;
  vtkIdType Lights = 0;
  vtkIdType Environments = 0;
  vtkIdType Textures = 0;
  vtkIdType LitColors = 0;       ///< blocks whose colours were chosen for lights
  std::set<std::string> Unsound; ///< cells that would be read out of bounds
  std::set<std::string> DataTypes;
  std::set<std::string> Volumes;
  MaterialProblems Materials;

  std::string ToText() const
  {
    const std::string lit = this->LitColors > 0
      ? "Colors are not exact where the scene was imported from a window with its lights: import "
        "it "
        "with exact colors."
      : "";
    std::string text = this->ListOmitted();
    for (const std::string& more : { lit, this->Materials.ToText() })
    {
      text += (text.empty() || more.empty() ? "" : " ") + more;
    }
    return text;
  }

private:
  std::string ListOmitted() const
  {
    std::string text;
    const auto add = [&text](bool present, const std::string& what)
    {
      if (present)
      {
        text += (text.empty() ? "Parts of the scene were left out: " : ", ") + what;
      }
    };
    const auto count = [&add](vtkIdType number, const char* what)
    { add(number > 0, std::to_string(number) + " " + what); };
    count(this->Triangles, NotFinitePolygons);
    count(this->WithoutArea, PolygonsWithoutArea);
    count(this->Tangled, TangledPolygons);
    count(this->Round, NotFiniteRound);
    count(this->WithoutRadius, "sphere(s) or part(s) of lines with a radius of 0");
    count(this->RoundGlass, "block(s)' transmission of lines or vertices");
    count(this->InstanceArrays, "block(s)' instances with arrays that do not match");
    count(this->Instances, "instance(s) with matrices that are not finite or not affine");
    count(this->Lights, "light(s) with arrays that do not match or invalid values");
    count(this->Environments, "environment(s) with arrays that do not match or are not finite");
    count(this->Textures, "block(s)' textures because of missing texture coordinates");
    for (const std::string& what : this->Unsound)
    {
      add(true, what);
    }
    for (const std::string& problem : this->Volumes)
    {
      add(true, "volume(s) " + problem);
    }
    for (const std::string& type : this->DataTypes)
    {
      add(true, "data of type " + type);
    }
    return text.empty() ? text : text + ".";
  }
};

VisibleSides ReadSides(vtkDataObject* material)
{
  switch (vtkCSLFMaterial::GetVisibleSides(material))
  {
    case vtkCSLFMaterial::FrontSide:
      return VisibleSides::Front;
    case vtkCSLFMaterial::BackSide:
      return VisibleSides::Back;
    default:
      return VisibleSides::Both;
  }
}

/// Whether no part of a mesh is visible, whatever its texture.
bool IsInvisible(const Mesh& mesh)
{
  float most = mesh.Material.Opacity;
  if (!mesh.Opacities.empty() && mesh.Coloring != Mesh::ColorsOf::None)
  {
    most *= *std::max_element(mesh.Opacities.begin(), mesh.Opacities.end());
  }
  if (!mesh.Instances.empty())
  {
    const auto isLess = [](const MeshInstance& a, const MeshInstance& b)
    { return a.Opacity < b.Opacity; };
    most *= std::max_element(mesh.Instances.begin(), mesh.Instances.end(), isLess)->Opacity;
  }
  return !(most > 0.0f) || most < mesh.Material.OpacityCutoff;
}

/// The colours of points, or else of cells, of data that has its final colours. Null if it has
/// none.
vtkDataArray* FindFinishedColors(vtkPolyData* data, bool& ofCells)
{
  const char* name = vtkCSLFMaterial::ColorsName();
  vtkDataArray* ofPoints = data->GetPointData()->GetArray(name);
  ofCells = !HoldsColors(ofPoints);
  vtkDataArray* colors = ofCells ? data->GetCellData()->GetArray(name) : ofPoints;
  return HoldsColors(colors) ? colors : nullptr;
}

std::string DescribeSize(double size)
{
  std::ostringstream text;
  text << std::setprecision(3) << "The diagonal of the scene's bounding box is " << size
       << " long. It must be " << MinimumSize << " to " << MaximumSize << ": scale the scene.";
  return text.str();
}

class Builder
{
public:
  explicit Builder(const SceneOptions& options)
    : Options(options)
    , Colors(options.LookupTable)
  {
  }

  BuiltScene Build(const std::vector<vtkDataObject*>& inputs)
  {
    this->Read(inputs);
    BuiltScene built;
    if (!this->GetBounds(built.Bounds))
    {
      return this->Finish(std::move(built), {}, {});
    }
    const double size = glm::length(this->Upper - this->Lower);
    if (size > 0.0 && !(size >= MinimumSize && size <= MaximumSize))
    {
      built.Error = DescribeSize(size);
      return built;
    }
    built.Frame = { 0.5 * (this->Lower + this->Upper), 0.5 * size };
    LightSet lights;
    lights.Surroundings = this->Surroundings.value_or(this->Options.Surroundings);
    built.HasEnvironment = this->Surroundings.has_value();
    this->Lights.MoveTo(lights, built.Frame);
    std::vector<Mesh> meshes = this->MakeMeshes(built.Frame);
    for (VolumeData& data : this->Volumes)
    {
      this->MadeVolumes.emplace_back(std::move(data), built.Frame);
    }
    return this->Finish(std::move(built), std::move(meshes), std::move(lights));
  }

  /// Reads what tells the bounds.
  void Read(const std::vector<vtkDataObject*>& inputs)
  {
    const std::vector<int>& ranks = this->Options.Ranks;
    for (std::size_t i = 0; i < inputs.size(); ++i)
    {
      if (i > 0 && i < ranks.size() && ranks[i] != ranks[i - 1])
      {
        this->Lights.BeginRank();
      }
      this->AddInput(inputs[i]);
      this->Report(ShapesShare * static_cast<double>(i + 1) / static_cast<double>(inputs.size()));
    }
    if (this->Options.InPieces)
    {
      this->Lights.Join();
    }
    this->Omitted.Lights = this->Lights.GetNumberOfRejected();
    this->SetRadii();
  }

  /// False if there are none.
  bool GetBounds(double bounds[6]) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = this->Lower[axis];
      bounds[2 * axis + 1] = this->Upper[axis];
    }
    return this->Lower.x <= this->Upper.x;
  }

private:
  void AddLights(vtkDataObject* data)
  {
    this->Lights.Add(data);
    Environment environment;
    if (!this->Surroundings && HasEnvironment(data))
    {
      if (ReadEnvironment(data, environment))
      {
        this->Surroundings = std::move(environment);
      }
      else
      {
        ++this->Omitted.Environments;
      }
    }
  }

  void AddInput(vtkDataObject* data)
  {
    this->AddLights(data);
    auto* composite = vtkCompositeDataSet::SafeDownCast(data);
    if (!composite)
    {
      this->AddLeaf(data, data);
      return;
    }
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      this->AddLights(leaf->GetCurrentDataObject());
      this->AddLeaf(leaf->GetCurrentDataObject(), data);
    }
  }

  void AddLeaf(vtkDataObject* leaf, vtkDataObject* root)
  {
    if (auto* data = vtkPolyData::SafeDownCast(leaf))
    {
      const ValidPolyData sound = MakeSound(data);
      sound.AddRemoved(this->Omitted.Unsound);
      this->AddPolyData(sound.Data, root);
    }
    else if (IsVolume(leaf))
    {
      this->AddVolume(leaf);
    }
    else if (leaf)
    {
      this->Omitted.DataTypes.insert(leaf->GetClassName());
    }
  }

  void AddVolume(vtkDataObject* data)
  {
    std::string problem;
    std::optional<VolumeData> volume = ReadVolume(data, problem);
    if (!volume)
    {
      this->Omitted.Volumes.insert(problem);
      return;
    }
    volume->IsLit = volume->IsLit && !this->Options.ExactColors;
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::dvec4 point((corner & 1) != 0 ? volume->High.x : volume->Low.x,
        (corner & 2) != 0 ? volume->High.y : volume->Low.y,
        (corner & 4) != 0 ? volume->High.z : volume->Low.z, 1.0);
      const glm::dvec3 placed(volume->GetToWorld() * point);
      this->Lower = glm::min(this->Lower, placed);
      this->Upper = glm::max(this->Upper, placed);
    }
    this->Volumes.push_back(std::move(*volume));
  }

  void AddPolyData(vtkPolyData* data, vtkDataObject* root)
  {
    const InstanceSelection instances = SelectInstances(data);
    this->Omitted.InstanceArrays += instances.IsBroken ? 1 : 0;
    this->Omitted.Instances += instances.Removed;
    if (data->GetNumberOfCells() == 0 || instances.IsBroken ||
      (instances.IsPresent && instances.Places.empty()))
    {
      return;
    }
    SceneBlock block;
    block.Data = data;
    block.Instances = instances.Places;
    this->ReadMaterial(data, root, block);
    this->CheckTextures(block);
    this->AddTriangles(data, block);
    this->AddRound(data, block);
  }

  void AddTriangles(vtkPolyData* data, SceneBlock block)
  {
    TriangleSelection triangles = SelectTriangles(data);
    this->Omitted.Triangles += triangles.Removed;
    this->Omitted.WithoutArea += triangles.WithoutArea;
    this->Omitted.Tangled += triangles.Tangled;
    if (!triangles.Cells.empty())
    {
      block.Data = triangles.Surface;
      block.Triangles = std::move(triangles.Cells);
      this->AddBlock(std::move(block));
    }
  }

  /// Vertices and lines.
  void AddRound(vtkPolyData* data, const SceneBlock& block)
  {
    for (const Mesh::Shapes shape : { Mesh::Shapes::Spheres, Mesh::Shapes::Tubes })
    {
      RoundSelection round = SelectRound(data, shape);
      this->Omitted.Round += round.Removed;
      if (!round.Parts.empty())
      {
        SceneBlock roundBlock = block;
        roundBlock.Shape = shape;
        roundBlock.Round = std::move(round.Parts);
        this->AddRoundBlock(std::move(roundBlock));
      }
    }
  }

  void AddRoundBlock(SceneBlock block)
  {
    this->Omitted.RoundGlass += block.Material.Transmission > 0.0f ? 1 : 0;
    block.Material.Transmission = 0.0f;
    block.Material.Sides = VisibleSides::Both;
    block.Textures.Normal = nullptr;
    block.StandardRadius =
      block.Shape == Mesh::Shapes::Tubes ? block.LineRadius : block.PointRadius;
    this->AddBlock(std::move(block));
  }

  void AddBlock(SceneBlock block)
  {
    block.Scalars = block.HasFinishedColors
      ? FindFinishedColors(block.Data, block.ScalarsOfCells)
      : this->Options.FindScalars(block.Data, block.ScalarsOfCells);
    if (block.Scalars && !this->Colors.CanMap(block.Scalars))
    {
      this->Omitted.Unsound.insert("colors of a lookup table without values");
      block.Scalars = nullptr;
    }
    if (block.Scalars)
    {
      this->Colors.AddToRange(block.Scalars);
    }
    this->FindArrays(block);
    block.AddTo(this->Lower, this->Upper, 0.0);
    this->Blocks.push_back(std::move(block));
  }

  /// Finds what the geometry keeps of the arrays that are not there for drawing. Those of points
  /// come before those of cells with the same name.
  void FindArrays(SceneBlock& block) const
  {
    block.Arrays = this->FindArrays(block.Data->GetPointData());
    block.CellArrays = this->FindArrays(block.Data->GetCellData());
    const auto isTaken = [&block](vtkDataArray* array)
    {
      const std::string name = array->GetName();
      return std::any_of(block.Arrays.begin(), block.Arrays.end(),
        [&name](vtkDataArray* other) { return name == other->GetName(); });
    };
    std::vector<vtkDataArray*>& ofCells = block.CellArrays;
    ofCells.erase(std::remove_if(ofCells.begin(), ofCells.end(), isTaken), ofCells.end());
  }

  std::vector<vtkDataArray*> FindArrays(vtkDataSetAttributes* data) const
  {
    std::vector<vtkDataArray*> arrays;
    for (int i = 0; i < data->GetNumberOfArrays() && this->Options.KeepsArray; ++i)
    {
      vtkDataArray* array = data->GetArray(i);
      const std::string name = array && array->GetName() ? array->GetName() : "";
      const bool isForDrawing = array == data->GetNormals() || array == data->GetTCoords() ||
        array == data->GetTangents() || name.rfind(OwnArrays, 0) == 0 ||
        name == vtkDataSetAttributes::GhostArrayName();
      if (!name.empty() && !isForDrawing &&
        array->GetNumberOfComponents() <= MaximumArrayComponents && this->Options.KeepsArray(name))
      {
        arrays.push_back(array);
      }
    }
    return arrays;
  }

  /// Gives a radius to points without one of their own. Blocks are clouds by themselves. A cloud
  /// may also be in pieces, or have a block for each point.
  void SetPointRadii(double diagonal)
  {
    std::map<std::string, std::vector<SceneBlock*>> clouds;
    for (std::size_t i = 0; i < this->Blocks.size(); ++i)
    {
      SceneBlock& block = this->Blocks[i];
      if (block.Shape == Mesh::Shapes::Spheres && block.StandardRadius == 0.0 && !block.HasRadii())
      {
        const bool isJoined =
          block.Instances.empty() && (this->Options.InPieces || block.Round.size() == 1);
        clouds[isJoined ? "joined " + block.Appearance : std::to_string(i)].push_back(&block);
      }
    }
    for (const auto& cloud : clouds)
    {
      double radius = 0.5 * FindPointSpacing({ cloud.second.begin(), cloud.second.end() });
      if (cloud.second.front()->Instances.empty())
      {
        radius = std::clamp(radius > 0.0 ? radius : VTK_DOUBLE_MAX, MinimumPointRadius * diagonal,
          MaximumPointRadius * diagonal);
      }
      for (SceneBlock* block : cloud.second)
      {
        block->StandardRadius = radius;
      }
    }
  }

  /// Extends the bounds by the parts of spheres and tubes beyond their points.
  void SetRadii()
  {
    const double diagonal = glm::length(this->Upper - this->Lower);
    this->SetPointRadii(diagonal);
    const double standard = diagonal > 0.0 ? StandardRadius * diagonal : 1.0;
    for (SceneBlock& block : this->Blocks)
    {
      if (block.Shape != Mesh::Shapes::Triangles)
      {
        block.StandardRadius = block.StandardRadius > 0.0 ? block.StandardRadius : standard;
        this->Omitted.WithoutRadius += block.RemovePartsWithoutRadius();
        block.AddTo(this->Lower, this->Upper, block.GetLargestRadius());
      }
    }
  }

  void ReadMaterial(vtkPolyData* data, vtkDataObject* root, SceneBlock& block)
  {
    for (vtkDataObject* source : { static_cast<vtkDataObject*>(data), root })
    {
      this->Omitted.Materials.FindUnused(source);
      this->Omitted.Materials.FindOutOfRange(source);
    }
    vtkNew<vtkPolyData> holder;
    vtkCSLFMaterial::Inherit(holder, data);
    vtkCSLFMaterial::Inherit(holder, root);
    if (this->Options.ExactColors)
    {
      this->MakePlain(holder);
    }
    double color[3];
    double emission[3];
    vtkCSLFMaterial::GetBaseColor(holder, color);
    vtkCSLFMaterial::GetEmission(holder, emission);
    const auto number = [](double value) { return static_cast<float>(value); };
    block.Material = SurfaceMaterial(SRGBToLinear(glm::dvec3(color[0], color[1], color[2])),
      number(vtkCSLFMaterial::GetMetallic(holder)), number(vtkCSLFMaterial::GetRoughness(holder)),
      number(vtkCSLFMaterial::GetIndexOfRefraction(holder)),
      glm::vec3(emission[0], emission[1], emission[2]));
    block.Material.Transmission = number(vtkCSLFMaterial::GetTransmission(holder));
    block.Material.Thin = vtkCSLFMaterial::GetThinWalled(holder);
    block.Material.Opacity = number(vtkCSLFMaterial::GetOpacity(holder));
    block.Material.OpacityCutoff = number(vtkCSLFMaterial::GetOpacityCutoff(holder));
    block.Material.Sides = ReadSides(holder);
    block.Material.Unlit = this->Options.ExactColors;
    block.Material.NormalScale = number(vtkCSLFMaterial::GetNormalScale(holder));
    block.DisplayedWhite = GetDisplayedWhite(holder);
    block.HasFinishedColors = vtkCSLFMaterial::GetFinishedColors(holder);
    block.LineRadius = vtkCSLFMaterial::GetLineRadius(holder);
    block.PointRadius = vtkCSLFMaterial::GetPointRadius(holder);
    block.Textures = this->Textures.Read(holder);
    Fingerprint appearance;
    appearance.Add(holder->GetFieldData(), this->Hashes);
    auto* map = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(ColorMapsName));
    if (map && map->GetNumberOfValues() == 1)
    {
      block.Map = map->GetValue(0);
      appearance.Add(std::vector<char>(block.Map.begin(), block.Map.end()));
    }
    block.ColorMaps = FindColorMaps(data);
    for (const ColorMap& colors : block.ColorMaps)
    {
      appearance.Add(colors.Colors);
    }
    block.Appearance = appearance.Finish();
  }

  /// Leaves only what determines a material's own colour, which is interpolated as displayed.
  void MakePlain(vtkPolyData* material)
  {
    const glm::vec3 white = GetDisplayedWhite(material);
    this->Omitted.LitColors += white != glm::vec3(0.0f) && white != glm::vec3(1.0f) ? 1 : 0;
    vtkCSLFMaterial::SetMetallic(material, 0.0);
    vtkCSLFMaterial::SetRoughness(material, 1.0);
    vtkCSLFMaterial::SetIndexOfRefraction(material, 1.0);
    vtkCSLFMaterial::SetTransmission(material, 0.0);
    for (const int slot :
      { vtkCSLFMaterial::MetallicRoughnessTexture, vtkCSLFMaterial::NormalTexture })
    {
      vtkCSLFMaterial::SetTexture(material, slot, nullptr);
    }
    vtkCSLFMaterial::SetDisplayedWhite(material, 1.0, 1.0, 1.0);
  }

  void CheckTextures(SceneBlock& block)
  {
    if (!block.HasTextures())
    {
      return;
    }
    vtkDataArray* coordinates = block.Data->GetPointData()->GetTCoords();
    if (!coordinates || coordinates->GetNumberOfComponents() < 2)
    {
      block.Textures = MaterialTextures();
      ++this->Omitted.Textures;
    }
    if (block.Textures.MetallicRoughness)
    {
      const float ior = block.Material.IndexOfRefraction;
      const auto known = this->Albedos.try_emplace(ior, ior).first;
      block.Material.DielectricSpecular = known->second;
    }
  }

  std::vector<Mesh> MakeMeshes(const SceneFrame& frame)
  {
    std::vector<Mesh> meshes(this->Blocks.size());
    const auto report = [this](double share)
    {
      this->Report(ShapesShare + (MeshesShare - ShapesShare) * share);
      return true;
    };
    ParallelFor(0, static_cast<vtkIdType>(meshes.size()), report,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          meshes[i] = MakeMesh(this->Blocks[i], frame, this->Colors);
        }
      });
    const auto isEmpty = [](const Mesh& mesh) { return mesh.GetNumberOfShapes() == 0; };
    meshes.erase(std::remove_if(meshes.begin(), meshes.end(), isEmpty), meshes.end());
    if (this->Options.InPieces)
    {
      meshes = JoinMeshes(std::move(meshes));
    }
    return meshes;
  }

  BuiltScene Finish(BuiltScene built, std::vector<Mesh> meshes, LightSet lights)
  {
    built.Warning = this->Omitted.ToText();
    if (meshes.empty() && this->MadeVolumes.empty())
    {
      built.IsEmpty = true;
      built.Error = "The scene has no triangles with an area, lines, vertices or volumes." +
        (built.Warning.empty() ? std::string() : " " + built.Warning);
      return built;
    }
    const auto isEmpty = [](const Volume& volume) { return volume.IsEmpty(); };
    if (std::all_of(meshes.begin(), meshes.end(), IsInvisible) &&
      std::all_of(this->MadeVolumes.begin(), this->MadeVolumes.end(), isEmpty))
    {
      built.Warning += (built.Warning.empty() ? "" : " ") +
        std::string("Nothing of the scene is visible: all of its surfaces and volumes are "
                    "transparent (opacity 0).");
    }
    else
    {
      meshes.erase(std::remove_if(meshes.begin(), meshes.end(), IsInvisible), meshes.end());
    }
    built.Fingerprint = this->Identify(meshes, lights, built.Frame);
    Fingerprint arrays;
    for (const Mesh& mesh : meshes)
    {
      arrays.Add(mesh.Arrays);
      arrays.Add(mesh.ShapeArrays);
    }
    built.ArraysFingerprint = arrays.Finish();
    built.World = std::make_unique<Scene>(std::move(meshes), std::move(lights),
      this->Options.Building, std::make_shared<VolumeSet>(std::move(this->MadeVolumes)));
    built.Error = built.World->GetError();
    if (!built.Error.empty())
    {
      built.World.reset();
    }
    return built;
  }

  std::string Identify(
    const std::vector<Mesh>& meshes, const LightSet& lights, const SceneFrame& frame)
  {
    Fingerprint identity;
    if (this->Options.ExactColors)
    {
      identity.Add(std::vector<char>{ 'e' });
    }
    identity.Add(
      std::vector<double>{ frame.Center.x, frame.Center.y, frame.Center.z, frame.Radius });
    for (const Mesh& mesh : meshes)
    {
      identity.Add(mesh);
      const auto number = static_cast<double>(&mesh - meshes.data() + 1);
      this->Report(MeshesShare + (1.0 - MeshesShare) * number / static_cast<double>(meshes.size()));
    }
    identity.Add(lights);
    for (const Volume& volume : this->MadeVolumes)
    {
      identity.Add(volume.GetData());
    }
    return identity.Finish();
  }

  /// Throws Aborted if the work shall end.
  void Report(double share) const
  {
    if (this->Options.Reading)
    {
      OrAbort(this->Options.Reading)(share);
    }
  }

  const SceneOptions& Options;
  SurfaceColors Colors;
  LightReader Lights;
  std::optional<Environment> Surroundings; // of the first data object that has one
  TextureReader Textures;
  ArrayHashes Hashes;                      // of the textures
  std::map<float, SpecularAlbedo> Albedos; // of any roughness, by the index of refraction
  std::vector<SceneBlock> Blocks;
  std::vector<VolumeData> Volumes;
  std::vector<Volume> MadeVolumes;
  Omissions Omitted;
  glm::dvec3 Lower{ VTK_DOUBLE_MAX };
  glm::dvec3 Upper{ VTK_DOUBLE_MIN };
};
}

BuiltScene BuildScene(const std::vector<vtkDataObject*>& inputs, const SceneOptions& options)
try
{
  return Builder(options).Build(inputs);
}
catch (const Aborted&)
{
  BuiltScene built;
  built.IsAborted = true;
  return built;
}

bool FindSceneBounds(const std::vector<vtkDataObject*>& inputs, double bounds[6])
{
  SceneOptions options;
  options.FindScalars = [](vtkPolyData*, bool&) { return nullptr; };
  Builder builder(options);
  builder.Read(inputs);
  return builder.GetBounds(bounds);
}
}
