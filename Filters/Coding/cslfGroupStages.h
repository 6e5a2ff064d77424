// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * In which stages the groups of a field are coded where its size or quality is controlled: first a
 * sample of them, evenly spread over the coding order, so over all faces and nested grids; then
 * what lies between, in stages that halve the gaps. What is known of earlier stages steers later
 * ones. The order has no period, as the field's costs may have one: a row of viewpoints.
 */
#ifndef cslfGroupStages_h
#define cslfGroupStages_h

#include "vtkCSLFModule.h"

#include <vector>

namespace cslf
{
class VTKCSLF_EXPORT GroupStages
{
public:
  /// For so many groups.
  explicit GroupStages(int count);

  int GetStageCount() const { return this->StageCount; }

  /// The groups of a stage, ascending. Stage 0 is the sample: one of so many groups, a power of two
  /// from 1 to 16, such that there are at least 24 of them, unless there are fewer groups.
  std::vector<int> GetGroups(int stage) const;

private:
  std::vector<int> Stages; ///< of each group
  int StageCount = 1;
};
}

#endif
