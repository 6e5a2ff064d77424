// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Which sides of triangles are worth a cache's values: not those inside closed bodies.
 */
#ifndef cslfOpenSides_h
#define cslfOpenSides_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/cslfPathIntegrator.h"
#include "cslfCacheShare.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/**
 * The sides of triangles from which a way out of the scene, or to light, is found by chance. Light
 * goes ways in both directions: where no way leads out, hardly any path leads in, and where none
 * leads to light either, there is nothing to store.
 */
class VTKCSLF_EXPORT OpenSides
{
public:
  /// No side of any triangle.
  OpenSides() = default;

  /// Walks at random from both sides of all triangles that can hold a lattice. Neighbours that are
  /// lower than half the spacing and face alike are taken as one. The spacing is in scene space.
  OpenSides(const Scene& scene, const PathIntegrator& paths, std::uint32_t seed, float spacing);

  /// Tells of a triangle, numbered by Scene::GetTriangleIndex.
  bool Has(std::size_t triangle, bool back) const
  {
    return (this->Sides[triangle] & (back ? Back : Front)) != 0;
  }

  /// Makes them the same on all ranks, whose processors may round differently.
  void Agree(CacheShare& share) { share.Complete(this->Sides, 0); }

  /// The sides of all triangles: 1 for the front and 2 for the back, added up where both are open.
  const std::uint8_t* GetData() const { return this->Sides.data(); }

  /// Hands over all that is known, or takes it back.
  template <typename Archive>
  void Exchange(Archive& archive)
  {
    archive.Array(this->Sides);
  }

  std::uint64_t GetNumberOfRays() const { return this->Rays; }

private:
  static constexpr std::uint8_t Front = 1;
  static constexpr std::uint8_t Back = 2;

  std::vector<std::uint8_t> Sides; // of each triangle
  std::uint64_t Rays = 0;
};
}

#endif
