// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * What all lobes of a BSDF have in common. A lobe is a class with these members:
 *
 * - `static constexpr Lobes Kind`: Diffuse or Specular
 * - `static bool IsIn(const SurfaceMaterial&)`: whether a surface of a material may have it
 * - a constructor from `const SurfaceMaterial&`, `const MaterialPoint&`, the outgoing direction and
 *   `bool inside`
 * - `bool IsSmooth() const`: whether it scatters nothing: light goes in one or two directions
 * - `float GetImportance() const`: for sampling, about the albedo's luminance
 * - `glm::vec3 EvaluateCosine(const glm::vec3& incident) const`: the BSDF times the cosine
 * - `float Pdf(const glm::vec3& incident) const`: the density of Sample
 * - `bool Sample(float which, const glm::vec2& u, LobeSample&) const`: false if the path ends
 *
 * Directions are local: z is the shading normal on the outgoing direction's side, and all of them
 * point away from the surface. BSDF has the list of all lobes.
 */
#ifndef cslfLobe_h
#define cslfLobe_h

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "RandomNumbers/cslfSampling.h"

#include <cmath>

namespace cslf
{
/// Axes around a surface's normal.
struct Frame
{
  glm::vec3 X;
  glm::vec3 Y;
  glm::vec3 Z;

  /// An orthonormal frame around a unit vector. Duff et al., "Building an Orthonormal Basis,
  /// Revisited", JCGT 6(1), 2017.
  explicit Frame(const glm::vec3& normal)
    : Z(normal)
  {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    this->X = { 1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x };
    this->Y = { b, sign + normal.y * normal.y * a, -normal.y };
  }

  glm::vec3 ToLocal(const glm::vec3& world) const
  {
    return { glm::dot(world, this->X), glm::dot(world, this->Y), glm::dot(world, this->Z) };
  }

  glm::vec3 ToWorld(const glm::vec3& local) const
  {
    return local.x * this->X + local.y * this->Y + local.z * this->Z;
  }
};

/// The BSDF base / pi, times the cosine at the incident direction.
struct Lambert
{
  static float EvaluateCosine(const glm::vec3& incident)
  {
    return std::max(0.0f, incident.z) * InversePi;
  }
  static float Pdf(const glm::vec3& incident) { return CosineHemispherePdf(incident); }
  static glm::vec3 Sample(const glm::vec2& u) { return SampleCosineHemisphere(u); }
};

/// The parts of a BSDF that a function covers.
enum class Lobes
{
  All,
  Diffuse, ///< parts that look the same from all directions, except for a factor
  Specular ///< all others
};

/// An incident direction that a lobe chooses with its own density.
struct LobeSample
{
  glm::vec3 Direction{ 0.0f };
  bool IsSmooth = false;    ///< whether no other direction was possible
  glm::vec3 Weight{ 0.0f }; ///< if smooth: BSDF times cosine, over the probability
  float Compression = 1.0f; ///< the factor of radiance due to refraction
};
}

#endif
