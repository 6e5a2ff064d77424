// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDepthCurve.h"

#include <cmath>

namespace cslf
{
namespace
{
constexpr int Depths = 65536;

std::vector<std::uint16_t> MakeCodes(int bits)
{
  const double most = (1 << bits) - 1;
  std::vector<std::uint16_t> codes;
  for (int depth = 0; depth < Depths; ++depth)
  {
    const double share = std::log1p(DepthMu * (depth / (Depths - 1.0))) / std::log1p(DepthMu);
    codes.push_back(static_cast<std::uint16_t>(std::lround(share * most)));
  }
  return codes;
}

}

std::vector<unsigned short> MakeCodedDepths(int bits, double mu)
{
  const double most = (1 << bits) - 1;
  std::vector<unsigned short> depths;
  for (int code = 0; code < 1 << bits; ++code)
  {
    const double depth = std::expm1(code / most * std::log1p(mu)) / mu;
    depths.push_back(static_cast<unsigned short>(std::lround(depth * (Depths - 1.0))));
  }
  return depths;
}

const std::vector<std::uint16_t>& GetDepthCodes(int bits)
{
  static const std::vector<std::uint16_t> fine = MakeCodes(12);
  static const std::vector<std::uint16_t> coarse = MakeCodes(10);
  return bits > 10 ? fine : coarse;
}
}
