// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMeshJoin.h"

#include "cslfFingerprint.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

namespace cslf
{
namespace
{
/// What meshes must share to be joined: the appearance and the instances first.
using Kind = std::tuple<std::string, std::string, Mesh::Shapes, Mesh::ColorsOf, Mesh::ColorsOf,
  bool, bool, bool, bool, bool>;

Kind GetKind(const Mesh& mesh)
{
  std::string places;
  if (!mesh.Instances.empty())
  {
    Fingerprint fingerprint;
    fingerprint.Add(mesh.Instances);
    places = fingerprint.Finish();
  }
  std::string appearance = mesh.Appearance;
  for (std::size_t i = 0; i < mesh.GetNumberOfArrays(); ++i)
  {
    appearance += (i < mesh.Arrays.size() ? "\n" : "\n\n") + mesh.GetArray(i).Name;
    for (const SurfaceArray::Component& component : mesh.GetArray(i).Components)
    {
      appearance += "\t" + component.Name;
    }
  }
  return { appearance, places, mesh.Shape, mesh.Coloring, mesh.EmissionsOf, mesh.TexCoords.empty(),
    mesh.HasInstanceColors, mesh.HasInstanceEmissions, mesh.Map == nullptr,
    mesh.MapPlaces.empty() };
}

template <typename Value>
void Append(std::vector<Value>& whole, const std::vector<Value>& piece)
{
  whole.insert(whole.end(), piece.begin(), piece.end());
}

/// The same if one of the two may lack its values, which are then `none`.
template <typename Value>
void AppendOptional(std::vector<Value>& whole, std::size_t wholeCount,
  const std::vector<Value>& piece, std::size_t pieceCount, const Value& none)
{
  if (!whole.empty() || !piece.empty())
  {
    whole.resize(wholeCount, none);
    Append(whole, piece);
    whole.resize(wholeCount + pieceCount, none);
  }
}

void Append(std::vector<SurfaceArray>& whole, const std::vector<SurfaceArray>& piece)
{
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    for (std::size_t c = 0; c < whole[i].Components.size(); ++c)
    {
      Append(whole[i].Components[c].Values, piece[i].Components[c].Values);
    }
    whole[i].IsInteger = whole[i].IsInteger && piece[i].IsInteger;
  }
}

void Append(Mesh& whole, const Mesh& piece)
{
  const std::size_t first = whole.Vertices.size();
  AppendOptional(whole.Normals, first, piece.Normals, piece.Vertices.size(), glm::vec3(0.0f));
  AppendOptional(whole.Opacities, whole.Colors.size(), piece.Opacities, piece.Colors.size(), 1.0f);
  Append(whole.Colors, piece.Colors);
  Append(whole.Emissions, piece.Emissions);
  whole.Material.Emission = glm::max(whole.Material.Emission, piece.Material.Emission);
  AppendOptional(whole.Joints, first, piece.Joints, piece.Vertices.size(), 0u);
  Append(whole.Vertices, piece.Vertices);
  Append(whole.Radii, piece.Radii);
  Append(whole.TexCoords, piece.TexCoords);
  Append(whole.MapPlaces, piece.MapPlaces);
  Append(whole.Arrays, piece.Arrays);
  Append(whole.ShapeArrays, piece.ShapeArrays);
  for (const glm::uvec3& triangle : piece.Triangles)
  {
    whole.Triangles.push_back(static_cast<std::uint32_t>(first) + triangle);
  }
}

/// The values of `count` vertices or shapes in all arrays, of each as many bits. None without
/// arrays.
std::vector<std::vector<std::uint64_t>> ListBits(
  const std::vector<SurfaceArray>& arrays, std::size_t count)
{
  std::vector<std::vector<std::uint64_t>> bits(arrays.empty() ? 0 : count);
  for (const SurfaceArray& array : arrays)
  {
    for (const SurfaceArray::Component& component : array.Components)
    {
      for (std::size_t i = 0; i < bits.size(); ++i)
      {
        std::memcpy(&bits[i].emplace_back(), &component.Values[i], sizeof(double));
      }
    }
  }
  return bits;
}

/// Compares values as words, which gives an order regardless of their meaning. Only identical bits
/// are equal.
template <std::size_t Size>
class Words
{
public:
  template <typename Value>
  void Add(const Value& value)
  {
    constexpr std::size_t wordBytes = sizeof(std::uint32_t);
    static_assert(sizeof(Value) % wordBytes == 0, "it must be whole words");
    std::memcpy(&this->Values[this->Count], &value, sizeof(Value));
    this->Count += sizeof(Value) / wordBytes;
  }

  /// The value of an array at an index, if it has any.
  template <typename Value>
  void AddFrom(const std::vector<Value>& values, std::size_t index)
  {
    if (!values.empty())
    {
      this->Add(values[index]);
    }
  }

  bool operator<(const Words& other) const { return this->Values < other.Values; }
  bool operator==(const Words& other) const { return this->Values == other.Values; }

private:
  std::array<std::uint32_t, Size> Values{};
  std::size_t Count = 0;
};

using Indices = std::vector<std::uint32_t>;

/// The indices of items in the order of the items.
template <typename Item>
Indices FindOrder(const std::vector<Item>& items)
{
  Indices order(items.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
    [&items](std::uint32_t a, std::uint32_t b) { return items[a] < items[b]; });
  return order;
}

/// Replaces values, if there are any, by those at indices.
template <typename Value>
void Take(std::vector<Value>& values, const Indices& indices)
{
  if (!values.empty())
  {
    std::vector<Value> taken;
    taken.reserve(indices.size());
    for (std::uint32_t index : indices)
    {
      taken.push_back(values[index]);
    }
    values = std::move(taken);
  }
}

void Take(std::vector<SurfaceArray>& arrays, const Indices& indices)
{
  for (SurfaceArray& array : arrays)
  {
    for (SurfaceArray::Component& component : array.Components)
    {
      Take(component.Values, indices);
    }
  }
}

/// Sorts the shapes and the vertices of one mesh.
class MeshSorter
{
public:
  explicit MeshSorter(Mesh& mesh)
    : Sorted(mesh)
  {
  }

  void Sort()
  {
    this->RankVertices();
    const Indices order = this->OrderShapes();
    if (this->Sorted.Shape == Mesh::Shapes::Triangles)
    {
      Take(this->Sorted.Triangles, order);
      for (glm::uvec3& triangle : this->Sorted.Triangles)
      {
        triangle = { this->Ranks[triangle.x], this->Ranks[triangle.y], this->Ranks[triangle.z] };
      }
      this->TakeVertices(this->Distinct);
    }
    else
    {
      this->TakeVertices(this->FindCorners(order));
    }
    if (this->Sorted.Coloring == Mesh::ColorsOf::Triangles)
    {
      Take(this->Sorted.Colors, order);
      Take(this->Sorted.Opacities, order);
      Take(this->Sorted.MapPlaces, order);
    }
    Take(this->Sorted.ShapeArrays, order);
    if (this->Sorted.EmissionsOf == Mesh::ColorsOf::Triangles)
    {
      Take(this->Sorted.Emissions, order);
    }
  }

private:
  /// Finds the distinct vertices, in order, and the place of each vertex among them.
  void RankVertices()
  {
    std::vector<Words<20>> vertices(this->Sorted.Vertices.size());
    const Indices arrays = RankArrays(this->Sorted.Arrays, this->Sorted.Vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
      vertices[i].Add(this->Sorted.Vertices[i]);
      vertices[i].AddFrom(this->Sorted.Radii, i);
      vertices[i].AddFrom(this->Sorted.Joints, i);
      vertices[i].AddFrom(this->Sorted.Normals, i);
      vertices[i].AddFrom(this->Sorted.TexCoords, i);
      vertices[i].AddFrom(arrays, i);
      if (this->Sorted.Coloring == Mesh::ColorsOf::Vertices)
      {
        vertices[i].AddFrom(this->Sorted.MapPlaces, i);
        vertices[i].AddFrom(this->Sorted.Colors, i);
        vertices[i].AddFrom(this->Sorted.Opacities, i);
      }
      if (this->Sorted.EmissionsOf == Mesh::ColorsOf::Vertices)
      {
        vertices[i].AddFrom(this->Sorted.Emissions, i);
      }
    }
    this->Ranks.resize(vertices.size());
    for (std::uint32_t index : FindOrder(vertices))
    {
      if (this->Distinct.empty() || !(vertices[this->Distinct.back()] == vertices[index]))
      {
        this->Distinct.push_back(index);
      }
      this->Ranks[index] = static_cast<std::uint32_t>(this->Distinct.size() - 1);
    }
  }

  /// Of each vertex or shape, the rank of its values in arrays. None without arrays.
  static Indices RankArrays(const std::vector<SurfaceArray>& arrays, std::size_t count)
  {
    const std::vector<std::vector<std::uint64_t>> bits = ListBits(arrays, count);
    Indices ranks(bits.size(), 0);
    const Indices order = FindOrder(bits);
    for (std::size_t i = 1; i < order.size(); ++i)
    {
      const bool isSame = bits[order[i]] == bits[order[i - 1]];
      ranks[order[i]] = ranks[order[i - 1]] + (isSame ? 0 : 1);
    }
    return ranks;
  }

  Indices OrderShapes() const
  {
    std::vector<Words<13>> shapes(this->Sorted.GetNumberOfShapes());
    const Indices arrays = RankArrays(this->Sorted.ShapeArrays, shapes.size());
    for (std::size_t i = 0; i < shapes.size(); ++i)
    {
      for (std::uint32_t corner : this->GetCorners(static_cast<std::uint32_t>(i)))
      {
        shapes[i].Add(this->Ranks[corner]);
      }
      if (this->Sorted.Coloring == Mesh::ColorsOf::Triangles)
      {
        shapes[i].AddFrom(this->Sorted.Colors, i);
        shapes[i].AddFrom(this->Sorted.Opacities, i);
        shapes[i].AddFrom(this->Sorted.MapPlaces, i);
      }
      shapes[i].AddFrom(arrays, i);
      if (this->Sorted.EmissionsOf == Mesh::ColorsOf::Triangles)
      {
        shapes[i].AddFrom(this->Sorted.Emissions, i);
      }
    }
    return FindOrder(shapes);
  }

  /// The vertices of a shape. Those of spheres and tubes follow each other.
  Indices GetCorners(std::uint32_t shape) const
  {
    switch (this->Sorted.Shape)
    {
      case Mesh::Shapes::Spheres:
        return { shape };
      case Mesh::Shapes::Tubes:
        return { 2 * shape, 2 * shape + 1 };
      default:
        break;
    }
    const glm::uvec3& triangle = this->Sorted.Triangles[shape];
    return { triangle.x, triangle.y, triangle.z };
  }

  Indices FindCorners(const Indices& shapes) const
  {
    Indices corners;
    for (std::uint32_t shape : shapes)
    {
      Append(corners, this->GetCorners(shape));
    }
    return corners;
  }

  void TakeVertices(const Indices& indices)
  {
    Take(this->Sorted.Vertices, indices);
    Take(this->Sorted.Radii, indices);
    Take(this->Sorted.Joints, indices);
    Take(this->Sorted.Normals, indices);
    Take(this->Sorted.TexCoords, indices);
    Take(this->Sorted.Arrays, indices);
    if (this->Sorted.Coloring == Mesh::ColorsOf::Vertices)
    {
      Take(this->Sorted.MapPlaces, indices);
      Take(this->Sorted.Colors, indices);
      Take(this->Sorted.Opacities, indices);
    }
    if (this->Sorted.EmissionsOf == Mesh::ColorsOf::Vertices)
    {
      Take(this->Sorted.Emissions, indices);
    }
  }

  Mesh& Sorted;
  Indices Distinct; // one representative of each set of equal vertices
  Indices Ranks;    // of each vertex, its index among the distinct ones
};
}

std::vector<Mesh> JoinMeshes(std::vector<Mesh>&& pieces)
{
  std::map<Kind, Mesh> joined;
  for (Mesh& piece : pieces)
  {
    const auto [place, isFirst] = joined.try_emplace(GetKind(piece), std::move(piece));
    if (!isFirst)
    {
      Append(place->second, piece);
    }
  }
  std::vector<Mesh> meshes;
  for (auto& [kind, mesh] : joined)
  {
    MeshSorter(mesh).Sort();
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}
}
