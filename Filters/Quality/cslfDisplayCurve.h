// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The displayed brightness of radiance: the scale on which errors of light are measured; and how
 * errors of displayed colours are reported.
 */
#ifndef cslfDisplayCurve_h
#define cslfDisplayCurve_h

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cslf
{
/// The largest value of a byte, and the PSNR in dB that is reported for equal colours.
constexpr double MaximumLevel = 255.0;
constexpr double MaximumPSNR = 100.0;

/// 10 log10(peak^2 / meanSquare) in dB, at most `cap`: 20 log10(peak / d) for a constant
/// difference d.
inline double PSNR(double meanSquare, double peak, double cap)
{
  return meanSquare > 0.0 ? std::min(cap, 10.0 * std::log10(peak * peak / meanSquare)) : cap;
}

/**
 * Maps radiance to a scale on which 1 is the step from black to white of a display.
 *
 * With a range of 1 this is sRGB's transfer function (IEC 61966-2-1) of the exposed radiance,
 * clamped at white. With a range R, a viewer may show the radiance at any exposure from 1/R to R
 * times that one. Then a difference on this scale is at least the displayed difference at any of
 * these exposures, and small differences equal that of the most demanding exposure. Up to the white
 * of the brightest exposure, the scale is sRGB's function at that exposure. Beyond, differences are
 * most visible at the exposure that makes the radiance white. That exposure is inverse to the
 * radiance, so the scale is a logarithm there, with the slope of sRGB's function at white. From the
 * white of the darkest exposure on, the scale is constant.
 */
class DisplayCurve
{
public:
  ///@{
  /// The range of a channel of bytes, and of a floating-point channel.
  static constexpr double ByteRange = 1.0;
  static constexpr double FloatRange = 16.0;
  ///@}

  explicit DisplayCurve(double exposure = 1.0, double range = ByteRange)
    : Brightest(static_cast<float>(exposure * range))
    , White(static_cast<float>(range * range))
  {
  }

  /// The value of a component of radiance on the scale. Negative radiance counts as 0.
  float Get(float radiance) const
  {
    constexpr float slopeAtWhite = 1.055f / 2.4f;
    const float bright = this->Brightest * radiance;
    if (!(bright < 1.0f))
    {
      return 1.0f + slopeAtWhite * std::log(std::min(bright, this->White));
    }
    if (!(bright > 0.0031308f))
    {
      return 12.92f * std::max(bright, 0.0f);
    }
    // This least-squares fit of 1.055 x^(1/2.4) - 0.055 is several times as fast as a power. Its
    // error is below 0.0006, and that of its slope below 2.1 %.
    const float root = std::sqrt(bright);
    return 0.2920498f * std::sqrt(root) + 0.8402028f * root - 0.0567833f * bright - 0.0754708f;
  }

  glm::vec3 operator()(const glm::vec3& radiance) const
  {
    return { this->Get(radiance.x), this->Get(radiance.y), this->Get(radiance.z) };
  }

  /// The value on the scale of the radiance of a white surface times a base colour.
  glm::vec3 operator()(const glm::vec3& value, const glm::vec3& baseColor) const
  {
    return (*this)(value * baseColor);
  }

private:
  float Brightest; // the largest exposure
  float White;     // what is white at the smallest exposure, times the largest exposure
};

/// Factors of the exposure that a field was sampled with. A viewer may show floats at any exposure
/// of the range in which the sampler controls noise: its ends, and three in between. Bytes are
/// shown as they are.
inline std::vector<double> GetViewExposures(bool isFloat)
{
  return isFloat ? std::vector<double>{ 1.0 / DisplayCurve::FloatRange, 0.25, 1.0, 4.0,
    DisplayCurve::FloatRange }
                 : std::vector<double>{ 1.0 };
}
}

#endif
