// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The stages in which the groups of a field are coded if its size or quality is controlled. The
 * first is a sample of groups, evenly spread over the coding order and so over all faces and nested
 * grids. Later stages halve the gaps between groups, and use the results of earlier ones. The order
 * is not periodic, because the field's costs may be, by rows of viewpoints.
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

  /// The groups of a stage, ascending. Stage 0 is the sample: every n-th group, where n is a power
  /// of two from 1 to 16 for which there are at least 24, unless there are fewer groups.
  std::vector<int> GetGroups(int stage) const;

private:
  std::vector<int> Stages; ///< of each group
  int StageCount = 1;
};
}

#endif
