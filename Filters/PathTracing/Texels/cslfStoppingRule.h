// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Decides when a texel has enough samples.
 *
 * A mean is biased if the number of its samples depends on the samples themselves: if the first few
 * miss a small light, sampling would end, and if they find it, sampling would continue until the
 * light's share is right. So the samples of a texel never decide about that texel. They only decide
 * about the other texels of its square, whose random numbers are independent. But a texel that
 * shows the surface at its centre goes on while it has too few samples there: that depends on where
 * they lie, not on their radiance. (Kirk and Arvo,
 * "Unbiased Sampling Techniques for Image Synthesis", SIGGRAPH 1991, describe the bias, and a
 * remedy that discards the samples that decide.)
 */
#ifndef cslfStoppingRule_h
#define cslfStoppingRule_h

#include "vtkCSLFModule.h" // for export macro

#include "Quality/cslfDisplayCurve.h"
#include "cslfTexelSums.h"

#include <glm/vec3.hpp>

#include <limits>

namespace cslf
{
/// The range of the colours of some rays.
class VTKCSLF_EXPORT ColorBounds
{
public:
  /// Adds the rays that are inside: their colours, and whether they hit a surface.
  void Add(const PacketRadiance& radiance, const int covered[RayPacket::Size],
    const int inside[RayPacket::Size])
  {
    this->Add(radiance.Red, radiance.Green, radiance.Blue, covered, inside);
  }

  /// Adds the only samples of the texels inside.
  void Add(const TexelSums& sums, const int inside[RayPacket::Size]);

  /// Adds only whether the rays inside hit a surface.
  void AddCoverage(const int covered[RayPacket::Size], const int inside[RayPacket::Size]);

  /// The same of the only samples of the texels inside.
  void AddCoverage(const TexelSums& sums, const int inside[RayPacket::Size]);

  /// The largest difference of a component, in the units of the curve.
  float GetRange(const DisplayCurve& display) const;

  /// Whether some rays hit a surface and others miss.
  bool AreMixed() const { return this->SomeCovered && this->SomeEmpty; }

private:
  void Add(
    const float* red, const float* green, const float* blue, const int* covered, const int* inside);

  glm::vec3 Low{ std::numeric_limits<float>::max() };
  glm::vec3 High{ 0.0f };
  bool SomeCovered = false;
  bool SomeEmpty = false;
};

/// The mean variance of samples with traced paths, over many texels.
struct PathVariance
{
  glm::dvec3 Sum{ 0.0 };
  int Texels = 0;

  void Add(const PathVariance& other)
  {
    this->Sum += other.Sum;
    this->Texels += other.Texels;
  }

  /// The mean without some of the added values. 0 if there are no others.
  glm::vec3 GetMeanWithout(const PathVariance& some) const
  {
    const int texels = this->Texels - some.Texels;
    return texels > 0 ? glm::vec3((this->Sum - some.Sum) / double(texels)) : glm::vec3(0.0f);
  }
};

class VTKCSLF_EXPORT StoppingRule
{
public:
  /// The smallest number of samples from whose differences the noise is estimated.
  static constexpr int MinimumSamples = 4;

  /// The target is a standard error in the units of the curve.
  StoppingRule(const DisplayCurve& display, double target)
    : Display(display)
    , Target(static_cast<float>(target))
  {
  }

  /// Whether a single sample of each texel may suffice where rays see such colours.
  bool IsPlain(const ColorBounds& seen) const;

  /// Takes the means of the texels that have enough samples. With a single sample each, a texel
  /// has enough if all others of the square see what is expected.
  void TakeSingle(
    const ColorBounds& expected, const int inside[TexelSums::Size], TexelSums& sums) const;

  /// With more samples, a texel has enough if the standard error of all others' colours is at most
  /// the target. Samples whose colour does not count have no part in it. If an outline is expected,
  /// this must also hold for the coverage of a half-covered texel. The variance of traced paths
  /// elsewhere counts like one sample.
  void Take(const ColorBounds& expected, const glm::vec3& elsewhere,
    const int inside[TexelSums::Size], TexelSums& sums) const;

  /// The variance of the texels with traced paths.
  static PathVariance GetVariance(const TexelSums& sums);

private:
  /// `needs`: the texels because of which others go on. `lacks`: those that go on themselves.
  static void TakeByOthers(const bool needs[TexelSums::Size], const bool lacks[TexelSums::Size],
    const int inside[TexelSums::Size], TexelSums& sums);
  bool IsNoisyCoverage(float variance, int samples) const;
  bool IsNoisy(const TexelSums& sums, int texel, const glm::vec3& elsewhere) const;

  DisplayCurve Display;
  float Target;
};
}

#endif
