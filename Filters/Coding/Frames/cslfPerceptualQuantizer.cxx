// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfPerceptualQuantizer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

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

/// The code of a radiance is the number of codes whose least radiance it reaches. The search is
/// among numbers that begin with the same bits.
class CodeFinder
{
public:
  CodeFinder()
    : Starts(Buckets + 1)
  {
    for (int code = 1; code <= LargestPQCode; ++code)
    {
      this->Least.push_back(static_cast<float>(PQToRadiance((code - 0.5) / LargestPQCode)));
    }
    for (std::uint32_t bucket = 0; bucket <= Buckets; ++bucket)
    {
      const std::uint32_t bits = bucket << LowBits;
      float first;
      std::memcpy(&first, &bits, sizeof(first));
      const auto begin = this->Least.begin();
      this->Starts[bucket] =
        static_cast<int>(std::lower_bound(begin, this->Least.end(), first) - begin);
    }
  }

  /// Of a number above 0.
  int Find(float radiance) const
  {
    std::uint32_t bits;
    std::memcpy(&bits, &radiance, sizeof(bits));
    const std::uint32_t bucket = bits >> LowBits;
    if (bucket >= Buckets)
    {
      return LargestPQCode;
    }
    const auto begin = this->Least.begin();
    return static_cast<int>(
      std::upper_bound(begin + this->Starts[bucket], begin + this->Starts[bucket + 1], radiance) -
      begin);
  }

private:
  static constexpr int LowBits = 16;
  static constexpr std::uint32_t Buckets = 0x7f80; ///< up to infinity

  std::vector<float> Least;
  std::vector<int> Starts;
};
}

double RadianceToPQ(double radiance)
{
  // NaN becomes 0, too.
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

int RadianceToPQCode(float radiance)
{
  static const CodeFinder codes;
  // NaN becomes 0, too.
  return radiance > 0.0F ? codes.Find(radiance) : 0;
}

const std::vector<float>& GetCodedRadiances()
{
  static const std::vector<float> radiances = []
  {
    std::vector<float> all;
    for (int code = 0; code <= LargestPQCode; ++code)
    {
      all.push_back(static_cast<float>(PQToRadiance(code / static_cast<double>(LargestPQCode))));
    }
    return all;
  }();
  return radiances;
}
}
