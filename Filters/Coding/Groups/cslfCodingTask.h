// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A part of the work of coding a field, and its cost.
 */
#ifndef cslfCodingTask_h
#define cslfCodingTask_h

#include <vector>

namespace cslf
{
/// The error of work that was asked to stop.
constexpr const char* Stopped = "it was stopped";

/// A group to be coded, once for each rate factor of colour.
struct CodingTask
{
  int Group = 0;
  bool IsTrial = false; ///< only the cost is needed
  std::vector<double> Factors;
};

/// The cost of a coded group, including its share of the container.
struct GroupCost
{
  double Bytes = 0.0; ///< of all tracks except coverage
  double CoverageBytes = 0.0;
  /// Of colour, summed over texels, red, green and blue, in units of 1/255; negative if not known.
  double SquaredError = -1.0;
  bool CoveredFully = true;
};
}

#endif
