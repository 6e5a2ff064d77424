// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * How good novel views of a field will be, and how large it gets, for other numbers of viewpoints
 * and texels. Documentation/Planning.md derives the formulas.
 */
#ifndef cslfFieldDetail_h
#define cslfFieldDetail_h

#include "Coding/cslfFrameConverter.h"

#include <vector>

namespace cslf
{
/// By what power of the viewpoints along a face's side the bytes of a video grow: measured. Nearer
/// viewpoints are predicted better from each other, so it is less than their number's.
constexpr double GrowthWithViewpoints = 1.8;

/// What viewpoints of a field show.
struct FieldDetail
{
  double Error = 0.0; ///< mean square of what half the resolution loses, in parts of 255 squared
  /// The difference of the depths' 10th and 90th percentiles, in parts of their sum; 1 if unknown.
  double DepthRange = 0.0;
  int Resolution = 0; ///< at which this was found
};

/// Finds the detail of some slices of a field: of squares of 2 x 2 texels, none of which crosses
/// tiles.
FieldDetail FindDetail(const std::vector<ConstSlice>& slices, int resolution);

/// That of what there is to look at: the most detailed quarter.
FieldDetail MergeDetails(std::vector<FieldDetail> details);

/// The PSNR of novel views in dB, of a field of M x M viewpoints a face, at least 2 x 2, and N x N
/// texels, at least one; 0 for other numbers.
double PredictPSNR(const FieldDetail& detail, int viewpoints, int resolution);
}

#endif
