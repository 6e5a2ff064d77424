// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The exposures at which a field's colours are compared as they are displayed.
 */
#ifndef cslfViewExposures_h
#define cslfViewExposures_h

#include "cslfDisplayCurve.h"

#include <vector>

namespace cslf
{
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
