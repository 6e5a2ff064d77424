// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Divides spheres, tubes and instances into cells, within each of which light varies smoothly, and
 * chooses points on them.
 *
 * A shape is one cell if it is small, so that its light is continuous; a large one is divided by a
 * grid. Shapes smaller than the spacing share a cell with their neighbours. So the number of cells
 * depends on the area to be stored, not on the number of shapes.
 */
#ifndef cslfShapeLayout_h
#define cslfShapeLayout_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "PathTracing/Scene/cslfScene.h"
#include "cslfCacheShare.h"

#include <glm/vec2.hpp>
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
    float Edge = 0.0f;       ///< of its cells
    glm::uvec3 Cells{ 1u };  ///< along the axes
    std::uint32_t First = 0; ///< its first cell
    float Area = 0.0f;       ///< of its surfaces

    std::uint32_t GetNumberOfCells() const { return this->Cells.x * this->Cells.y * this->Cells.z; }
  };

  /// A place in a cell: from its centre, in units of half its edge.
  struct Place
  {
    std::uint32_t Cell = None;
    glm::vec3 Offset{ 0.0f };
  };

  ShapeLayout() = default;

  /// The spacing, in scene space, is about the size of the smallest shadows to be stored.
  ShapeLayout(const Scene& scene, const PathSettings& paths, std::uint32_t seed, float spacing);

  /// Whether a mesh consists of such shapes.
  bool Has(std::uint32_t mesh) const
  {
    return mesh < this->FirstItems.size() && this->FirstItems[mesh] != None;
  }

  /// The place of a surface point of such a mesh; in no cell if it is inside a closed body.
  Place Find(const Hit& hit, const SurfaceHit& surface) const;

  /// Whether a ray that hits such a mesh comes from the inside of a closed body.
  bool IsWithin(const Hit& hit, bool inside) const;

  /// Makes them the same on all ranks, whose processors may round differently.
  void Agree(CacheShare& share) { share.Complete(this->Sides, 0); }

  const std::vector<Unit>& GetUnits() const { return this->Units; }
  std::uint32_t GetNumberOfCells() const { return this->NumberOfCells; }
  std::uint64_t GetNumberOfRays() const { return this->Rays; }

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

  struct Item;

  void AddSides(const Scene& scene, std::uint32_t mesh, const PathSettings& paths,
    std::uint32_t seed, float spacing);
  void AddUnits(const std::vector<Item>& items, float spacing);

  std::uint32_t NumberOfCells = 0;
  std::vector<std::uint32_t> FirstItems; // of each mesh; None if it has none
  std::vector<std::uint32_t> FirstSides; // of each mesh; None if it is of spheres or tubes
  std::vector<std::uint8_t> Sides;       // of triangles with instances: as in OpenSides
  std::vector<std::uint32_t> Items;      // the units of the shapes: instances, spheres and tubes
  std::vector<Unit> Units;
  std::uint64_t Rays = 0;
};
}

#endif
