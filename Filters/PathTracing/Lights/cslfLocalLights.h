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
#include "PathTracing/Shapes/cslfMesh.h"
#include "cslfLightBounds.h"
#include "cslfLightTree.h"
#include "cslfPointLight.h"

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace cslf
{
/// Surfaces emit equally in all directions from their visible sides.
class VTKCSLF_EXPORT Emitter
{
public:
  /// A shape of a mesh in one of its instances, if it has any. The mesh must not move in memory.
  Emitter(const Mesh& mesh, std::uint32_t shape, std::uint32_t instance);

  /// The light must not move in memory.
  explicit Emitter(const PointLight& light)
    : Point(&light)
  {
  }

  /// Bounds with the power of all the emitter's light, which is 0 if it emits none.
  LightBounds GetBounds() const;

  /// Samples light from a point of the emitter: uniformly by area on triangles, as in
  /// cslfRoundView.h on spheres and tubes. There is no sample from within a sphere or a tube,
  /// because all rays hit it.
  LightSample Sample(const glm::vec3& from, const glm::vec2& u) const;

  /// The density, per solid angle, with which Sample chooses the direction of a ray that first hits
  /// the emitter at a distance. The emitter must not be a point light.
  float GetPdf(const glm::vec3& from, const glm::vec3& direction, float distance) const;

private:
  LightSample SampleTriangle(const glm::vec3& from, const glm::vec2& u) const;
  LightSample SampleRound(const glm::vec3& from, const glm::vec2& u) const;
  float GetTrianglePdf(const glm::vec3& direction, float distance) const;
  LightBounds GetTriangleBounds() const;
  LightBounds GetRoundBounds() const;
  float GetImportance() const;
  const MeshInstance* GetInstance() const;

  const Mesh* Source = nullptr; // null for a point light
  const PointLight* Point = nullptr;
  TrianglePoint Place;

  // Of a triangle, in the scene.
  glm::vec3 Corner{ 0.0f };
  glm::vec3 EdgeU{ 0.0f };
  glm::vec3 EdgeV{ 0.0f };
  glm::vec3 Normal{ 0.0f }; // on the front, as long as twice the area
};

/**
 * All emissive triangles, spheres and tubes in all their instances, and the point and spot lights
 * if there are too many to sample each of them.
 */
class VTKCSLF_EXPORT LocalLights
{
public:
  /// Up to this many point lights are all sampled, without noise but at the cost of one ray each.
  static constexpr std::size_t MaximumPoints = 8;

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
