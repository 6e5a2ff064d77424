// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Statistics of values. All functions need at least one value.
 */
#ifndef cslfStatistics_h
#define cslfStatistics_h

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace cslf::tool
{
inline double Mean(const std::vector<double>& values)
{
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline double Minimum(const std::vector<double>& values)
{
  return *std::min_element(values.begin(), values.end());
}

inline double Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 != 0 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}
}

#endif
