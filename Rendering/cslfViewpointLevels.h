// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The nested grids of viewpoints for progressive display of a light field.
 */
#ifndef cslfViewpointLevels_h
#define cslfViewpointLevels_h

#include "vtkCSLFModule.h" // for export macro

#include <vector>

namespace cslf
{
/// Level 0 is the coarsest grid nested in a field's viewpoints, with which a coded file begins.
/// Each further level halves the intervals of the one before; the last has all viewpoints.
class VTKCSLF_EXPORT ViewpointLevels
{
public:
  ViewpointLevels() = default;

  /// For `viewpoints` viewpoints along each side of a face.
  explicit ViewpointLevels(int viewpoints);

  int GetCount() const { return static_cast<int>(this->Nodes.size()); }

  /// The indices of a level's viewpoints along a side, ascending, from the first to the last.
  const std::vector<int>& GetNodes(int level) const { return this->Nodes[level]; }

  /// The interval of a level that contains the finest level's interval from `index` to `index + 1`,
  /// by the index of its lower end in GetNodes.
  int FindInterval(int level, int index) const { return this->Intervals[level][index]; }

  /// The first level that a viewpoint belongs to.
  int LevelOf(int i, int j) const;

private:
  std::vector<std::vector<int>> Nodes;
  std::vector<std::vector<int>> Intervals;
  std::vector<int> Levels; ///< the first level of each index
};
}

#endif
