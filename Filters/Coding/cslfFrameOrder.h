// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The order in which viewpoints become video frames. A file states its order, so that no reader
 * depends on how it was chosen.
 */
#ifndef cslfFrameOrder_h
#define cslfFrameOrder_h

#include "vtkCSLFModule.h"

#include <vector>

namespace cslf
{
class Layout;

/// Slices `Start`, `Start + Step`, ...: `Count` of them.
struct SliceRun
{
  int Start = 0;
  int Step = 1;
  int Count = 1;
};

/// Every slice once, in coding order; the first `Coarsest` are the coarsest nested grid.
struct FrameOrder
{
  std::vector<int> Slices;
  std::vector<int> Groups; ///< the lengths of the groups of pictures that the order falls into
  int Coarsest = 0;
};

/// The indices, along one side, of the coarsest grid nested in one of `viewpoints` a side: the ends
/// and what divides them evenly while staying symmetric, the middle (odd) or the thirds (even).
VTKCSLF_EXPORT std::vector<int> CoarsestNodes(int viewpoints);

/// The frames of the coarsest nested grid, then the rest, each face by face in blocks of
/// neighbouring viewpoints, as nearly square as may be, along serpentine rows. A block is a group,
/// of at most `length` frames.
VTKCSLF_EXPORT FrameOrder MakeFrameOrder(const Layout& grid, int length);

/// The same slices as runs, and back. Expanding stops with an empty list when there would be other
/// than `count` slices or the result is no permutation of 0 to count - 1.
VTKCSLF_EXPORT std::vector<SliceRun> ToRuns(const std::vector<int>& slices);
VTKCSLF_EXPORT std::vector<int> FromRuns(const std::vector<SliceRun>& runs, int count);
}

#endif
