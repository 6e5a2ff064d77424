// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How radiance is brought into the range that a display shows. The functions here and those of
 * cslfToneMapping.glsl have the same names and the same results.
 */
#ifndef cslfToneMapping_h
#define cslfToneMapping_h

#include "vtkCSLFModule.h"

#include <glm/vec3.hpp>

namespace cslf
{
/// What becomes of linear radiance before it is clamped to [0,1] and sRGB-encoded.
struct VTKCSLF_EXPORT ToneMapping
{
  /// What the radiance is multiplied by.
  double Exposure = 1.0;
  /// vtkCSLFMapper::ToneMappingType.
  int Curve = 0;

  /// Whether colours are shown as they are.
  bool IsIdentity() const { return this->Exposure == 1.0 && this->Curve == 0; }

  /// Linear radiance to linear display values, which are still to be clamped. Reinhard divides by
  /// one more than the luminance (Rec. 709), so that hues stay; ACES is K. Narkowicz's fit of the
  /// ACES reference rendering and output transforms for a display in sRGB (2015).
  glm::dvec3 MapTone(const glm::dvec3& radiance) const;
};
}

#endif
