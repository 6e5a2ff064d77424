// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Linear radiance as a signal that can be coded with few bits: the perceptual quantiser of SMPTE ST
 * 2084 (also in ITU-R BT.2100). A radiance of 1, which displays show as white, stands for 203
 * cd/m^2, the reference white of ITU-R BT.2408; the curve ends at 10000 cd/m^2.
 */
#ifndef cslfPerceptualQuantizer_h
#define cslfPerceptualQuantizer_h

#include "vtkCSLFModule.h"

#include <vector>

namespace cslf
{
/// The luminance of radiance 1, in cd/m^2.
constexpr double WhiteLuminance = 203.0;

/// The largest luminance that has a signal, in cd/m^2.
constexpr double PeakLuminance = 10000.0;

/// The largest radiance, about 49.26.
constexpr double MaximumRadiance = PeakLuminance / WhiteLuminance;

/// Radiance, clamped to [0,MaximumRadiance], to the signal, from 0 to 1.
VTKCSLF_EXPORT double RadianceToPQ(double radiance);

/// The signal, from 0 to 1, to radiance.
VTKCSLF_EXPORT double PQToRadiance(double signal);

/// Signals as codes of 16 bits.
constexpr int LargestPQCode = 65535;

/// The code nearest to the signal of a radiance, which may be any number or NaN.
VTKCSLF_EXPORT int RadianceToPQCode(float radiance);

/// The radiance of each code.
VTKCSLF_EXPORT const std::vector<float>& GetCodedRadiances();
}

#endif
