// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Plots of measured curves.
 */
#ifndef cslfChart_h
#define cslfChart_h

#include <string>
#include <vector>

namespace cslf
{
namespace tool
{
/// Points joined by lines, in the order in which they are given. X is in bytes.
struct ChartCurve
{
  std::string Name;
  std::vector<double> X;
  std::vector<double> Y;
};

struct Chart
{
  std::string Title;
  std::string YTitle;
  std::vector<ChartCurve> Curves;
};

/// Draws a chart, its axis of bytes logarithmic, into a PNG. Throws a Failure.
void WriteChart(const std::string& fileName, const Chart& chart);
}
}

#endif
