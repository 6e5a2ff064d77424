// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How far the colours of a coded group are from those that were coded.
 */
#ifndef cslfGroupError_h
#define cslfGroupError_h

#include "Coding/cslfGroupCodec.h"

#include <string>
#include <vector>

namespace cslf
{
/// A coded group of a track.
struct TrackPart
{
  Track Kind;
  const CodedGroup* Part = nullptr;
};

/// Decodes colour, as readers do, and sums up the squared errors of red, green and blue over all
/// texels, in units of 1/255: what is seen over black, as colour has associated alpha. On failure
/// returns false and says why, in one line.
bool MeasureSquaredError(const TrackPart& color, const TrackPart& coverage, int resolution,
  const std::vector<ConstSlice>& slices, double& sum, std::string& error);
}

#endif
