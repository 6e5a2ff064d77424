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

namespace cslf::tool
{
/// Points joined by lines, in the given order.
struct ChartCurve
{
  std::string Name;
  std::vector<double> X;
  std::vector<double> Y;
};

/// The scale of the horizontal axis.
enum class ChartScale
{
  Bytes, ///< logarithmic
  Linear ///< from 0
};

struct Chart
{
  std::string Title;
  std::string XTitle;
  std::string YTitle;
  ChartScale Scale = ChartScale::Bytes;
  std::vector<ChartCurve> Curves;
};

/// Draws a chart into a PNG. Throws a Failure.
void WriteChart(const std::string& fileName, const Chart& chart);
}

#endif
