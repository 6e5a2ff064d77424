// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How radiance becomes colour: sRGB's transfer function (IEC 61966-2-1) and associated alpha.
 */
#ifndef cslfColor_h
#define cslfColor_h

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace cslf
{
/// The bytes of a colour of 8 bits: red, green, blue and alpha.
constexpr int ColorBytes = 4;

/// The parts of linear sRGB's primaries in luminance (ITU-R BT.709).
constexpr glm::dvec3 LuminanceWeights(0.2126, 0.7152, 0.0722);

/// sRGB-encoded value in [0,1] to linear.
inline double SRGBToLinear(double encoded)
{
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// Linear value, clamped to [0,1], to sRGB-encoded.
inline double LinearToSRGB(double linear)
{
  const double clamped = std::clamp(linear, 0.0, 1.0);
  return clamped <= 0.0031308 ? 12.92 * clamped : 1.055 * std::pow(clamped, 1.0 / 2.4) - 0.055;
}

/// The same without an upper end, for what is brighter than white. The opposite of SRGBToLinear.
inline double EncodeLight(double linear)
{
  return linear > 1.0 ? 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055 : LinearToSRGB(linear);
}

inline glm::dvec3 SRGBToLinear(const glm::dvec3& encoded)
{
  return { SRGBToLinear(encoded.x), SRGBToLinear(encoded.y), SRGBToLinear(encoded.z) };
}

inline glm::dvec3 LinearToSRGB(const glm::dvec3& linear)
{
  return { LinearToSRGB(linear.x), LinearToSRGB(linear.y), LinearToSRGB(linear.z) };
}

/// A value in [0,1] to the nearest of 256 levels.
inline unsigned char ToByte(double value)
{
  return static_cast<unsigned char>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

/// Takes linear values to the nearest of 256 sRGB-encoded levels, by a table.
class ByteEncoder
{
public:
  ByteEncoder()
  {
    for (int level = 0; level <= 256; ++level)
    {
      this->Lower[level] = level < 256 ? SRGBToLinear((level - 0.5) / 255.0) : 2.0;
    }
    for (int step = 0; step <= Steps; ++step)
    {
      this->Levels[step] = ToByte(LinearToSRGB(static_cast<double>(step) / Steps));
    }
  }

  /// Values are clamped to [0,1].
  unsigned char Encode(double linear) const
  {
    const double clamped = linear > 0.0 ? std::min(linear, 1.0) : 0.0;
    // No step contains the beginnings of two levels.
    const int level = this->Levels[static_cast<int>(clamped * Steps)];
    return static_cast<unsigned char>(level + (clamped >= this->Lower[level + 1] ? 1 : 0));
  }

private:
  static constexpr int Steps = 4096;
  double Lower[257];               // the least value of each level
  unsigned char Levels[Steps + 1]; // the level of each step's least value
};

/// The red, green and blue of a texel before rounding, in [0,1]: `radiance` is linear, times
/// exposure, associated with `alpha` (its coverage). The mean of the samples that hit is encoded,
/// then multiplied by alpha.
inline glm::dvec3 EncodeRadiance(const glm::dvec3& radiance, double alpha)
{
  return alpha > 0.0 ? alpha * LinearToSRGB(radiance / alpha) : glm::dvec3(0.0);
}

/// The `Color` bytes of a texel, see EncodeRadiance.
inline void EncodeColor(const glm::dvec3& radiance, double alpha, unsigned char color[4])
{
  if (alpha == 1.0)
  {
    static const ByteEncoder encoder;
    color[0] = encoder.Encode(radiance.x);
    color[1] = encoder.Encode(radiance.y);
    color[2] = encoder.Encode(radiance.z);
    color[3] = 255;
    return;
  }
  const glm::dvec3 encoded = EncodeRadiance(radiance, alpha);
  color[0] = ToByte(encoded.x);
  color[1] = ToByte(encoded.y);
  color[2] = ToByte(encoded.z);
  color[3] = ToByte(alpha);
}
}

#endif
