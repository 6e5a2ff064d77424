// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Bounds of the positions and directions of emission of a group of lights.
 */
#ifndef cslfLightBounds_h
#define cslfLightBounds_h

#include <glm/vec3.hpp>

#include <limits>

namespace cslf
{
struct LightBounds
{
  /// How the directions of a group's light are bounded.
  enum class Kinds
  {
    AllAround, ///< not bounded
    Surfaces, ///< they are at up to 90 degrees from one of the normals of the cone, or its opposite
    Spots     ///< they are in the cone
  };

  glm::vec3 Lower{ std::numeric_limits<float>::max() };
  glm::vec3 Upper{ std::numeric_limits<float>::lowest() };
  double Power = 0.0; ///< irradiance on a surface that faces the light, times squared distance
  Kinds Kind = Kinds::AllAround;
  glm::vec3 Axis{ 0.0f, 0.0f, 1.0f }; ///< of the cone, of unit length
  double Angle = 0.0;                 ///< between the axis and the cone's surface, radians

  bool IsEmpty() const { return this->Power == 0.0; }
  glm::vec3 GetCenter() const { return 0.5f * (this->Lower + this->Upper); }
};

/// The union of the bounds of two groups; an empty one is ignored.
LightBounds Join(const LightBounds& a, const LightBounds& b);

/// The solid angle into which light is emitted, each direction weighted by the cosine to the
/// nearest normal.
double MeasureDirections(const LightBounds& bounds);
}

#endif
