// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRateModel.h"

#include "Quality/cslfTexelChoice.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace cslf
{
namespace
{
/// Halvings of the range of levels: far finer than the effect of one group.
constexpr int Halvings = 30;

/// The sum of the trials at any factor. Its logarithm is linear between and beyond the tried
/// factors.
double ReadCurve(const std::map<double, double>& sums, double factor)
{
  const auto exact = sums.find(factor);
  if (exact != sums.end())
  {
    return exact->second;
  }
  auto upper = sums.upper_bound(factor);
  upper = upper == sums.begin() ? std::next(upper) : upper;
  upper = upper == sums.end() ? std::prev(upper) : upper;
  const auto lower = std::prev(upper);
  const double share = (factor - lower->first) / (upper->first - lower->first);
  return std::exp((1.0 - share) * std::log(lower->second) + share * std::log(upper->second));
}
}

RateModel::RateModel(Measures measure, std::vector<int> frames)
  : Kind(measure)
  , Frames(std::move(frames))
  , Trials(this->Frames.size())
  , Done(this->Frames.size())
{
}

double RateModel::GetFactor(int group, double level)
{
  const double floor = std::floor(level);
  return std::min(MaximumFactor, floor + (RobertsNumber(group + 1, 1) < level - floor ? 1.0 : 0.0));
}

void RateModel::AddTrial(int group, double factor, const GroupCost& cost)
{
  this->Trials[group][factor] = cost;
  this->CoveredFully = this->CoveredFully && cost.CoveredFully;
}

void RateModel::AddCoded(int group, double factor, const GroupCost& cost)
{
  this->Done[group] = { factor, cost };
  this->CoveredFully = this->CoveredFully && cost.CoveredFully;
}

std::vector<double> RateModel::GetTried() const
{
  std::vector<double> factors;
  for (const auto& [factor, sum] : this->SumTrials())
  {
    factors.push_back(factor);
  }
  return factors;
}

double RateModel::Measure(const GroupCost& cost) const
{
  return this->Kind == Measures::SquaredError
    ? cost.SquaredError
    : cost.Bytes + (this->CoveredFully ? 0.0 : cost.CoverageBytes);
}

std::map<double, double> RateModel::SumTrials() const
{
  std::map<double, double> sums;
  for (const auto& costs : this->Trials)
  {
    for (const auto& [factor, cost] : costs)
    {
      sums[factor] += this->Measure(cost);
    }
  }
  for (auto& [factor, sum] : sums)
  {
    // Its logarithm is taken.
    sum = std::max(sum, 1.0);
  }
  return sums;
}

// The cost of each group's frames relative to the curve. It is known for groups that were coded or
// tried, and interpolated for the others along the coding order, where neighbours are similar.
std::vector<double> RateModel::FindWeights(const std::map<double, double>& sums, double near) const
{
  const int count = static_cast<int>(this->Frames.size());
  std::vector<double> weights(count, 0.0);
  int last = -1;
  for (int group = 0; group < count; ++group)
  {
    const auto& trials = this->Trials[group];
    if (const auto& done = this->Done[group])
    {
      weights[group] = this->Measure(done->Cost) / ReadCurve(sums, done->Factor);
    }
    else if (!trials.empty())
    {
      const auto nearest = std::min_element(trials.begin(), trials.end(),
        [near](const auto& a, const auto& b)
        { return std::abs(a.first - near) < std::abs(b.first - near); });
      weights[group] = this->Measure(nearest->second) / ReadCurve(sums, nearest->first);
    }
    else
    {
      continue;
    }
    weights[group] /= this->Frames[group];
    for (int between = last + 1; between < group; ++between)
    {
      const double share = last < 0 ? 1.0 : (between - last) / static_cast<double>(group - last);
      weights[between] = (1.0 - share) * weights[std::max(last, 0)] + share * weights[group];
    }
    last = group;
  }
  std::fill(weights.begin() + last + 1, weights.end(), last < 0 ? 0.0 : weights[last]);
  return weights;
}

double RateModel::Sum(
  const std::vector<double>& weights, const std::map<double, double>& sums, double level) const
{
  const double floor = std::floor(level);
  const double curve[2] = { ReadCurve(sums, floor), ReadCurve(sums, floor + 1.0) };
  double sum = 0.0;
  for (std::size_t group = 0; group < this->Frames.size(); ++group)
  {
    const double factor = RateModel::GetFactor(static_cast<int>(group), level);
    const auto trial = this->Trials[group].find(factor);
    sum += this->Done[group] ? this->Measure(this->Done[group]->Cost)
      : trial != this->Trials[group].end()
      ? this->Measure(trial->second)
      : weights[group] * this->Frames[group] * curve[factor > floor ? 1 : 0];
  }
  return sum;
}

double RateModel::Predict(double level) const
{
  const std::map<double, double> sums = this->SumTrials();
  return this->Sum(this->FindWeights(sums, level), sums, level);
}

double RateModel::Solve(double goal) const
{
  const std::map<double, double> sums = this->SumTrials();
  const bool falls = this->Kind == Measures::Bytes;
  double level = 0.5 * (MinimumFactor + MaximumFactor);
  // Groups that were only tried are weighted at the factor next to the solution, so this is done
  // again.
  for (int pass = 0; pass < 2; ++pass)
  {
    const std::vector<double> weights = this->FindWeights(sums, level);
    double low = MinimumFactor;
    double high = MaximumFactor;
    for (int k = 0; k < Halvings; ++k)
    {
      level = 0.5 * (low + high);
      ((this->Sum(weights, sums, level) > goal) == falls ? low : high) = level;
    }
    // One group changes its factor between them: take the nearer side.
    const double missLow = std::abs(this->Sum(weights, sums, low) - goal);
    const double missHigh = std::abs(this->Sum(weights, sums, high) - goal);
    level = missLow < missHigh ? low : high;
    if (MaximumFactor - level < 1e-3 || level - MinimumFactor < 1e-3)
    {
      level = std::round(level);
    }
  }
  return level;
}
}
