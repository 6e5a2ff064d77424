// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One light at a finite distance: an emissive triangle, sphere or tube, or a point light.
 */
#ifndef cslfEmitter_h
#define cslfEmitter_h

#include "vtkCSLFModule.h" // for export macro

#include "PathTracing/Shapes/cslfMesh.h"
#include "cslfLightBounds.h"
#include "cslfLightSample.h"
#include "cslfPointLight.h"

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
}

#endif
