// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfShapeLayout.h"

#include "PathTracing/Rays/cslfHitGeometry.h"
#include "cslfMeshEdges.h"
#include "cslfShapePoints.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace cslf
{
namespace
{
// The edge of a cell in spacings: about one and a half texels.
constexpr float EdgeOfCell = 4.0f;

// The factor by which it grows if there are too many cells.
constexpr float EdgeGrowth = 1.2f;

// The most cells of a shape along an axis.
constexpr float MaximumAlong = 32.0f;

// A grid may have this many times the cells that its surface needs, and some more: enough for a
// disc of any orientation, but not for a line.
constexpr float MaximumShare = 32.0f;
constexpr float MaximumAdded = 8.0f;

// The most cells into which shapes are divided, besides one for each: the cost must stay small
// where the spacing is much finer than most light.
constexpr std::uint64_t MaximumDivided = std::uint64_t(1) << 16;

constexpr std::uint8_t Front = 1;
constexpr std::uint8_t Back = 2;
constexpr std::uint8_t OnlyFront = 4; // that light is stored only there

float GetArea(const Mesh& mesh)
{
  double sum = 0.0;
  for (std::uint32_t i = 0; i < mesh.GetNumberOfShapes(); ++i)
  {
    sum += mesh.Shape == Mesh::Shapes::Triangles ? mesh.GetArea(i) : GetRoundArea(mesh, i);
  }
  return static_cast<float>(sum);
}
}

/// A box.
struct ShapeLayout::Bounds
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
  bool Contains(const Bounds& other) const
  {
    return glm::all(glm::lessThanEqual(this->Low, other.Low)) &&
      glm::all(glm::greaterThanEqual(this->High, other.High));
  }
};

/// A shape: an instance, or a sphere or tube that has none.
struct ShapeLayout::Item
{
  Bounds Box;
  float Area;
  std::uint32_t Mesh;

  /// One of a mesh's spheres or tubes, where the mesh lies.
  Item(const cslf::Mesh& mesh, std::uint32_t index, std::uint32_t shape)
    : Area(GetRoundArea(mesh, shape))
    , Mesh(index)
  {
    const std::size_t points = mesh.Shape == cslf::Mesh::Shapes::Tubes ? 2 : 1;
    for (std::size_t point = points * shape; point < points * (shape + std::size_t(1)); ++point)
    {
      this->Box.Add(mesh.Vertices[point], mesh.Radii[point]);
    }
  }

  /// A mesh, where it lies.
  Item(const cslf::Mesh& mesh, std::uint32_t index)
    : Area(GetArea(mesh))
    , Mesh(index)
  {
    for (std::size_t i = 0; i < mesh.Vertices.size(); ++i)
    {
      this->Box.Add(mesh.Vertices[i], mesh.Radii.empty() ? 0.0f : mesh.Radii[i]);
    }
  }

  /// An instance of it.
  Item Place(const cslf::Mesh& mesh, std::uint32_t instance) const
  {
    Item result = *this;
    const float size = std::cbrt(std::abs(glm::determinant(mesh.Instances[instance].Linear)));
    result.Area *= size * size;
    result.Box = Bounds();
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::vec3 point((corner & 1) != 0 ? this->Box.High.x : this->Box.Low.x,
        (corner & 2) != 0 ? this->Box.High.y : this->Box.Low.y,
        (corner & 4) != 0 ? this->Box.High.z : this->Box.Low.z);
      result.Box.Add(ToScene(mesh, instance, point));
    }
    return result;
  }
};

std::uint64_t ShapeLayout::Unit::CountFilled() const
{
  const double edge = std::cbrt(double(this->Edges.x) * this->Edges.y * this->Edges.z);
  const double filled = std::min(this->Area / (edge * edge), 1e9);
  const std::uint64_t least = std::max({ this->Cells.x, this->Cells.y, this->Cells.z });
  return std::clamp<std::uint64_t>(
    static_cast<std::uint64_t>(filled), least, this->GetNumberOfCells());
}

ShapeLayout::ShapeLayout(const Scene& scene, float spacing, const LayoutProgress& progress)
{
  const std::vector<Mesh>& meshes = scene.GetMeshes();
  if (std::all_of(
        meshes.begin(), meshes.end(), [](const Mesh& mesh) { return mesh.CanHoldLattice(); }))
  {
    return;
  }
  std::vector<Item> items;
  for (std::uint32_t index = 0; index < meshes.size(); ++index)
  {
    const Mesh& mesh = meshes[index];
    const bool isStored = !mesh.CanHoldLattice() && !mesh.IsBlack();
    this->AddSides(mesh, progress);
    this->FirstItems.push_back(isStored ? static_cast<std::uint32_t>(items.size()) : None);
    for (std::uint32_t i = 0; isStored && mesh.Instances.empty() && i < mesh.GetNumberOfShapes();
         ++i)
    {
      progress.Step();
      items.emplace_back(mesh, index, i);
    }
    if (isStored && !mesh.Instances.empty())
    {
      const Item item(mesh, index);
      for (std::uint32_t instance = 0; instance < mesh.Instances.size(); ++instance)
      {
        progress.Step();
        items.push_back(item.Place(mesh, instance));
      }
    }
  }
  this->FindLit(scene, items, progress);
  this->AddUnits(items, spacing, progress);
}

void ShapeLayout::FindLit(
  const Scene& scene, const std::vector<Item>& items, const LayoutProgress& progress)
{
  std::vector<Bounds> lights;
  for (const PointLight& light : scene.GetPointLights())
  {
    lights.emplace_back();
    lights.back().Add(light.Position);
  }
  for (std::uint32_t index = 0; index < scene.GetMeshes().size(); ++index)
  {
    const Mesh& mesh = scene.GetMeshes()[index];
    if (mesh.Material.IsEmissive() && !mesh.Vertices.empty())
    {
      const Item item(mesh, index);
      lights.push_back(mesh.Instances.empty() ? item.Box : Bounds());
      for (std::uint32_t instance = 0; instance < mesh.Instances.size(); ++instance)
      {
        lights.back().Add(item.Place(mesh, instance).Box);
      }
    }
  }
  for (const Item& item : items)
  {
    progress.Step(1 + lights.size());
    const bool isLit = scene.GetMeshes()[item.Mesh].Material.IsEmissive() ||
      std::any_of(lights.begin(), lights.end(),
        [&item](const Bounds& light) { return item.Box.Contains(light); });
    this->AreLit.push_back(isLit ? 1 : 0);
  }
}

void ShapeLayout::AddSides(const Mesh& mesh, const LayoutProgress& progress)
{
  this->FirstSides.push_back(this->Sides.size());
  const bool isPassed = mesh.CanBePassed();
  if (mesh.Shape != Mesh::Shapes::Triangles)
  {
    this->Sides.push_back(OnlyFront + Front + (isPassed ? Back : 0));
    return;
  }
  for (const std::uint8_t inside : FindInsides(mesh, progress))
  {
    this->Sides.push_back(isPassed ? Front + Back : Front + Back - inside);
  }
}

void ShapeLayout::AddUnits(
  const std::vector<Item>& items, float spacing, const LayoutProgress& progress)
{
  std::vector<Bounds> boxes;
  std::unordered_map<std::uint64_t, std::uint32_t> neighbours;
  for (const Item& item : items)
  {
    progress.Step();
    auto unit = static_cast<std::uint32_t>(this->Units.size());
    if (item.Box.GetSize() < spacing)
    {
      const glm::vec3 center = 0.5f * (item.Box.Low + item.Box.High);
      const std::uint64_t key = HashCell(glm::floor(center / spacing), item.Mesh);
      unit = neighbours.emplace(key, unit).first->second;
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
  std::uint64_t divided = MaximumDivided + 1;
  for (float edge = EdgeOfCell * spacing; divided > MaximumDivided; edge *= EdgeGrowth)
  {
    progress.Step(boxes.size());
    this->Divide(boxes, edge);
    divided = 0;
    for (const Unit& unit : this->Units)
    {
      divided += unit.CountFilled() - 1;
    }
  }
  for (Unit& unit : this->Units)
  {
    unit.First = this->NumberOfCells;
    this->NumberOfCells += unit.GetNumberOfCells();
  }
}

void ShapeLayout::Divide(const std::vector<Bounds>& boxes, float edge)
{
  for (std::size_t i = 0; i < this->Units.size(); ++i)
  {
    Unit& unit = this->Units[i];
    const glm::vec3 sizes =
      glm::max(boxes[i].High - boxes[i].Low, std::numeric_limits<float>::min());
    const float size = std::max({ sizes.x, sizes.y, sizes.z });
    unit.Low = boxes[i].Low;
    unit.Cells = glm::uvec3(1u);
    if (size > 1.5f * edge)
    {
      const glm::vec3 cells = glm::ceil(sizes / std::max(edge, size / MaximumAlong));
      unit.Cells = glm::uvec3(glm::clamp(cells, 1.0f, MaximumAlong));
      const float needed = unit.Area / (edge * edge);
      if (static_cast<float>(unit.GetNumberOfCells()) > MaximumShare * needed + MaximumAdded)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          unit.Cells[axis] = sizes[axis] == size ? unit.Cells[axis] : 1u;
        }
      }
    }
    unit.Edges = sizes / glm::vec3(unit.Cells);
  }
}

ShapeLayout::Place ShapeLayout::Find(const Hit& hit, const SurfaceHit& surface) const
{
  Place place;
  const std::uint8_t sides = this->GetSides(hit);
  if ((sides & (surface.Inside ? Back : Front)) == 0 ||
    ((sides & OnlyFront) != 0 && surface.Inside))
  {
    return place;
  }
  const Unit& unit = this->Units[this->Items[this->FirstItems[hit.Mesh] + GetShape(hit)]];
  const glm::vec3 position = (surface.LeavePosition - unit.Low) / unit.Edges;
  if (!(glm::abs(position.x) + glm::abs(position.y) + glm::abs(position.z) <
        std::numeric_limits<float>::max()))
  {
    return place;
  }
  const glm::vec3 cell =
    glm::clamp(glm::floor(position), glm::vec3(0.0f), glm::vec3(unit.Cells) - 1.0f);
  place.Offset = glm::clamp(2.0f * (position - cell) - 1.0f, -1.0f, 1.0f);
  const glm::uvec3 index(cell);
  place.Cell = unit.First + (index.z * unit.Cells.y + index.y) * unit.Cells.x + index.x;
  return place;
}

bool ShapeLayout::IsInside(const Hit& hit, bool behind) const
{
  const std::uint32_t first = this->FirstItems[hit.Mesh];
  const bool isLit = first != None && this->AreLit[first + GetShape(hit)] != 0;
  return !isLit && (this->GetSides(hit) & (behind ? Back : Front)) == 0;
}

std::uint32_t ShapeLayout::GetShape(const Hit& hit)
{
  return hit.Instance == Hit::None ? hit.Triangle : hit.Instance;
}

std::uint8_t ShapeLayout::GetSides(const Hit& hit) const
{
  const std::size_t first = this->FirstSides[hit.Mesh];
  const std::size_t next =
    hit.Mesh + 1 < this->FirstSides.size() ? this->FirstSides[hit.Mesh + 1] : this->Sides.size();
  return this->Sides[std::min(first + hit.Triangle, next - 1)];
}
}
