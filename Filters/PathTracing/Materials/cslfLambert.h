// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Perfectly diffuse reflection.
 */
#ifndef cslfLambert_h
#define cslfLambert_h

#include "RandomNumbers/cslfSampling.h"

namespace cslf
{
/// The BSDF base / pi, times the cosine at the incident direction.
struct Lambert
{
  static float EvaluateCosine(const glm::vec3& incident)
  {
    return std::max(0.0f, incident.z) * InversePi;
  }
  static float Pdf(const glm::vec3& incident) { return CosineHemispherePdf(incident); }
  static glm::vec3 Sample(const glm::vec2& u) { return SampleCosineHemisphere(u); }
};
}

#endif
