// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The arrays that a geometry keeps of the meshes of a scene, as values to be fitted.
 */
#ifndef cslfSceneArrays_h
#define cslfSceneArrays_h

#include "PathTracing/Scene/cslfScene.h"
#include "Pipeline/cslfSurfaceArray.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cslf
{
/// Values are shares of the range of their component in all meshes. Arrays that something lacks, or
/// that have values that are no numbers, have one value more, which is 1 where they are known.
class SceneArrays
{
public:
  SceneArrays() = default;

  /// The arrays of meshes with a map, unless they are the map's own scalars everywhere. Given the
  /// number of the map of each mesh, or 0.
  SceneArrays(const Scene& scene, const std::vector<std::uint8_t>& maps);

  /// Three values each.
  std::size_t GetNumberOfTriples() const { return (this->Values + 2) / 3; }

  /// Replaces values by those at a point, except those that are not known there.
  void Get(std::uint32_t mesh, const TrianglePoint& point, std::vector<glm::vec3>& values) const;

  /// The arrays, of points with these values: of each triple those of all points.
  std::vector<SurfaceArray> MakeArrays(const std::vector<std::vector<glm::vec3>>& values) const;

private:
  struct Entry
  {
    std::string Name;
    std::vector<std::string> Components;
    std::vector<std::array<double, 2>> Ranges; ///< of the components
    std::vector<int> OfMeshes;                 ///< the array's number in each mesh, or negative
    std::size_t First = 0;                     ///< of its values
    bool IsInteger = true;
    bool HasHoles = false;
  };

  void Add(const Mesh& mesh, std::size_t number);
  void AddRange(const std::vector<double>& values, Entry& entry, std::size_t component);

  const std::vector<Mesh>* Meshes = nullptr;
  std::vector<Entry> Entries;
  std::size_t Values = 0;
};
}

#endif
