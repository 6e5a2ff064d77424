// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Samples the lights of a scene at a finite distance.
 */
#ifndef cslfLocalLights_h
#define cslfLocalLights_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Rays/cslfRayPacket.h"
#include "cslfEmitter.h"
#include "cslfLightTree.h"

#include <cstdint>
#include <vector>

namespace cslf
{
/**
 * All emissive triangles, spheres and tubes in all their instances, and the point and spot lights
 * if there are too many to sample each of them.
 */
class VTKCSLF_EXPORT LocalLights
{
public:
  /// Up to this many point lights are all sampled, without noise but at the cost of one ray each.
  static constexpr std::size_t MostPoints = 8;

  LocalLights() = default;

  /// Meshes and lights must not move in memory.
  LocalLights(const std::vector<Mesh>& meshes, const std::vector<PointLight>& points);

  /// Whether there are emissive surfaces, which rays can hit, too.
  bool HasSurfaces() const { return this->SurfaceCount > 0; }

  /// The point lights that are all sampled, because there are only a few.
  const std::vector<PointLight>& GetFewPoints() const { return this->Few; }

  /// Whether Sample also chooses among point lights.
  bool HasPoints() const { return this->Emitters.size() > this->SurfaceCount; }

  /// Samples light from one of the lights. The radiance of a point light is divided by the
  /// probability of its choice.
  LightSample Sample(const LightReceiver& receiver, const glm::vec2& u) const;

  /// The density, per solid angle, with which Sample chooses the direction of a ray from the
  /// receiver that hits a surface: 0 if the surface is not sampled.
  float GetPdf(const LightReceiver& receiver, const glm::vec3& direction, const Hit& hit) const;

private:
  static constexpr std::uint32_t None = 0xffffffffu;

  void AddShapes(const Mesh& mesh, std::uint32_t instance, std::vector<std::uint32_t>& indices,
    std::vector<LightBounds>& bounds);
  void AddPoints(const std::vector<PointLight>& points, std::vector<LightBounds>& bounds);

  std::vector<Emitter> Emitters; // surfaces first
  std::size_t SurfaceCount = 0;
  std::vector<PointLight> Few;
  std::vector<std::vector<std::uint32_t>> Indices; // of each mesh: of its shapes, by instances
  std::vector<std::uint32_t> ShapeCounts;          // of each mesh
  LightTree Tree;
};
}

#endif
