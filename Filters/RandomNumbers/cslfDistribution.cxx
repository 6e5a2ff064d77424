// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfDistribution.h"

#include "cslfSampling.h"

#include <algorithm>
#include <cmath>

namespace cslf
{
namespace
{
std::size_t ToCell(float coordinate, std::size_t count)
{
  const float cell = std::floor(coordinate * static_cast<float>(count));
  return static_cast<std::size_t>(std::clamp(cell, 0.0f, static_cast<float>(count - 1)));
}
}

Distribution1D::Distribution1D(const std::vector<double>& weights)
  : Cumulative(weights.size())
{
  for (std::size_t i = 0; i < weights.size(); ++i)
  {
    this->Total += weights[i];
    this->Cumulative[i] = this->Total;
  }
  if (this->Total > 0.0)
  {
    for (double& value : this->Cumulative)
    {
      value /= this->Total;
    }
  }
}

DiscreteSample Distribution1D::Sample(float u) const
{
  const auto entry = std::upper_bound(this->Cumulative.begin(), this->Cumulative.end(), double(u));
  DiscreteSample sample;
  sample.Index = std::min<std::size_t>(entry - this->Cumulative.begin(), this->GetSize() - 1);
  const double lower = sample.Index > 0 ? this->Cumulative[sample.Index - 1] : 0.0;
  sample.Probability = this->GetProbability(sample.Index);
  sample.Remainder =
    std::clamp(static_cast<float>((u - lower) / sample.Probability), 0.0f, BelowOne);
  return sample;
}

float Distribution1D::GetProbability(std::size_t index) const
{
  const double lower = index > 0 ? this->Cumulative[index - 1] : 0.0;
  return static_cast<float>(this->Cumulative[index] - lower);
}

Distribution2D::Distribution2D(
  const std::vector<double>& weights, std::size_t width, std::size_t height)
{
  std::vector<double> rows(height);
  this->Columns.reserve(height);
  for (std::size_t row = 0; row < height; ++row)
  {
    const auto begin = weights.begin() + static_cast<std::ptrdiff_t>(row * width);
    this->Columns.emplace_back(
      std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(width)));
    rows[row] = this->Columns[row].GetTotal();
  }
  this->Rows = Distribution1D(rows);
}

glm::vec2 Distribution2D::Sample(const glm::vec2& u, float& pdf) const
{
  const DiscreteSample row = this->Rows.Sample(u.y);
  const Distribution1D& columns = this->Columns[row.Index];
  const DiscreteSample column = columns.Sample(u.x);
  const auto width = static_cast<float>(columns.GetSize());
  const auto height = static_cast<float>(this->Rows.GetSize());
  pdf = row.Probability * column.Probability * width * height;
  return { (static_cast<float>(column.Index) + column.Remainder) / width,
    (static_cast<float>(row.Index) + row.Remainder) / height };
}

float Distribution2D::GetPdf(const glm::vec2& point) const
{
  const std::size_t height = this->Rows.GetSize();
  const std::size_t row = ToCell(point.y, height);
  const Distribution1D& columns = this->Columns[row];
  const std::size_t width = columns.GetSize();
  return this->Rows.GetProbability(row) * columns.GetProbability(ToCell(point.x, width)) *
    static_cast<float>(width) * static_cast<float>(height);
}
}
