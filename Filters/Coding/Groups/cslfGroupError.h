// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The error of the colours of a coded group.
 */
#ifndef cslfGroupError_h
#define cslfGroupError_h

#include "cslfGroupCodec.h"

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

/// Decodes colour like readers do, and sums the squared errors of red, green and blue over all
/// texels, in units of 1/255. Colour has associated alpha, so this is the error over black. Without
/// a track of coverage, colour has no meaning where the slices have no coverage. On failure returns
/// false and gives the reason in one line.
bool MeasureSquaredError(const TrackPart& color, const TrackPart* coverage, int resolution,
  const std::vector<ViewpointSamples>& slices, double& sum, std::string& error);
}

#endif
