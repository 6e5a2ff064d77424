// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The maps and images that tell the base colours of a scene's meshes.
 */
#ifndef cslfSceneMaps_h
#define cslfSceneMaps_h

#include "PathTracing/Shapes/cslfMesh.h"
#include "Pipeline/cslfColorMap.h"
#include "Pipeline/cslfPhase.h"
#include "cslfSurfaceRegions.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cslf
{
/// Each map once. Images of textures become as fine as views need, and lose what no surface shows.
class SceneMaps
{
public:
  SceneMaps() = default;

  /// Given the size of a texel at the cube's centre, in scene space. Throws Aborted.
  SceneMaps(const std::vector<Mesh>& meshes, float texel, const Progress& progress);

  /// Of each mesh the number of its map, from 1, or 0.
  const std::vector<std::uint8_t>& GetNumbers() const { return this->Numbers; }
  std::uint8_t GetNumber(std::uint32_t mesh) const
  {
    return mesh < this->Numbers.size() ? this->Numbers[mesh] : std::uint8_t(0);
  }

  ///@{
  /// Of a mesh with a map: the place on it, and what multiplies its colours.
  glm::vec2 GetPlace(
    const Mesh& mesh, const SurfaceRegions& regions, const TrianglePoint& point) const;
  glm::vec3 GetFactor(const Mesh& mesh) const;
  ///@}

  /// The error of places on a map that is small enough, in columns or pixels. Given its number.
  float GetTolerance(std::uint8_t number) const { return this->Tolerances[number - 1]; }

  ///@{
  /// Whether a map is an image, and the most of its pixels along a texel of the field.
  bool IsImage(std::uint8_t number) const { return this->Maps[number - 1].IsImage(); }
  float GetPixelsOfTexel(std::uint8_t number) const { return this->PixelsOfTexels[number - 1]; }
  ///@}

  std::vector<ColorMap> TakeMaps() { return std::move(this->Maps); }

private:
  /// Places on an image are those of texture coordinates less an origin, times a scale.
  struct Frame
  {
    glm::vec2 Origin{ 0.0f };
    glm::vec2 Scale{ 1.0f };
  };

  void AddImages(const std::vector<Mesh>& meshes, float texel, const Progress& progress);

  const Mesh* First = nullptr;
  std::vector<ColorMap> Maps;
  std::vector<std::uint8_t> Numbers; // of the meshes
  std::vector<float> Tolerances;     // of the maps
  std::vector<Frame> Frames;         // of the maps; used by images
  std::vector<float> PixelsOfTexels; // likewise
};
}

#endif
