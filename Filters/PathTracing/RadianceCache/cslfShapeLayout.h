// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Divides spheres, tubes and instances into cells, within each of which light varies smoothly.
 *
 * A shape is one cell if it is small, so that its light is continuous. A large one is divided by a
 * grid or, if its surface fills little of that, into slabs across its longest axis. Shapes smaller
 * than the spacing share a cell with their neighbours. So the number of cells depends on the area
 * to be stored. If there would be too many, the cells are larger.
 */
#ifndef cslfShapeLayout_h
#define cslfShapeLayout_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Scene/cslfScene.h"
#include "cslfLayoutProgress.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT ShapeLayout
{
public:
  static constexpr std::uint32_t None = 0xffffffffu;

  /// Shapes that are stored together: one, or several small neighbours.
  struct Unit
  {
    glm::vec3 Low{ 0.0f };   ///< of its box
    glm::vec3 Edges{ 0.0f }; ///< of its cells
    glm::uvec3 Cells{ 1u };  ///< along the axes
    std::uint32_t First = 0; ///< its first cell
    float Area = 0.0f;       ///< of its surfaces

    std::uint32_t GetNumberOfCells() const { return this->Cells.x * this->Cells.y * this->Cells.z; }

    /// About how many of them contain a surface: at least 1.
    std::uint64_t CountFilled() const;
  };

  /// A place in a cell: from its centre, in halves of its edges.
  struct Place
  {
    std::uint32_t Cell = None;
    glm::vec3 Offset{ 0.0f };
  };

  ShapeLayout() = default;

  /// The spacing, in scene space, is about the size of the smallest shadows to be stored.
  ShapeLayout(const Scene& scene, float spacing, const LayoutProgress& progress = LayoutProgress());

  /// Whether a mesh consists of such shapes.
  bool Has(std::uint32_t mesh) const
  {
    return mesh < this->FirstItems.size() && this->FirstItems[mesh] != None;
  }

  /// The place of a surface point of such a mesh; in no cell if it is inside a closed body.
  Place Find(const Hit& hit, const SurfaceHit& surface) const;

  /// Whether there are meshes that cannot hold a lattice.
  bool HasShapes() const { return !this->FirstItems.empty(); }

  /// Whether the side that a ray hits of a mesh that cannot hold a lattice, from behind or not,
  /// faces the inside of a closed, opaque body, in which no light is known. Not after reading.
  bool IsInside(const Hit& hit, bool behind) const;

  const std::vector<Unit>& GetUnits() const { return this->Units; }
  std::uint32_t GetNumberOfCells() const { return this->NumberOfCells; }

  /// Writes or reads all that look-ups need.
  template <typename Archive>
  void Exchange(Archive& archive)
  {
    archive.Value(this->NumberOfCells);
    archive.Array(this->FirstItems);
    archive.Array(this->FirstSides);
    archive.Array(this->Sides);
    archive.Array(this->Items);
    archive.Array(this->Units);
  }

private:
  friend class ShapePoints;

  struct Bounds;
  struct Item;

  static std::uint32_t GetShape(const Hit& hit);
  std::uint8_t GetSides(const Hit& hit) const;
  void AddSides(const Mesh& mesh, const LayoutProgress& progress);
  void FindLit(const Scene& scene, const std::vector<Item>& items, const LayoutProgress& progress);
  void AddUnits(const std::vector<Item>& items, float spacing, const LayoutProgress& progress);
  void Divide(const std::vector<Bounds>& boxes, float edge);

  std::uint32_t NumberOfCells = 0;
  std::vector<std::uint32_t> FirstItems; // of each mesh; None if it has none
  std::vector<std::size_t> FirstSides;   // of each mesh; empty if all meshes can hold a lattice
  std::vector<std::uint8_t> Sides;       // those of triangles, or of all of a mesh's shapes, that
                                         // are not inside: 1 for the front plus 2 for the back,
                                         // plus 4 if light is stored only on the front
  std::vector<std::uint32_t> Items;      // the units of the shapes: instances, spheres and tubes
  std::vector<Unit> Units;
  std::vector<std::uint8_t> AreLit; // the shapes: 1 if one emits, or light may be in it, else 0
};
}

#endif
