// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The sides of triangles that need values in a cache: all but those inside closed bodies.
 */
#ifndef cslfOpenSides_h
#define cslfOpenSides_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Paths/cslfPathIntegrator.h"
#include "cslfCacheShare.h"
#include "cslfLayoutProgress.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/**
 * The sides of triangles from which random walks find a way out of the scene, or to light. Light
 * paths are reversible: if no walk leads out, hardly any path leads in, and if none leads to light
 * either, there is nothing to store.
 */
class VTKCSLF_EXPORT OpenSides
{
public:
  /// No side of any triangle is open.
  OpenSides() = default;

  /// Walks at random from both sides of all triangles that can hold a lattice, except those that
  /// face the inside of a closed body without light. Neighbours with a
  /// height below half the spacing and similar orientation are combined. The spacing is in scene
  /// space.
  OpenSides(const Scene& scene, const PathIntegrator& paths, std::uint32_t seed, float spacing,
    const LayoutProgress& progress = LayoutProgress());

  /// The sides of a triangle, numbered by Scene::GetTriangleIndex.
  bool Has(std::size_t triangle, bool back) const
  {
    return (this->Sides[triangle] & (back ? Back : Front)) != 0;
  }

  /// Whether a side faces the inside of a closed, opaque body, in which no walk from the side has
  /// found light. False after reading.
  bool IsInside(std::size_t triangle, bool back) const
  {
    return !this->Insides.empty() && !this->Has(triangle, back) &&
      (this->Insides[triangle] & (back ? Back : Front)) != 0;
  }

  /// Whether there are sides that face the inside of a closed body.
  bool HasInsides() const
  {
    return std::any_of(
      this->Insides.begin(), this->Insides.end(), [](std::uint8_t sides) { return sides != 0; });
  }

  /// Makes them the same on all ranks, whose processors may round differently.
  void Agree(CacheShare& share) { share.Complete(this->Sides, 0); }

  /// The sides of all triangles: 1 for the front plus 2 for the back, if open.
  const std::uint8_t* GetData() const { return this->Sides.data(); }

  /// Writes or reads all data.
  template <typename Archive>
  void Exchange(Archive& archive)
  {
    archive.Array(this->Sides);
  }

  std::uint64_t GetNumberOfRays() const { return this->Rays; }

private:
  static constexpr std::uint8_t Front = 1;
  static constexpr std::uint8_t Back = 2;

  std::vector<std::uint8_t> Sides;   // of each triangle
  std::vector<std::uint8_t> Insides; // the sides that face the inside of an opaque, closed body
  std::uint64_t Rays = 0;
};
}

#endif
