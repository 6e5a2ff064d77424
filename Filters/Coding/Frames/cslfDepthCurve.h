// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The curve by which depth is coded: its steps grow with depth, so that the relative error of
 * coding is about the same for all depths. Lookups compare positions along a ray by inverse depth,
 * so an error that is harmless far away makes holes in near surfaces.
 */
#ifndef cslfDepthCurve_h
#define cslfDepthCurve_h

#include "vtkCSLFModule.h" // for export macro

#include <cstdint>
#include <vector>

namespace cslf
{
/// The curve's parameter, with t the depth in [0,1] and c the code in [0,1]:
/// c = ln(1 + mu t) / ln(1 + mu), the mu-law of ITU-T G.711.
constexpr int DepthMu = 40;

/// The code of each depth of 16 bits, in 10 or 12 bits.
const std::vector<std::uint16_t>& GetDepthCodes(int bits);

/// The depth of each code, for a curve with that parameter.
VTKCSLF_EXPORT std::vector<unsigned short> MakeCodedDepths(int bits, double mu);
}

#endif
