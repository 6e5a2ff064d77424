// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The nested grids of viewpoints by which a light field is shown coarsely first.
 */
#ifndef cslfViewpointLevels_h
#define cslfViewpointLevels_h

#include "vtkCSLFModule.h" // for export macro

#include <vector>

namespace cslf
{
/// Level 0 is the coarsest grid nested in a field's viewpoints, which a coded file begins with.
/// Each further level halves the intervals of the one before; the last has all viewpoints.
class VTKCSLF_EXPORT ViewpointLevels
{
public:
  ViewpointLevels() = default;

  /// Of `viewpoints` viewpoints along each side of a face.
  explicit ViewpointLevels(int viewpoints);

  int GetCount() const { return static_cast<int>(this->Nodes.size()); }

  /// The indices of a level's viewpoints along a side, ascending, from the first to the last.
  const std::vector<int>& GetNodes(int level) const { return this->Nodes[level]; }

  /// The interval of a level, by the index in GetNodes of its lower end, that holds the finest
  /// level's interval from `index` to `index + 1`.
  int FindInterval(int level, int index) const { return this->Intervals[level][index]; }

  /// The first level that a viewpoint belongs to.
  int LevelOf(int i, int j) const;

private:
  std::vector<std::vector<int>> Nodes;
  std::vector<std::vector<int>> Intervals;
  std::vector<int> Levels; ///< the first of each index
};
}

#endif
