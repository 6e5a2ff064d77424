// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How well a field shows its scene: a measurement that a file carries in its description.
 */
#ifndef cslfCertificate_h
#define cslfCertificate_h

#include "vtkCSLFModule.h" // for export macro

#include "cslfJSONForward.h"

#include <optional>
#include <string>

namespace cslf
{
/// A comparison of a field with path tracing at random pixels of cameras outside the cube, each of
/// which is called a ray. Differences are those of red, green and blue as they are displayed: sRGB
/// over black, as fractions of white. Standard errors include the noise of the paths.
struct VTKCSLF_EXPORT Certificate
{
  int Rays = 0;
  int Samples = 0; ///< the paths of a ray
  int Seed = 0;

  double Mean = 0.0; ///< what the field shows minus what the scene shows
  double MeanError = 0.0;

  /// The mean squared difference, without the contribution of the paths' noise. So it may be
  /// negative where the noise is larger.
  double Square = 0.0;
  double SquareError = 0.0;

  double Seen = 0.0;   ///< the share of the rays that show or see a surface
  std::string Version; ///< of the CSLF that measured it
  std::string Scene;   ///< the hash of the scene that was traced

  /// The root mean square difference. A mean square that is below its standard error counts as
  /// that: it cannot be told apart from noise.
  double GetRMS() const;

  /// The peak signal-to-noise ratio of that in dB, at most 60.
  double GetPSNR() const;

  /// Whether another measurement traced the same paths.
  bool HasSameRays(const Certificate& other) const;

  /// Says in one line how a later measurement is clearly worse than this one. Empty if it is not.
  ///
  /// Worse is a mean square, or the square of a mean, that is larger by 1 dB and by more than
  /// chance explains. The difference of two measurements of other rays has the variances of both;
  /// it is worse from four standard errors on, because few rays cause most of the errors. The same
  /// rays would have exactly the same result, if their arithmetic were the same; one standard error
  /// of a single measurement is more than other processors and libraries change.
  std::string FindWorse(const Certificate& later) const;

  /// The certificate with as many digits as its JSON object has.
  Certificate Round() const;

  nlohmann::json ToJSON() const;

  /// Nothing if it is not what ToJSON wrote.
  static std::optional<Certificate> FromJSON(const nlohmann::json& json);

  /// In words, in one line.
  std::string Describe() const;
};
}

#endif
