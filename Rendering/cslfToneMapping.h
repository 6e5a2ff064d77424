// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Maps radiance to the range of a display. The functions here and those of cslfToneMapping.glsl
 * have the same names and the same results.
 */
#ifndef cslfToneMapping_h
#define cslfToneMapping_h

#include "vtkCSLFModule.h"

#include <glm/vec3.hpp>

namespace cslf
{
/// The mapping of linear radiance before it is clamped to [0,1] and sRGB-encoded.
struct VTKCSLF_EXPORT ToneMapping
{
  /// The factor of the radiance.
  double Exposure = 1.0;
  /// vtkCSLFMapper::ToneMappingType.
  int Curve = 0;

  /// Whether colours are shown unchanged.
  bool IsIdentity() const { return this->Exposure == 1.0 && this->Curve == 0; }

  /// Maps linear radiance to linear display values, which are not clamped yet. Reinhard divides by
  /// 1 plus the luminance (Rec. 709), which preserves hues; ACES is K. Narkowicz's fit of the ACES
  /// reference rendering and output transforms for a display in sRGB (2015).
  glm::dvec3 MapTone(const glm::dvec3& radiance) const;
};
}

#endif
