// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Selects the points of a chart between which a point is interpolated. If cells are much longer
 * than wide, points are dense along the length and sparse across it.
 */
#ifndef cslfChartNeighbours_h
#define cslfChartNeighbours_h

namespace cslf
{
/// The points between which a point lies along one side of a chart.
struct ChartNeighbours
{
  int Low;
  int High;
  float Weight; // of the high one
};

/// Points along one side of a chart, `step` finest points apart. They must be at least half as far
/// apart as points along the other side, whose distance in steps is `ratio`. A cell has `cell`
/// finest points, and the whole side `last`.
inline ChartNeighbours FindChartNeighbours(int index, int step, int cell, int last, float ratio)
{
  for (; step < cell && ratio >= 2.0f; ratio *= 0.5f)
  {
    step *= 2;
  }
  if (ratio >= 2.0f && last == cell)
  {
    return { cell / 2, cell / 2, 0.0f };
  }
  const int low = index / step * step;
  return { low, low < index ? low + step : low, static_cast<float>(index - low) / step };
}
}

#endif
