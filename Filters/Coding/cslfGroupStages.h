// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * In which stages the groups of a field are coded where its size or quality is controlled: first a
 * sample of them, evenly spread over the coding order, so over all faces and nested grids; then
 * what lies between, in stages that halve the gaps. What is known of earlier stages steers later
 * ones.
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

  /// The sample is every so many-th group: a power of two from 1 to 16, such that there are at
  /// least 24 of them, unless there are fewer groups.
  int GetStride() const { return this->Stride; }

  int GetStageCount() const { return this->StageCount; }

  /// The stage of a group. Stage 0 is the sample.
  int GetStage(int group) const;

  /// The groups of a stage, ascending.
  std::vector<int> GetGroups(int stage) const;

private:
  int Count;
  int Stride = 1;
  int Levels = 0; ///< the stride's binary logarithm
  int StageCount = 1;
};
}

#endif
