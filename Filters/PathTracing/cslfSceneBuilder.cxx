// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSceneBuilder.h"

#include "cslfColor.h"
#include "cslfEnvironmentReader.h"
#include "cslfFingerprint.h"
#include "cslfLightReader.h"
#include "cslfSurfaceColors.h"
#include "cslfTextureReader.h"
#include "cslfTriangles.h"
#include "vtkCSLFMaterial.h"

#include <vtkCellArray.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace cslf
{
namespace
{
constexpr std::uint32_t Unused = 0xffffffffu;

/// What one polygonal data object contributes.
struct Block
{
  TriangleSelection Triangles;
  vtkSmartPointer<vtkDataArray> Scalars;
  bool ScalarsOfCells = false;
  SurfaceMaterial Material;
  MaterialTextures Textures;
};

/// What the user is told of, once.
struct Omissions
{
  vtkIdType Triangles = 0;
  vtkIdType Lines = 0;
  vtkIdType Vertices = 0;
  vtkIdType Lights = 0;
  vtkIdType Environments = 0;
  vtkIdType Textures = 0;
  std::set<std::string> DataTypes;

  std::string ToText() const
  {
    std::string text;
    const auto add = [&text](bool present, const std::string& what)
    {
      if (present)
      {
        text += (text.empty() ? "Left out of the scene: " : ", ") + what;
      }
    };
    const auto count = [&add](vtkIdType number, const char* what)
    { add(number > 0, std::to_string(number) + " " + what); };
    count(this->Triangles, "polygon(s) with coordinates that are not finite");
    count(this->Lines, "line(s)");
    count(this->Vertices, "vertex cell(s)");
    count(this->Lights, "light(s) with arrays that do not match or are not finite");
    count(this->Environments, "environment(s) with arrays that do not match or are not finite");
    count(this->Textures, "block(s)' textures for want of texture coordinates");
    for (const std::string& type : this->DataTypes)
    {
      add(true, "data of type " + type);
    }
    return text.empty() ? text : text + ".";
  }
};

bool HasAny(const MaterialTextures& textures)
{
  return textures.BaseColor || textures.MetallicRoughness || textures.Normal || textures.Emission;
}

/// The normal of a point, of unit length, or of length 0 where it has none.
glm::vec3 GetNormal(vtkDataArray* normals, vtkIdType point)
{
  double normal[3];
  normals->GetTuple(point, normal);
  const glm::dvec3 vector(normal[0], normal[1], normal[2]);
  const double length = glm::length(vector);
  return std::isfinite(length) && length > 0.0 ? glm::vec3(vector / length) : glm::vec3(0.0f);
}

/// Copies the triangles that have an area, and the points that they use, into scene space.
class MeshMaker
{
public:
  MeshMaker(const Block& block, const SceneFrame& frame)
    : Source(block)
    , Frame(frame)
    , Index(block.Triangles.Surface->GetNumberOfPoints(), Unused)
  {
  }

  Mesh Make(SurfaceColors& colors)
  {
    vtkCellArray* polygons = this->Source.Triangles.Surface->GetPolys();
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell : this->Source.Triangles.Cells)
    {
      polygons->GetCellAtId(cell, corners);
      this->AddTriangle(cell, corners->GetPointer(0));
    }
    this->AddNormals();
    this->AddTexCoords();
    this->AddColors(colors);
    this->Result.Material = this->Source.Material;
    this->Result.Textures = this->Source.Textures;
    return std::move(this->Result);
  }

private:
  glm::vec3 ToScene(vtkIdType point) const
  {
    return this->Frame.PointToScene(GetPoint(this->Source.Triangles.Surface, point));
  }

  void AddTriangle(vtkIdType cell, const vtkIdType* corners)
  {
    const glm::vec3 first = this->ToScene(corners[0]);
    const glm::vec3 normal =
      glm::cross(this->ToScene(corners[1]) - first, this->ToScene(corners[2]) - first);
    if (!std::isnormal(glm::dot(normal, normal)))
    {
      return;
    }
    glm::uvec3 triangle;
    for (int i = 0; i < 3; ++i)
    {
      std::uint32_t& index = this->Index[corners[i]];
      if (index == Unused)
      {
        index = static_cast<std::uint32_t>(this->Points.size());
        this->Points.push_back(corners[i]);
        this->Result.Vertices.push_back(this->ToScene(corners[i]));
      }
      triangle[i] = index;
    }
    this->Result.Triangles.push_back(triangle);
    this->Cells.push_back(cell);
  }

  void AddNormals()
  {
    vtkDataArray* normals = this->Source.Triangles.Surface->GetPointData()->GetNormals();
    if (normals && normals->GetNumberOfComponents() == 3)
    {
      this->Result.Normals.reserve(this->Points.size());
      for (vtkIdType point : this->Points)
      {
        this->Result.Normals.push_back(GetNormal(normals, point));
      }
    }
  }

  void AddTexCoords()
  {
    if (!HasAny(this->Source.Textures))
    {
      return;
    }
    vtkDataArray* coordinates = this->Source.Triangles.Surface->GetPointData()->GetTCoords();
    this->Result.TexCoords.reserve(this->Points.size());
    for (vtkIdType point : this->Points)
    {
      const glm::vec2 place(
        coordinates->GetComponent(point, 0), coordinates->GetComponent(point, 1));
      this->Result.TexCoords.push_back(std::isfinite(place.x + place.y) ? place : glm::vec2(0.0f));
    }
  }

  void AddColors(SurfaceColors& colors)
  {
    if (!this->Source.Scalars)
    {
      return;
    }
    const MappedColors mapped = colors.Map(this->Source.Scalars);
    const bool ofCells = this->Source.ScalarsOfCells;
    this->Result.Coloring = ofCells ? Mesh::ColorsOf::Triangles : Mesh::ColorsOf::Vertices;
    const std::vector<vtkIdType>& used = ofCells ? this->Cells : this->Points;
    this->Result.Colors.reserve(used.size());
    for (vtkIdType index : used)
    {
      this->Result.Colors.push_back(mapped.Colors[index]);
      if (!mapped.Opacities.empty())
      {
        this->Result.Opacities.push_back(mapped.Opacities[index]);
      }
    }
  }

  const Block& Source;
  const SceneFrame& Frame;
  Mesh Result;
  std::vector<std::uint32_t> Index; // of each point, its vertex
  std::vector<vtkIdType> Points;    // of each vertex, its point
  std::vector<vtkIdType> Cells;     // of each triangle, its cell
};

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
    for (vtkDataObject* input : inputs)
    {
      this->AddInput(input);
    }
    this->Omitted.Lights = this->Lights.GetNumberOfRejected();
    BuiltScene built;
    if (!(this->Lower.x <= this->Upper.x))
    {
      return this->Finish(std::move(built), {}, {});
    }
    built.Frame = { 0.5 * (this->Lower + this->Upper),
      0.5 * glm::length(this->Upper - this->Lower) };
    for (int axis = 0; axis < 3; ++axis)
    {
      built.Bounds[2 * axis] = this->Lower[axis];
      built.Bounds[2 * axis + 1] = this->Upper[axis];
    }
    LightSet lights;
    lights.Surroundings = this->Surroundings.value_or(this->Options.Surroundings);
    built.HasEnvironment = this->Surroundings.has_value();
    this->Lights.MoveTo(lights, built.Frame);
    std::vector<Mesh> meshes = this->MakeMeshes(built.Frame);
    return this->Finish(std::move(built), std::move(meshes), std::move(lights));
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

  void AddInput(vtkDataObject* input)
  {
    this->AddLights(input);
    this->Identity.Add(input);
    auto* composite = vtkCompositeDataSet::SafeDownCast(input);
    if (!composite)
    {
      this->AddLeaf(input, input);
      return;
    }
    auto leaf = vtk::TakeSmartPointer(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      this->AddLights(leaf->GetCurrentDataObject());
      this->Identity.Add(leaf->GetCurrentDataObject());
      this->AddLeaf(leaf->GetCurrentDataObject(), input);
    }
  }

  void AddLeaf(vtkDataObject* leaf, vtkDataObject* root)
  {
    auto* data = vtkPolyData::SafeDownCast(leaf);
    if (!data)
    {
      if (leaf)
      {
        this->Omitted.DataTypes.insert(leaf->GetClassName());
      }
      return;
    }
    this->Omitted.Lines += data->GetNumberOfLines();
    this->Omitted.Vertices += data->GetNumberOfVerts();
    Block block;
    block.Triangles = SelectTriangles(data);
    this->Omitted.Triangles += block.Triangles.Removed;
    if (block.Triangles.Cells.empty())
    {
      return;
    }
    block.Scalars = this->Options.FindScalars(block.Triangles.Surface, block.ScalarsOfCells);
    if (block.Scalars)
    {
      this->Colors.AddToRange(block.Scalars);
    }
    this->ReadMaterial(data, root, block);
    this->AddToBounds(block);
    this->Blocks.push_back(std::move(block));
  }

  void AddToBounds(const Block& block)
  {
    vtkPolyData* surface = block.Triangles.Surface;
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell : block.Triangles.Cells)
    {
      surface->GetPolys()->GetCellAtId(cell, corners);
      for (vtkIdType i = 0; i < 3; ++i)
      {
        const glm::dvec3 point = GetPoint(surface, corners->GetId(i));
        this->Lower = glm::min(this->Lower, point);
        this->Upper = glm::max(this->Upper, point);
      }
    }
  }

  void ReadMaterial(vtkPolyData* data, vtkDataObject* root, Block& block)
  {
    vtkNew<vtkPolyData> holder;
    vtkCSLFMaterial::Inherit(holder, data);
    vtkCSLFMaterial::Inherit(holder, root);
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
    block.Material.NormalScale = number(vtkCSLFMaterial::GetNormalScale(holder));
    this->ReadTextures(holder, block);
  }

  void ReadTextures(vtkDataObject* material, Block& block)
  {
    block.Textures = this->Textures.Read(material);
    if (!HasAny(block.Textures))
    {
      return;
    }
    vtkDataArray* coordinates = block.Triangles.Surface->GetPointData()->GetTCoords();
    if (!coordinates || coordinates->GetNumberOfComponents() < 2)
    {
      block.Textures = MaterialTextures();
      ++this->Omitted.Textures;
    }
    if (block.Textures.MetallicRoughness)
    {
      block.Material.VaryRoughness();
    }
  }

  std::vector<Mesh> MakeMeshes(const SceneFrame& frame)
  {
    std::vector<Mesh> meshes;
    for (const Block& block : this->Blocks)
    {
      Mesh mesh = MeshMaker(block, frame).Make(this->Colors);
      if (!mesh.Triangles.empty())
      {
        meshes.push_back(std::move(mesh));
      }
    }
    return meshes;
  }

  BuiltScene Finish(BuiltScene built, std::vector<Mesh> meshes, LightSet lights)
  {
    built.Warning = this->Omitted.ToText();
    if (meshes.empty())
    {
      built.Error = "The scene has no triangles with an area." +
        (built.Warning.empty() ? std::string() : " " + built.Warning);
      return built;
    }
    built.Fingerprint = this->Identify(meshes, lights, built.Frame);
    built.World = std::make_unique<Scene>(std::move(meshes), std::move(lights));
    built.Error = built.World->GetError();
    if (!built.Error.empty())
    {
      built.World.reset();
    }
    return built;
  }

  /// Materials and lights are in the inputs' field data, which is taken already.
  std::string Identify(
    const std::vector<Mesh>& meshes, const LightSet& lights, const SceneFrame& frame)
  {
    this->Identity.Add(
      std::vector<double>{ frame.Center.x, frame.Center.y, frame.Center.z, frame.Radius });
    for (const Mesh& mesh : meshes)
    {
      this->Identity.Add(mesh);
    }
    this->Identity.Add(lights.Surroundings.GetImage().Pixels);
    return this->Identity.Finish();
  }

  const SceneOptions& Options;
  SurfaceColors Colors;
  LightReader Lights;
  std::optional<Environment> Surroundings; // of the first data object that has one
  TextureReader Textures;
  std::vector<Block> Blocks;
  Omissions Omitted;
  Fingerprint Identity;
  glm::dvec3 Lower{ VTK_DOUBLE_MAX };
  glm::dvec3 Upper{ VTK_DOUBLE_MIN };
};
}

BuiltScene BuildScene(const std::vector<vtkDataObject*>& inputs, const SceneOptions& options)
{
  return Builder(options).Build(inputs);
}
}
