// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The local frame of a surface point, in which its normal is z.
 */
#ifndef cslfFrame_h
#define cslfFrame_h

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace cslf
{
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
}

#endif
