// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * One light at a finite distance: a triangle, sphere or tube that shines, or a point light.
 */
#ifndef cslfEmitter_h
#define cslfEmitter_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfLightBounds.h"
#include "cslfLightSample.h"
#include "cslfMesh.h"
#include "cslfPointLight.h"

#include <glm/vec2.hpp>

namespace cslf
{
/// Surfaces emit alike in all directions, from their visible sides.
class VTKCSLF_EXPORT Emitter
{
public:
  /// A shape of a mesh in one of its instances, if it has any. The mesh must stay where it is.
  Emitter(const Mesh& mesh, std::uint32_t shape, std::uint32_t instance);

  /// The light must stay where it is.
  explicit Emitter(const PointLight& light)
    : Point(&light)
  {
  }

  /// Bounds whose power is that of all the emitter's light: 0 where it does not shine.
  LightBounds GetBounds() const;

  /// Light from a point of the emitter: of triangles one that is uniform by area, of spheres and
  /// tubes as in cslfRoundView.h. Within a sphere or a tube there is no sample: all rays find it.
  LightSample Sample(const glm::vec3& from, const glm::vec2& u) const;

  /// The density, per solid angle, with which Sample takes the direction of a ray that first meets
  /// the emitter, which must not be a point light, at a distance.
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
