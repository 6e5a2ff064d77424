// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The order in which viewpoints become video frames. Each file contains its order, so readers do
 * not depend on how it was chosen.
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
  std::vector<int> Groups; ///< the lengths of the groups of pictures in this order
  int Coarsest = 0;
};

/// The frames of the coarsest nested grid, then the rest. Both go face by face through blocks of
/// neighbouring viewpoints, which are nearly square, along serpentine rows. A block is a group of
/// at most `length` frames.
VTKCSLF_EXPORT FrameOrder MakeFrameOrder(const Layout& grid, int length);

/// The same slices as runs, and back. Expanding returns an empty list if the result is not a
/// permutation of 0 to count - 1.
VTKCSLF_EXPORT std::vector<SliceRun> ToRuns(const std::vector<int>& slices);
VTKCSLF_EXPORT std::vector<int> FromRuns(const std::vector<SliceRun>& runs, int count);
}

#endif
