// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The emissive triangles of a scene, sampled as one light.
 */
#ifndef cslfAreaLights_h
#define cslfAreaLights_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfDistribution.h"
#include "cslfLightSample.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace cslf
{
struct Mesh;

/// A triangle that emits light in all directions, from both sides.
struct EmissiveTriangle
{
  glm::vec3 Corner;
  glm::vec3 EdgeU;
  glm::vec3 EdgeV;
  float Importance;   ///< about its mean luminance
  const Mesh* Source; ///< tells the radiance of its points
  std::uint32_t Triangle;
  std::uint32_t Instance;
};

/// Triangles are chosen in proportion to their area and importance, points uniformly within.
class VTKCSLF_EXPORT AreaLights
{
public:
  AreaLights() = default;
  explicit AreaLights(std::vector<EmissiveTriangle> triangles);

  bool IsEmpty() const { return this->Triangles.empty(); }
  LightSample Sample(const glm::vec3& from, const glm::vec2& u) const;

  /// The density, per solid angle, with which Sample takes the point of a triangle of some
  /// importance at a distance along a ray that meets it at `cosine` to its normal.
  float Pdf(float importance, float distance, float cosine) const;

private:
  std::vector<EmissiveTriangle> Triangles;
  Distribution1D Choice;
};
}

#endif
