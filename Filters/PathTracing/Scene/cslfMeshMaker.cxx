// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMeshMaker.h"

#include "PathTracing/Materials/cslfDisplayedColor.h"
#include "PathTracing/Shapes/cslfTriangles.h"
#include "PathTracing/Shapes/cslfTube.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfGeometryArrays.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "cslfColor.h"
#include "vtkCSLFMaterial.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <tuple>
#include <unordered_set>
#include <utility>
#include <vector>

namespace cslf
{
namespace
{
constexpr std::uint32_t Unused = 0xffffffffu;

// The smallest radius of a tube's end, relative to the other end. Tubes may end in a point, but
// divisions need a radius above 0.
constexpr double MinimumEnd = 1e-4;

/// How much colours differ, as the root mean square of components, that count as those of a map,
/// and the share of a mesh where they may differ by more.
constexpr double MaximumDifference = 3.0 / 255.0;
constexpr double MaximumOthers = 0.01;

/// The normal of a point, of unit length, or of length 0 if it has none.
glm::vec3 GetNormal(vtkDataArray* normals, vtkIdType point)
{
  double normal[3];
  normals->GetTuple(point, normal);
  const glm::dvec3 vector(normal[0], normal[1], normal[2]);
  const double length = glm::length(vector);
  return std::isfinite(length) && length > 0.0 ? glm::vec3(vector / length) : glm::vec3(0.0f);
}

/// The space of a block's mesh: the scene's or, if the block has instances, its own.
SceneFrame FindFrame(const SceneBlock& block, const SceneFrame& frame)
{
  if (block.Instances.empty())
  {
    return frame;
  }
  SceneBlock single = block;
  single.Instances.clear();
  glm::dvec3 lower(VTK_DOUBLE_MAX);
  glm::dvec3 upper(VTK_DOUBLE_MIN);
  single.AddTo(lower, upper, single.GetLargestRadius());
  return { 0.5 * (lower + upper), 0.5 * glm::length(upper - lower) };
}

using TrianglePlace = std::array<glm::vec3, 3>;

struct PlaceHash
{
  std::size_t operator()(const TrianglePlace& place) const
  {
    std::uint64_t hash = 0;
    for (const glm::vec3& corner : place)
    {
      std::uint32_t bits[3];
      static_assert(sizeof(bits) == sizeof(corner), "three floats");
      std::memcpy(bits, &corner, sizeof(bits));
      hash = MixBits(MixBits(hash, bits[0]), std::uint64_t(bits[1]) << 32 | bits[2]);
    }
    return hash;
  }
};

/// The corners of a triangle, the same ones for triangles with the same front at the same place.
TrianglePlace GetPlace(const Mesh& mesh, const glm::uvec3& triangle)
{
  TrianglePlace place;
  for (int i = 0; i < 3; ++i)
  {
    place[i] = mesh.Vertices[triangle[i]] + 0.0f; // one of the two zeros
  }
  const auto first = std::min_element(place.begin(), place.end(),
    [](const glm::vec3& a, const glm::vec3& b)
    { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
  std::rotate(place.begin(), first, place.end());
  return place;
}

template <typename Value>
void KeepSome(const std::vector<char>& isKept, std::vector<Value>& values)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    if (isKept[i] != 0)
    {
      values[count++] = values[i];
    }
  }
  values.resize(count);
}

/// Removes opaque triangles that a later one covers exactly, as in pictures of VTK. Tubes around
/// stream lines that stand still have thousands at one place, and all rays would meet all of them.
void DropCovered(Mesh& mesh)
{
  if (mesh.Triangles.empty() || mesh.CanBePassed())
  {
    return;
  }
  const std::size_t count = mesh.Triangles.size();
  std::unordered_set<TrianglePlace, PlaceHash> places(count);
  std::vector<char> isKept(count, 0);
  for (std::size_t i = count; i-- > 0;)
  {
    isKept[i] = places.insert(GetPlace(mesh, mesh.Triangles[i])).second ? 1 : 0;
  }
  if (places.size() == count)
  {
    return;
  }
  KeepSome(isKept, mesh.Triangles);
  if (mesh.Coloring == Mesh::ColorsOf::Triangles)
  {
    KeepSome(isKept, mesh.Colors);
    KeepSome(isKept, mesh.MapPlaces);
  }
  for (SurfaceArray& array : mesh.ShapeArrays)
  {
    for (SurfaceArray::Component& component : array.Components)
    {
      KeepSome(isKept, component.Values);
    }
  }
  if (mesh.EmissionsOf == Mesh::ColorsOf::Triangles)
  {
    KeepSome(isKept, mesh.Emissions);
  }
}

/// Whether linear colours are displayed alike.
bool IsAlike(const glm::vec3& one, const glm::vec3& other)
{
  const glm::dvec3 difference = LinearToSRGB(glm::dvec3(one)) - LinearToSRGB(glm::dvec3(other));
  return glm::dot(difference, difference) <= 3.0 * MaximumDifference * MaximumDifference;
}

/// The map that a texture shows. Null if it does not fit.
std::shared_ptr<const ColorMap> FindMap(const std::string& text, const Texture& texture)
try
{
  auto map = std::make_shared<ColorMap>(ReadColorMap(text));
  const int columns = texture.GetWidth();
  if (static_cast<std::size_t>(columns) != map->Colors.size())
  {
    return nullptr;
  }
  const auto get = [&](float column, float row)
  {
    const glm::vec4 color = texture.Get({ (column + 0.5f) / static_cast<float>(columns), row });
    const auto encode = [](float value) { return ToByte(LinearToSRGB(double(value))); };
    return ColorMap::Pixel{ encode(color.x), encode(color.y), encode(color.z), ToByte(color.w) };
  };
  for (int i = 0; i < columns; ++i)
  {
    map->Colors[i] = get(static_cast<float>(i), 0.25f);
  }
  map->NanColor = get(0.0f, 0.75f);
  return map;
}
catch (const std::exception&)
{
  return nullptr;
}

/// Makes the mesh of one block.
class MeshMaker
{
public:
  MeshMaker(const SceneBlock& block, const SceneFrame& frame)
    : Source(block)
    , World(frame)
    , Frame(FindFrame(block, frame))
    , Index(block.Data->GetNumberOfPoints(), Unused)
  {
  }

  Mesh Make(SurfaceColors& colors)
  {
    this->Result.Shape = this->Source.Shape;
    // Nothing is interpolated over a sphere.
    if (this->Source.Shape != Mesh::Shapes::Spheres)
    {
      this->Result.DisplayedWhite = this->Source.DisplayedWhite;
    }
    this->AddTriangles();
    this->AddRound();
    this->AddNormals();
    this->AddTexCoords();
    this->AddColors(colors);
    this->Result.Material = this->Source.Material;
    this->AddEmissions();
    this->AddInstances();
    this->AddMapPlaces();
    this->AddArrays();
    if (this->Result.Shape == Mesh::Shapes::Tubes)
    {
      DivideLongTubes(this->Result);
    }
    this->Result.Textures = this->Source.Textures;
    this->Result.Appearance = this->Source.Appearance;
    if (!this->Result.Map && !this->Source.Map.empty() && this->Result.Textures.BaseColor)
    {
      this->Result.Map = FindMap(this->Source.Map, *this->Result.Textures.BaseColor);
    }
    if (this->Table.Colors)
    {
      this->Result.Material.BaseColor = glm::vec3(1.0f);
      this->Result.Textures.BaseColor = this->Table.Colors;
      this->Result.Map = this->Table.Map;
      this->Result.Appearance += this->Table.Name;
    }
    this->ShowOneColor();
    DropCovered(this->Result);
    return std::move(this->Result);
  }

private:
  glm::vec3 ToMesh(vtkIdType point) const
  {
    return this->Frame.PointToScene(GetPoint(this->Source.Data, point));
  }

  void AddTriangles()
  {
    vtkNew<vtkIdList> corners;
    for (vtkIdType cell : this->Source.Triangles)
    {
      this->Source.Data->GetPolys()->GetCellAtId(cell, corners);
      this->AddTriangle(cell, corners->GetPointer(0));
    }
  }

  void AddTriangle(vtkIdType cell, const vtkIdType* corners)
  {
    const glm::vec3 first = this->ToMesh(corners[0]);
    const glm::vec3 normal =
      glm::cross(this->ToMesh(corners[1]) - first, this->ToMesh(corners[2]) - first);
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
        this->Result.Vertices.push_back(this->ToMesh(corners[i]));
      }
      triangle[i] = index;
    }
    this->Result.Triangles.push_back(triangle);
    this->Cells.push_back(cell);
  }

  /// Each sphere has its own vertex, each part of a line two.
  void AddRound()
  {
    const int count = this->Source.Shape == Mesh::Shapes::Tubes ? 2 : 1;
    for (const RoundPart& part : this->Source.Round)
    {
      const double radii[2] = { this->Source.GetRadius(part.Points[0]),
        this->Source.GetRadius(part.Points[1]) };
      for (int i = 0; i < count; ++i)
      {
        this->Points.push_back(part.Points[i]);
        this->Result.Vertices.push_back(this->ToMesh(part.Points[i]));
        const double radius = std::max(radii[i], MinimumEnd * radii[1 - i]);
        this->Result.Radii.push_back(static_cast<float>(radius / this->Frame.Radius));
      }
      this->Cells.push_back(part.Cell);
    }
  }

  void AddNormals()
  {
    vtkDataArray* normals = this->Source.Data->GetPointData()->GetNormals();
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
    if (!this->Source.HasTextures())
    {
      return;
    }
    vtkDataArray* coordinates = this->Source.Data->GetPointData()->GetTCoords();
    this->Result.TexCoords.reserve(this->Points.size());
    for (vtkIdType point : this->Points)
    {
      const glm::vec2 place(
        coordinates->GetComponent(point, 0), coordinates->GetComponent(point, 1));
      this->Result.TexCoords.push_back(std::isfinite(place.x + place.y) ? place : glm::vec2(0.0f));
    }
  }

  /// Whether the mesh stores displayed values for arrays of points or cells.
  bool HoldsDisplayed(bool ofCells) const
  {
    return !ofCells && this->Result.DisplayedWhite != glm::vec3(0.0f);
  }

  void AddColors(SurfaceColors& colors)
  {
    if (!this->Source.Scalars)
    {
      return;
    }
    const bool ofCells = this->Source.ScalarsOfCells;
    MappedTable table;
    if (!this->Source.HasTextures())
    {
      table = colors.FindPlaces(this->Source.Scalars);
    }
    if (table.Colors && !ofCells)
    {
      this->Table = std::move(table);
      this->AddPlaces();
      return;
    }
    const MappedColors mapped = colors.Map(this->Source.Scalars);
    this->Result.Coloring = ofCells ? Mesh::ColorsOf::Triangles : Mesh::ColorsOf::Vertices;
    const std::vector<vtkIdType>& used = ofCells ? this->Cells : this->Points;
    this->Result.Colors.reserve(used.size());
    for (vtkIdType index : used)
    {
      const glm::vec3& color = mapped.Colors[index];
      this->Result.Colors.push_back(
        this->HoldsDisplayed(ofCells) ? ToDisplayed(color * this->Result.DisplayedWhite) : color);
      if (!mapped.Opacities.empty())
      {
        this->Result.Opacities.push_back(mapped.Opacities[index]);
      }
    }
    if (table.Colors)
    {
      this->AddMapPlaces(table);
    }
  }

  /// The places of cells on the lookup table, which are those on its texture.
  void AddMapPlaces(const MappedTable& table)
  {
    const auto columns = static_cast<float>(table.Map->Colors.size());
    for (vtkIdType cell : this->Cells)
    {
      const glm::vec2& place = table.Places[cell];
      this->Result.MapPlaces.emplace_back(columns * place.x, place.y > 0.5f ? 1.0f : 0.0f);
    }
    this->Result.Map = table.Map;
    this->KeepMapIfShown();
  }

  void KeepMapIfShown()
  {
    if (!this->ShowsMap())
    {
      this->Result.Map = nullptr;
      this->Result.MapPlaces.clear();
    }
  }

  /// The points' places on the lookup table, which is a texture of the mesh.
  void AddPlaces()
  {
    this->Result.TexCoords.reserve(this->Points.size());
    for (vtkIdType point : this->Points)
    {
      this->Result.TexCoords.push_back(this->Table.Places[point]);
    }
  }

  /// Emissions of points come before those of cells, and both before the material's.
  void AddEmissions()
  {
    for (const Mesh::ColorsOf place : { Mesh::ColorsOf::Vertices, Mesh::ColorsOf::Triangles })
    {
      const bool ofCells = place == Mesh::ColorsOf::Triangles;
      vtkDataSetAttributes* attributes = this->Source.Data->GetPointData();
      if (ofCells)
      {
        attributes = this->Source.Data->GetCellData();
      }
      vtkDataArray* emissions = attributes->GetArray(vtkCSLFMaterial::EmissionName());
      if (this->Result.EmissionsOf == Mesh::ColorsOf::None && emissions &&
        emissions->GetNumberOfComponents() == 3)
      {
        this->Result.EmissionsOf = place;
        this->AddEmissions(emissions, ofCells);
      }
    }
  }

  void AddEmissions(vtkDataArray* emissions, bool ofCells)
  {
    const std::vector<vtkIdType>& used = ofCells ? this->Cells : this->Points;
    glm::vec3& most = this->Result.Material.Emission;
    most = glm::vec3(0.0f);
    this->Result.Emissions.reserve(used.size());
    for (vtkIdType index : used)
    {
      const glm::vec3 emission = GetRadiance(emissions, index);
      this->Result.Emissions.push_back(
        this->HoldsDisplayed(ofCells) ? ToDisplayed(emission) : emission);
      most = glm::max(most, emission);
    }
  }

  void AddInstances()
  {
    const glm::dmat3 scale(this->Frame.Radius / this->World.Radius);
    for (const BlockInstance& instance : this->Source.Instances)
    {
      MeshInstance placed;
      placed.Linear = glm::dmat3(instance.ToWorld) * scale;
      placed.Offset = this->World.PointToScene(
        glm::dvec3(instance.ToWorld * glm::dvec4(this->Frame.Center, 1.0)));
      placed.Color = instance.Color;
      placed.Opacity = instance.Opacity;
      placed.Emission = instance.Emission;
      this->Result.HasInstanceColors = instance.HasColor;
      this->Result.Instances.push_back(placed);
    }
    this->Result.HasInstanceEmissions =
      !this->Source.Instances.empty() && this->Source.Instances.front().HasEmission;
    if (this->Result.HasInstanceEmissions)
    {
      glm::vec3& most = this->Result.Material.Emission;
      most = glm::vec3(0.0f);
      for (const MeshInstance& instance : this->Result.Instances)
      {
        most = glm::max(most, instance.Emission);
      }
    }
  }

  /// The places of the colours of points, cells or instances on their map, if between points it has
  /// the colours that are interpolated there.
  void AddMapPlaces()
  {
    if (this->Result.HasInstanceColors)
    {
      this->Result.Map = nullptr;
      this->Result.MapPlaces.clear();
    }
    if (this->Source.ColorMaps.size() != 1 || this->Source.Textures.BaseColor ||
      !this->Result.MapPlaces.empty())
    {
      return;
    }
    const auto map = std::make_shared<const ColorMap>(this->Source.ColorMaps.front());
    const bool ofCells = this->Result.Coloring == Mesh::ColorsOf::Triangles;
    vtkDataSetAttributes* attributes = this->Source.Data->GetPointData();
    if (ofCells)
    {
      attributes = this->Source.Data->GetCellData();
    }
    vtkDataArray* scalars = attributes->GetArray(MapScalarName);
    const bool hasScalars = scalars && scalars->GetNumberOfComponents() == 1;
    if (this->Result.HasInstanceColors)
    {
      bool isKnown = true;
      for (std::size_t i = 0; i < this->Source.Instances.size(); ++i)
      {
        const BlockInstance& instance = this->Source.Instances[i];
        const glm::dvec2 place = map->GetPlace(instance.Scalar);
        this->Result.Instances[i].MapPlace = place;
        isKnown = isKnown && instance.HasScalar && IsAlike(map->GetColor(place), instance.Color);
      }
      this->Result.Map = isKnown ? map : nullptr;
    }
    else if (hasScalars && this->Result.Coloring != Mesh::ColorsOf::None)
    {
      for (const vtkIdType index : ofCells ? this->Cells : this->Points)
      {
        this->Result.MapPlaces.emplace_back(map->GetPlace(scalars->GetTuple1(index)));
      }
      this->Result.Map = map;
      this->KeepMapIfShown();
    }
  }

  void AddArrays()
  {
    constexpr bool keepsInfinite = true;
    for (vtkDataArray* array : this->Source.Arrays)
    {
      this->Result.Arrays.push_back(
        MakeSurfaceArray(array, NameScalars(array->GetName()), this->Points, keepsInfinite));
    }
    for (vtkDataArray* array : this->Source.CellArrays)
    {
      this->Result.ShapeArrays.push_back(
        MakeSurfaceArray(array, NameScalars(array->GetName()), this->Cells, keepsInfinite));
    }
  }

  /// Arrays need light apart from colours.
  void ShowOneColor()
  {
    const glm::dvec3 color = LinearToSRGB(glm::dvec3(this->Result.Material.BaseColor));
    if (this->Result.GetNumberOfArrays() > 0 && !this->Result.Map && this->Result.HasOneColor() &&
      !this->Result.IsBlack())
    {
      this->Result.Map = std::make_shared<const ColorMap>(
        MakeOneColor({ ToByte(color.x), ToByte(color.y), ToByte(color.z), 255 }));
    }
  }

  /// Whether the map has nearly all colours that the mesh has in the middle of its shapes and
  /// edges.
  bool ShowsMap() const
  {
    const std::vector<glm::vec2> places = this->Result.Shape == Mesh::Shapes::Triangles
      ? std::vector<glm::vec2>{ { 1.0f / 3.0f, 1.0f / 3.0f }, { 0.5f, 0.0f }, { 0.5f, 0.5f },
          { 0.0f, 0.5f } }
      : std::vector<glm::vec2>{ { 0.5f, 0.0f } };
    std::size_t others = 0;
    for (std::uint32_t shape = 0; shape < this->Result.GetNumberOfShapes(); ++shape)
    {
      for (const glm::vec2& place : places)
      {
        const TrianglePoint point{ shape, place.x, place.y };
        others += IsAlike(this->Result.Map->GetColor(this->Result.GetMapPlace(point)),
                    this->Result.GetBaseColor(point))
          ? 0
          : 1;
      }
    }
    return static_cast<double>(others) <=
      MaximumOthers * static_cast<double>(places.size() * this->Result.GetNumberOfShapes());
  }

  const SceneBlock& Source;
  const SceneFrame& World;
  SceneFrame Frame; // of the mesh
  Mesh Result;
  MappedTable Table;                // if it is a texture
  std::vector<std::uint32_t> Index; // of each point, its vertex in triangles
  std::vector<vtkIdType> Points;    // of each vertex, its point
  std::vector<vtkIdType> Cells;     // of each shape, its cell
};
}

Mesh MakeMesh(const SceneBlock& block, const SceneFrame& frame, SurfaceColors& colors)
{
  return MeshMaker(block, frame).Make(colors);
}
}
