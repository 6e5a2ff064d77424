// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The scale of displayed differences: sRGB for one exposure, and the most demanding exposure if a
// viewer may choose.
#include "Quality/cslfDisplayCurve.h"
#include "cslfColor.h"
#include "cslfTesting.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
/// The largest difference that any exposure of the range displays.
double GetShown(double a, double b, double exposure, double range)
{
  constexpr int steps = 256;
  double largest = 0.0;
  for (int i = 0; i <= steps; ++i)
  {
    const double factor = exposure * std::pow(range, 2.0 * i / steps - 1.0);
    largest =
      std::max(largest, std::abs(cslf::LinearToSRGB(factor * a) - cslf::LinearToSRGB(factor * b)));
  }
  return largest;
}

void TestOneExposure()
{
  const cslf::DisplayCurve curve(0.5);
  for (int i = 0; i < 1000; ++i)
  {
    const double radiance = 0.003 * i;
    CSLF_CHECK_NEAR(
      curve.Get(static_cast<float>(radiance)), cslf::LinearToSRGB(0.5 * radiance), 6e-4);
  }
  CSLF_CHECK(curve.Get(std::numeric_limits<float>::infinity()) == 1.0f);
  CSLF_CHECK(curve.Get(-1.0f) == 0.0f);
}

void TestRange()
{
  const double exposure = 2.0;
  const double range = cslf::DisplayCurve::FloatRange;
  const cslf::DisplayCurve curve(exposure, range);
  const auto measure = [&curve](double a, double b)
  { return std::abs(curve.Get(static_cast<float>(a)) - curve.Get(static_cast<float>(b))); };
  for (int i = 0; i < 60; ++i)
  {
    const double a = 1e-5 * std::pow(1.3, i);
    for (int j = 0; j < 60; ++j)
    {
      const double b = 1e-5 * std::pow(1.3, j);
      // Both positions may be inexact.
      CSLF_CHECK(measure(a, b) >= GetShown(a, b, exposure, range) - 1.2e-3);
    }
    const double near = 1.01 * a;
    CSLF_CHECK(measure(a, near) <= 1.05 * GetShown(a, near, exposure, range) + 1e-5);
  }
  // Values clipped at the darkest exposure look the same at all exposures.
  CSLF_CHECK(measure(range / exposure, 100.0) < 1e-5);
  CSLF_CHECK(measure(0.9 * range / exposure, 100.0) > 0.01);
}
}

int TestCSLFDisplayCurve(int, char*[])
{
  TestOneExposure();
  TestRange();
  return cslf::testing::Result();
}
