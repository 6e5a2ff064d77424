// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShapeLayout.h"

#include "PathTracing/Shapes/cslfHitGeometry.h"
#include "RandomNumbers/cslfSampleStream.h"
#include "RandomNumbers/cslfSampling.h"
#include "cslfOpenSides.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

namespace cslf
{
namespace
{
// The edge of a cell in spacings: about one and a half texels.
constexpr float EdgeOfCell = 4.0f;

// The most cells of a shape along an axis.
constexpr float MostCells = 32.0f;

struct Bounds
{
  glm::vec3 Low{ std::numeric_limits<float>::max() };
  glm::vec3 High{ std::numeric_limits<float>::lowest() };

  void Add(const glm::vec3& point, float radius = 0.0f)
  {
    this->Low = glm::min(this->Low, point - radius);
    this->High = glm::max(this->High, point + radius);
  }
  void Add(const Bounds& other)
  {
    this->Low = glm::min(this->Low, other.Low);
    this->High = glm::max(this->High, other.High);
  }
  float GetSize() const
  {
    const glm::vec3 size = this->High - this->Low;
    return std::max({ size.x, size.y, size.z });
  }
};

/// Of one of a mesh's spheres or tubes, where the mesh lies.
Bounds FindBounds(const Mesh& mesh, std::uint32_t shape)
{
  Bounds bounds;
  const std::size_t points = mesh.Shape == Mesh::Shapes::Tubes ? 2 : 1;
  for (std::size_t point = points * shape; point < points * (shape + std::size_t(1)); ++point)
  {
    bounds.Add(mesh.Vertices[point], mesh.Radii[point]);
  }
  return bounds;
}

/// Of a mesh, where it lies.
Bounds FindBounds(const Mesh& mesh)
{
  Bounds bounds;
  for (std::size_t i = 0; i < mesh.Vertices.size(); ++i)
  {
    bounds.Add(mesh.Vertices[i], mesh.Radii.empty() ? 0.0f : mesh.Radii[i]);
  }
  return bounds;
}

/// Of an instance of a mesh with these bounds.
Bounds Transform(const Bounds& bounds, const Mesh& mesh, std::uint32_t instance)
{
  Bounds result;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::vec3 point((corner & 1) != 0 ? bounds.High.x : bounds.Low.x,
      (corner & 2) != 0 ? bounds.High.y : bounds.Low.y,
      (corner & 4) != 0 ? bounds.High.z : bounds.Low.z);
    result.Add(ToScene(mesh, instance, point));
  }
  return result;
}

/// The area of one of a mesh's spheres or tubes.
float GetArea(const Mesh& mesh, std::uint32_t shape)
{
  if (mesh.Shape == Mesh::Shapes::Spheres)
  {
    return 4.0f * Pi * mesh.Radii[shape] * mesh.Radii[shape];
  }
  const Tube tube = GetTube(mesh, shape);
  const float end = tube.GetRadius(1.0f);
  return Pi * (tube.Radius + end) * (tube.Length + tube.Radius + end);
}

float GetArea(const Mesh& mesh)
{
  double sum = 0.0;
  for (std::uint32_t i = 0; i < mesh.GetNumberOfShapes(); ++i)
  {
    sum += mesh.Shape == Mesh::Shapes::Triangles ? mesh.GetArea(i) : GetArea(mesh, i);
  }
  return static_cast<float>(sum);
}

std::uint64_t HashCell(const glm::vec3& cell)
{
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    key = MixBits(key, static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[axis])));
  }
  return key;
}
}

/// A shape: an instance, or a sphere or tube that has none.
struct ShapeLayout::Item
{
  Bounds Box;
  float Area;
};

ShapeLayout::ShapeLayout(
  const Scene& scene, const PathSettings& paths, std::uint32_t seed, float spacing)
{
  std::vector<Item> items;
  for (std::uint32_t index = 0; index < scene.GetMeshes().size(); ++index)
  {
    const Mesh& mesh = scene.GetMeshes()[index];
    const bool isStored = !mesh.CanHoldLattice() && !mesh.IsBlack();
    this->FirstItems.push_back(isStored ? static_cast<std::uint32_t>(items.size()) : None);
    this->FirstSides.push_back(None);
    if (!isStored)
    {
      continue;
    }
    if (mesh.Shape == Mesh::Shapes::Triangles)
    {
      this->AddSides(scene, index, paths, seed, spacing);
    }
    if (mesh.Instances.empty())
    {
      for (std::uint32_t shape = 0; shape < mesh.GetNumberOfShapes(); ++shape)
      {
        items.push_back({ FindBounds(mesh, shape), GetArea(mesh, shape) });
      }
      continue;
    }
    const Bounds bounds = FindBounds(mesh);
    const float area = GetArea(mesh);
    for (std::uint32_t instance = 0; instance < mesh.Instances.size(); ++instance)
    {
      const float size = std::cbrt(std::abs(glm::determinant(mesh.Instances[instance].Linear)));
      items.push_back({ Transform(bounds, mesh, instance), area * size * size });
    }
  }
  this->AddUnits(items, spacing);
}

/// Finds out which sides of a mesh's triangles are not inside a closed body, by itself.
void ShapeLayout::AddSides(const Scene& scene, std::uint32_t mesh, const PathSettings& paths,
  std::uint32_t seed, float spacing)
{
  std::vector<Mesh> alone(1, scene.GetMeshes()[mesh]);
  alone[0].Instances.clear();
  alone[0].HasInstanceColors = false;
  alone[0].HasInstanceEmissions = false;
  const std::uint32_t count = alone[0].GetNumberOfShapes();
  const Scene world(std::move(alone), LightSet());
  const OpenSides open(world, PathIntegrator(world, paths), seed, spacing);
  this->Rays += open.GetNumberOfRays();
  this->FirstSides[mesh] = static_cast<std::uint32_t>(this->Sides.size());
  this->Sides.insert(this->Sides.end(), open.GetData(), open.GetData() + count);
}

void ShapeLayout::AddUnits(const std::vector<Item>& items, float spacing)
{
  std::vector<Bounds> boxes;
  std::unordered_map<std::uint64_t, std::uint32_t> neighbours;
  for (const Item& item : items)
  {
    auto unit = static_cast<std::uint32_t>(this->Units.size());
    if (item.Box.GetSize() < spacing)
    {
      const glm::vec3 center = 0.5f * (item.Box.Low + item.Box.High);
      unit = neighbours.emplace(HashCell(glm::floor(center / spacing)), unit).first->second;
    }
    if (unit == this->Units.size())
    {
      this->Units.emplace_back();
      boxes.emplace_back();
    }
    this->Items.push_back(unit);
    boxes[unit].Add(item.Box);
    this->Units[unit].Area += item.Area;
  }
  for (std::size_t i = 0; i < this->Units.size(); ++i)
  {
    Unit& unit = this->Units[i];
    const float size = std::max(boxes[i].GetSize(), std::numeric_limits<float>::min());
    const float edge = EdgeOfCell * spacing;
    unit.Low = boxes[i].Low;
    unit.Edge = size < 1.5f * edge ? size : std::max(edge, size / MostCells);
    const glm::vec3 cells = glm::ceil((boxes[i].High - boxes[i].Low) / unit.Edge);
    unit.Cells = glm::uvec3(glm::clamp(cells, 1.0f, MostCells));
    unit.First = this->NumberOfCells;
    this->NumberOfCells += unit.GetNumberOfCells();
  }
}

ShapeLayout::Place ShapeLayout::Find(const Hit& hit, const SurfaceHit& surface) const
{
  Place place;
  if (this->IsWithin(hit, surface.Inside))
  {
    return place;
  }
  const std::uint32_t shape = hit.Instance == Hit::None ? hit.Triangle : hit.Instance;
  const Unit& unit = this->Units[this->Items[this->FirstItems[hit.Mesh] + shape]];
  const glm::vec3 position = (surface.LeavePosition - unit.Low) / unit.Edge;
  const glm::vec3 cell =
    glm::clamp(glm::floor(position), glm::vec3(0.0f), glm::vec3(unit.Cells) - 1.0f);
  place.Offset = glm::clamp(2.0f * (position - cell) - 1.0f, -1.0f, 1.0f);
  const glm::uvec3 index(cell);
  place.Cell = unit.First + (index.z * unit.Cells.y + index.y) * unit.Cells.x + index.x;
  return place;
}

bool ShapeLayout::IsWithin(const Hit& hit, bool inside) const
{
  const std::uint32_t first = this->FirstSides[hit.Mesh];
  const int open = first == None ? 1 : this->Sides[first + hit.Triangle];
  return ((open >> (inside ? 1 : 0)) & 1) == 0;
}
}
