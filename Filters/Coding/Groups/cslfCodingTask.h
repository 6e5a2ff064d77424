// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * A part of the work of coding a field, and its cost.
 */
#ifndef cslfCodingTask_h
#define cslfCodingTask_h

#include "cslfGroupCodec.h"

#include <utility>
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

/// A group's part of each track.
using GroupParts = std::vector<CodedGroup>;

/// What came of a task.
struct CodingResult
{
  int Group = 0;
  std::vector<std::pair<double, GroupCost>> Trials; ///< the cost at each rate factor
  GroupParts Parts;                                 ///< of a group that is not only tried
};
}

#endif
