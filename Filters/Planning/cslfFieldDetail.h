// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Predicts the quality of novel views of a field, and its size, for other numbers of viewpoints and
 * texels. Documentation/Planning.md derives the formulas.
 */
#ifndef cslfFieldDetail_h
#define cslfFieldDetail_h

#include "cslfViewpointSamples.h"

#include <vector>

namespace cslf
{
/// The measured exponent by which the bytes of a video grow with the viewpoints along a face's
/// side. It is less than that of the number of viewpoints, because denser viewpoints predict each
/// other better.
constexpr double GrowthWithViewpoints = 1.8;

/// The detail in viewpoints of a field.
struct FieldDetail
{
  double Error = 0.0; ///< mean square of what half the resolution loses, in units of 255 squared
  /// The difference of the depths' 10th and 90th percentiles, in parts of their sum; 1 if unknown.
  double DepthRange = 0.0;
  int Resolution = 0; ///< at which this was found
};

/// Measures the detail of some slices of a field, with squares of 2 x 2 texels within tiles.
FieldDetail FindDetail(const std::vector<ViewpointSamples>& slices, int resolution);

/// The detail of the relevant part: the most detailed quarter.
FieldDetail MergeDetails(std::vector<FieldDetail> details);

/// The PSNR of novel views in dB, for M x M viewpoints per face (at least 2 x 2) and N x N texels
/// (at least one); 0 for other numbers.
double PredictPSNR(const FieldDetail& detail, int viewpoints, int resolution);
}

#endif
