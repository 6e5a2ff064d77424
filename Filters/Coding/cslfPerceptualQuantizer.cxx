// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Coding/cslfPerceptualQuantizer.h"

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
// The constants of SMPTE ST 2084, section 5.
constexpr double M1 = 2610.0 / 16384.0;
constexpr double M2 = 128.0 * 2523.0 / 4096.0;
constexpr double C1 = 3424.0 / 4096.0;
constexpr double C2 = 32.0 * 2413.0 / 4096.0;
constexpr double C3 = 32.0 * 2392.0 / 4096.0;
}

double RadianceToPQ(double radiance)
{
  // Not a number becomes 0, too.
  const double luminance = radiance > 0.0 ? std::min(radiance / MaximumRadiance, 1.0) : 0.0;
  const double power = std::pow(luminance, M1);
  return std::pow((C1 + C2 * power) / (1.0 + C3 * power), M2);
}

double PQToRadiance(double signal)
{
  const double power = std::pow(std::clamp(signal, 0.0, 1.0), 1.0 / M2);
  const double luminance = std::pow(std::max(power - C1, 0.0) / (C2 - C3 * power), 1.0 / M1);
  return MaximumRadiance * luminance;
}
}
