// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/cslfFieldDetail.h"

#include "cslfLayout.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cslf
{
namespace
{
// Both measured: see Documentation/Planning.md.
constexpr double TexelShare = 2.0;
constexpr double HiddenShare = 0.19;

constexpr double White = 255.0;

/// The squared error if 2 x 2 texels get their mean, over red, green and blue.
double SquareError(const ColorTexels& colors, std::size_t texel, std::size_t width)
{
  double sum = 0.0;
  for (int c = 0; c < 3; ++c)
  {
    const double values[4] = { colors.GetShown(texel, c), colors.GetShown(texel + 1, c),
      colors.GetShown(texel + width, c), colors.GetShown(texel + width + 1, c) };
    const double mean = 0.25 * (values[0] + values[1] + values[2] + values[3]);
    for (const double value : values)
    {
      sum += (value - mean) * (value - mean);
    }
  }
  return sum;
}
}

FieldDetail FindDetail(const std::vector<ViewpointSamples>& slices, int resolution)
{
  FieldDetail detail;
  detail.Resolution = resolution;
  const std::size_t width = static_cast<std::size_t>(TileCount) * resolution;
  const std::size_t squares = resolution / 2; // adjacent texels in a tile
  double sum = 0.0;
  std::size_t count = 0;
  std::vector<unsigned short> depths;
  for (const ViewpointSamples& slice : slices)
  {
    const ColorTexels colors(slice);
    const auto* depth = slice.Get<unsigned short>(KnownChannel::Depth);
    for (int y = 0; y + 1 < resolution; y += 2)
    {
      for (std::size_t i = 0; i < squares * TileCount; ++i)
      {
        const std::size_t texel = y * width + i / squares * resolution + 2 * (i % squares);
        sum += SquareError(colors, texel, width);
        count += 12;
        if (depth && colors.GetCoverage(texel) > 0)
        {
          depths.push_back(depth[texel]);
        }
      }
    }
  }
  detail.Error = count > 0 ? sum / (count * White * White) : 0.0;
  detail.DepthRange = depths.empty() ? 1.0 : 0.0;
  if (!depths.empty())
  {
    std::sort(depths.begin(), depths.end());
    const double last = static_cast<double>(depths.size() - 1);
    const auto at = [&](double part) { return double(depths[std::size_t(part * last)]); };
    detail.DepthRange = (at(0.9) - at(0.1)) / std::max(at(0.9) + at(0.1), 1.0);
  }
  return detail;
}

FieldDetail MergeDetails(std::vector<FieldDetail> details)
{
  std::sort(details.begin(), details.end(),
    [](const FieldDetail& a, const FieldDetail& b) { return a.Error > b.Error; });
  details.resize((details.size() + 3) / 4);
  FieldDetail merged;
  for (const FieldDetail& detail : details)
  {
    merged.Error += detail.Error / details.size();
    merged.DepthRange += detail.DepthRange / details.size();
    merged.Resolution = detail.Resolution;
  }
  return merged;
}

double PredictPSNR(const FieldDetail& detail, int viewpoints, int resolution)
{
  if (viewpoints < 2 || resolution < 1)
  {
    return 0.0;
  }
  const double texels = static_cast<double>(detail.Resolution) / resolution;
  const double spacing = 2.0 / (viewpoints - 1);
  const double error = detail.Error * detail.DepthRange * detail.DepthRange *
    (TexelShare * texels + HiddenShare * spacing * detail.Resolution);
  return error > 0.0 ? std::min(60.0, -10.0 * std::log10(error)) : 60.0;
}
}
