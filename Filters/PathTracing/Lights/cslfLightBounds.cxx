// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfLightBounds.h"

#include "RandomNumbers/cslfSampling.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
constexpr double DoublePi = 3.14159265358979323846;

// Added to a joint cone's angle, so that rounding excludes nothing.
constexpr double Slack = 1e-5;

/// The narrowest cone that contains both. If there is no such cone, one of all directions.
void JoinCones(const LightBounds& a, const LightBounds& b, LightBounds& joint)
{
  const bool isTwoSided = a.Kind == LightBounds::Kinds::Surfaces;
  const double limit = isTwoSided ? 0.5 * DoublePi : DoublePi;
  const float cosine = glm::dot(a.Axis, b.Axis);
  const glm::vec3 axis = isTwoSided && cosine < 0.0f ? -b.Axis : b.Axis;
  const double between = std::atan2(
    double(glm::length(glm::cross(a.Axis, axis))), double(isTwoSided ? std::abs(cosine) : cosine));
  joint.Kind = a.Kind;
  if (between + b.Angle <= a.Angle || between + a.Angle <= b.Angle)
  {
    const bool isFirst = a.Angle >= b.Angle;
    joint.Axis = isFirst ? a.Axis : axis;
    joint.Angle = isFirst ? a.Angle : b.Angle;
    return;
  }
  joint.Angle = 0.5 * (a.Angle + b.Angle + between) + Slack;
  if (joint.Angle >= limit || !(std::sin(between) > 1e-6))
  {
    joint.Kind = LightBounds::Kinds::AllAround;
    return;
  }
  const double turn = joint.Angle - Slack - a.Angle;
  joint.Axis = glm::normalize(static_cast<float>(std::sin(between - turn)) * a.Axis +
    static_cast<float>(std::sin(turn)) * axis);
}
}

LightBounds Join(const LightBounds& a, const LightBounds& b)
{
  if (a.IsEmpty() || b.IsEmpty())
  {
    return a.IsEmpty() ? b : a;
  }
  LightBounds joint;
  joint.Lower = glm::min(a.Lower, b.Lower);
  joint.Upper = glm::max(a.Upper, b.Upper);
  joint.Power = a.Power + b.Power;
  if (a.Kind == b.Kind && a.Kind != LightBounds::Kinds::AllAround)
  {
    JoinCones(a, b, joint);
  }
  return joint;
}

double MeasureDirections(const LightBounds& bounds)
{
  if (bounds.Kind == LightBounds::Kinds::AllAround)
  {
    return 4.0 * DoublePi;
  }
  const double angle = bounds.Angle;
  const double cone = 2.0 * DoublePi * (1.0 - std::cos(angle));
  if (bounds.Kind == LightBounds::Kinds::Spots)
  {
    return cone;
  }
  // Beyond the cone of normals, the cosine falls to 0 over a quarter of a turn.
  const double end = std::min(angle + 0.5 * DoublePi, DoublePi);
  return cone +
    0.5 * DoublePi *
    (2.0 * end * std::sin(angle) - std::cos(angle - 2.0 * end) - 2.0 * angle * std::sin(angle) +
      std::cos(angle));
}
}
