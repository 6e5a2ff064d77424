// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Warps of the unit square, and how two sampling strategies are combined.
 */
#ifndef cslfSampling_h
#define cslfSampling_h

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
constexpr float Pi = 3.14159265358979f;
constexpr float InversePi = 0.318309886183791f;

// The largest float below 1.
constexpr float BelowOne = 0x1.fffffep-1f;

/// The luminance of a linear colour with sRGB's primaries (Rec. 709).
inline float Luminance(const glm::vec3& color)
{
  return 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z;
}

/// Sine and cosine of an angle in turns, from 0 to 1, with the precision of floats, and without
/// branches, for loops over lanes.
inline void SinCosOfTurn(float turn, float& sine, float& cosine)
{
  // The series converge quickly within an eighth of a turn around each quarter.
  const int quarter = static_cast<int>(4.0f * turn + 0.5f);
  const float angle = 2.0f * Pi * (turn - 0.25f * static_cast<float>(quarter));
  const float square = angle * angle;
  const float s = angle *
    (1.0f +
      square *
        (-1.0f / 6 + square * (1.0f / 120 + square * (-1.0f / 5040 + square * (1.0f / 362880)))));
  const float c = 1.0f +
    square *
      (-1.0f / 2 +
        square *
          (1.0f / 24 +
            square * (-1.0f / 720 + square * (1.0f / 40320 + square * (-1.0f / 3628800)))));
  const bool odd = (quarter & 1) != 0;
  sine = static_cast<float>(1 - (quarter & 2)) * (odd ? c : s);
  cosine = static_cast<float>(1 - ((quarter + 1) & 2)) * (odd ? s : c);
}

/// A direction of the upper hemisphere with density cos(theta) / pi.
inline glm::vec3 SampleCosineHemisphere(const glm::vec2& u)
{
  const float radius = std::sqrt(u.x);
  float sine = 0.0f;
  float cosine = 0.0f;
  SinCosOfTurn(u.y, sine, cosine);
  return { radius * cosine, radius * sine, std::sqrt(1.0f - u.x) };
}

inline float CosineHemispherePdf(const glm::vec3& local)
{
  return std::max(0.0f, local.z) * InversePi;
}

/// The first two barycentric coordinates of a point uniform in a triangle, with little distortion
/// of the square: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
inline glm::vec2 SampleTriangle(const glm::vec2& u)
{
  if (u.y > u.x)
  {
    const float x = 0.5f * u.x;
    return { x, u.y - x };
  }
  const float y = 0.5f * u.y;
  return { u.x - y, y };
}

/// The weight of a sample with density `pdf` if another strategy would have density `otherPdf`: the
/// power heuristic of Veach and Guibas, SIGGRAPH 1995.
inline float PowerHeuristic(float pdf, float otherPdf)
{
  if (std::isinf(pdf))
  {
    return 1.0f;
  }
  const float ratio = otherPdf / pdf;
  return 1.0f / (1.0f + ratio * ratio);
}
}

#endif
