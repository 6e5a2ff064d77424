// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Points of spheres, tubes and instances, uniform over the surface of each if it is not scaled
 * differently along axes.
 */
#ifndef cslfShapePoints_h
#define cslfShapePoints_h

#include "PathTracing/Scene/cslfScene.h"
#include "cslfShapeLayout.h"

#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cslf
{
/// The area of one of a mesh's spheres or tubes, where the mesh lies, without ends at joints.
float GetRoundArea(const Mesh& mesh, std::uint32_t shape);

class ShapePoints
{
public:
  /// A point of a surface, seen along its normal.
  struct Point
  {
    Ray View;
    Hit Seen;
  };

  ShapePoints(const Scene& scene, const ShapeLayout& layout);

  /// A point of one of a unit's shapes, by numbers of [0,1): the first chooses the shape. False if
  /// it has no area.
  bool Get(std::size_t unit, float number, const glm::vec2& u, Point& point) const;

private:
  /// A shape: an instance, or a sphere or tube that has none.
  struct Member
  {
    std::uint32_t Mesh;
    std::uint32_t Shape;
  };

  /// The shapes of a mesh that has instances, each with the sum of the areas up to it.
  struct Parts
  {
    std::vector<double> Sums; // twice for each triangle: of its front and its back
  };

  void AddParts(const ShapeLayout& layout, std::uint32_t mesh);
  bool GetOnTriangle(const Mesh& mesh, std::uint32_t part, const glm::vec2& u, Point& point) const;
  static bool GetOnRound(const Mesh& mesh, std::uint32_t shape, const glm::vec2& u, Point& point);

  const Scene& World;
  std::vector<Parts> PartsOfMeshes;
  std::vector<std::uint32_t> Ends; // of each unit's members
  std::vector<Member> Members;
};
}

#endif
