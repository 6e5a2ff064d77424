// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfRateControl.h"

#include "Quality/cslfDisplayCurve.h"
#include "Quality/cslfTexelChoice.h"
#include "cslfJSONText.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>
#include <utility>

namespace cslf
{
namespace
{
constexpr int MinimumSample = 24;
constexpr int MaximumStride = 16;
}

GroupStages::GroupStages(int count)
  : Stages(count, 0)
{
  int stride = 1;
  while (2 * stride <= MaximumStride && 2 * stride * MinimumSample <= count)
  {
    stride *= 2;
  }
  // Where each stage ends, as a share of all groups. The last stages are small, so that few groups
  // depend on predictions only.
  std::vector<double> ends;
  for (int part = stride; part > 1; part /= 2)
  {
    ends.push_back(1.0 / part);
  }
  if (stride > 1)
  {
    ends.insert(ends.end(), { 0.75, 0.875, 0.9375 });
  }
  this->StageCount = static_cast<int>(ends.size()) + 1;
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [](int a, int b) { return RobertsNumber(a + 1, 0) < RobertsNumber(b + 1, 0); });
  for (int place = 0; place < count; ++place)
  {
    this->Stages[order[place]] = static_cast<int>(
      std::upper_bound(ends.begin(), ends.end(), place / static_cast<double>(count)) -
      ends.begin());
  }
}

std::vector<int> GroupStages::GetGroups(int stage) const
{
  std::vector<int> groups;
  for (std::size_t group = 0; group < this->Stages.size(); ++group)
  {
    if (this->Stages[group] == stage)
    {
      groups.push_back(static_cast<int>(group));
    }
  }
  return groups;
}

namespace
{
/// The rate factors of the first trials: most targets lie between them.
const std::vector<double> FirstFactors = { 20.0, 36.0 };

/// The largest distance of a level from a tried factor if no later stage can correct the error of
/// the curve between the trials.
constexpr double NearEnough = 1.0;

/// The relative tolerance of bytes, and that of squared errors: 0.3 dB.
constexpr double BytesTolerance = 0.03;
constexpr double ErrorTolerance = 0.07;

/// The largest difference between the levels of successive stages: small stages at the end must not
/// correct the errors of others by very different quality.
constexpr double MaximumChange = 3.0;

/// Sums and logarithms of costs up to this are finite.
constexpr double MaximumCost = 1e18;

/// Whether a run can have had that result.
bool IsSound(double factor, const GroupCost& cost)
{
  return factor >= MinimumFactor && factor <= MaximumFactor && cost.Bytes >= 0.0 &&
    cost.Bytes <= MaximumCost && cost.CoverageBytes >= 0.0 && cost.CoverageBytes <= MaximumCost &&
    std::abs(cost.SquaredError) <= MaximumCost;
}

double Sum(const std::vector<int>& numbers)
{
  return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

RateModel::Measures FindMeasure(const RateTarget& target)
{
  return target.Kind == RateTarget::Kinds::PSNR ? RateModel::Measures::SquaredError
                                                : RateModel::Measures::Bytes;
}
}

RateTarget MakeRateTarget(double ratio, double bytes, double psnr)
{
  using Kinds = RateTarget::Kinds;
  return ratio > 0.0 ? RateTarget{ Kinds::Ratio, ratio }
    : bytes > 0.0    ? RateTarget{ Kinds::Bytes, bytes }
    : psnr > 0.0     ? RateTarget{ Kinds::PSNR, psnr }
                     : RateTarget{};
}

std::string FindError(const RateTarget& target, bool isLossless)
{
  if (target.Kind == RateTarget::Kinds::Factor)
  {
    return {};
  }
  if (isLossless)
  {
    return "A lossless file has no target of ratio, size or PSNR.";
  }
  return target.Value > 0.0 && std::isfinite(target.Value)
    ? std::string()
    : "A target of ratio, size or PSNR must be a positive number.";
}

RateControl::RateControl(const RateTarget& target, RateField field)
  : Target(target)
  , Field(std::move(field))
  , Stages(static_cast<int>(this->Field.Frames.size()))
  , Model(FindMeasure(target), this->Field.Frames)
  , Factors(this->Field.Frames.size(), 0.0)
{
}

bool RateControl::Next(std::vector<CodingTask>& tasks, std::string& error)
{
  tasks.clear();
  if (this->Stage == this->Stages.GetStageCount())
  {
    return true;
  }
  if (this->Target.Kind == RateTarget::Kinds::Factor)
  {
    for (; this->Stage < this->Stages.GetStageCount(); ++this->Stage)
    {
      const std::vector<CodingTask> stage = this->MakeStage(this->Target.Value);
      tasks.insert(tasks.end(), stage.begin(), stage.end());
    }
    // In coding order, because there is nothing to learn on the way.
    std::sort(tasks.begin(), tasks.end(),
      [](const CodingTask& a, const CodingTask& b) { return a.Group < b.Group; });
    return true;
  }
  if (this->Trials.empty())
  {
    tasks = this->MakeTrials(FirstFactors);
    return true;
  }
  double level = this->Model.Solve(this->GetGoal());
  if (this->Stage == 0 && this->NeedsTrial(level))
  {
    tasks = this->MakeTrials({ std::round(level) });
    return true;
  }
  if (this->Stage == 0 && !this->IsReached(level))
  {
    error = this->DescribeReach(level);
    return false;
  }
  if (this->Stage > 0)
  {
    level = std::clamp(level, this->Level - MaximumChange, this->Level + MaximumChange);
  }
  this->Level = level;
  tasks = this->MakeStage(level);
  ++this->Stage;
  return true;
}

double RateControl::GetGoal() const
{
  const double raw = this->GetRawBytes();
  const double container = this->Field.GetContainerBytes(!this->Model.IsCoveredFully());
  switch (this->Target.Kind)
  {
    case RateTarget::Kinds::PSNR:
      return raw * MaximumLevel * MaximumLevel * std::pow(10.0, -0.1 * this->Target.Value);
    case RateTarget::Kinds::Ratio:
      return raw / this->Target.Value - container;
    default:
      return this->Target.Value - container;
  }
}

bool RateControl::NeedsTrial(double level) const
{
  const std::vector<double> tried = this->Model.GetTried();
  const bool isBetween = tried.front() <= level && level <= tried.back();
  const bool isNear = std::any_of(tried.begin(), tried.end(),
    [level](double factor) { return std::abs(factor - level) <= NearEnough; });
  return !isNear && !(isBetween && this->Stages.GetStageCount() > 1);
}

bool RateControl::IsReached(double level) const
{
  const double goal = this->GetGoal();
  const double tolerance =
    this->Target.Kind == RateTarget::Kinds::PSNR ? ErrorTolerance : BytesTolerance;
  // At the limits, fewer bytes or a smaller error will do.
  return (level > MinimumFactor && level < MaximumFactor) ||
    this->Model.Predict(level) <= (1.0 + tolerance) * goal;
}

std::string RateControl::DescribeReach(double level) const
{
  const double raw = this->GetRawBytes();
  const double found = this->Model.Predict(level);
  const double bytes = found + this->Field.GetContainerBytes(!this->Model.IsCoveredFully());
  std::ostringstream text;
  switch (this->Target.Kind)
  {
    case RateTarget::Kinds::PSNR:
      text << "a PSNR of " << this->Target.Value << " dB cannot be met: at a rate factor of "
           << level << " it is about " << PSNR(found / raw, MaximumLevel, MaximumPSNR) << " dB";
      break;
    case RateTarget::Kinds::Ratio:
      text << "a ratio of " << this->Target.Value << ":1 cannot be met: at a rate factor of "
           << level << " it is about " << raw / bytes << ":1";
      break;
    default:
      text << "a size of " << std::llround(this->Target.Value)
           << " bytes cannot be met: at a rate factor of " << level << " it is about "
           << std::llround(bytes) << " bytes";
      break;
  }
  return text.str();
}

std::vector<CodingTask> RateControl::MakeTrials(const std::vector<double>& factors) const
{
  std::vector<CodingTask> tasks;
  for (int group : this->Stages.GetGroups(0))
  {
    tasks.push_back({ group, true, factors });
  }
  return tasks;
}

std::vector<CodingTask> RateControl::MakeStage(double level)
{
  std::vector<CodingTask> tasks;
  for (int group : this->Stages.GetGroups(this->Stage))
  {
    this->Factors[group] =
      this->Target.Kind == RateTarget::Kinds::Factor ? level : RateModel::GetFactor(group, level);
    tasks.push_back({ group, false, { this->Factors[group] } });
  }
  return tasks;
}

void RateControl::AddTrial(int group, double factor, const GroupCost& cost)
{
  this->Trials.push_back({ group, factor, cost });
  this->Model.AddTrial(group, factor, cost);
}

void RateControl::AddCoded(int group, const GroupCost& cost)
{
  this->Model.AddCoded(group, this->Factors[group], cost);
  if (cost.SquaredError >= 0.0)
  {
    this->SquaredError += cost.SquaredError;
    this->MeasuredFrames += this->Field.Frames[group];
  }
}

std::string RateControl::GetTrials() const
{
  nlohmann::json json = nlohmann::json::array();
  for (const Trial& trial : this->Trials)
  {
    json.push_back({ trial.Group, trial.Factor, trial.Cost.Bytes, trial.Cost.CoverageBytes,
      trial.Cost.SquaredError, trial.Cost.CoveredFully });
  }
  return json.dump();
}

void RateControl::SetTrials(const std::string& text)
{
  std::vector<Trial> trials;
  try
  {
    for (const nlohmann::json& item : ParseJSON(text))
    {
      trials.push_back({ ToInteger(item.at(0)), item.at(1).get<double>(),
        { item.at(2).get<double>(), item.at(3).get<double>(), item.at(4).get<double>(),
          item.at(5).get<bool>() } });
    }
  }
  catch (const std::exception&)
  {
    return;
  }
  const std::vector<int> sample = this->Stages.GetGroups(0);
  std::set<double> factors;
  std::set<std::pair<int, double>> places;
  for (const Trial& trial : trials)
  {
    factors.insert(trial.Factor);
    places.insert({ trial.Group, trial.Factor });
  }
  const bool isWhole = factors.size() >= FirstFactors.size() && places.size() == trials.size() &&
    trials.size() == factors.size() * sample.size() &&
    std::all_of(trials.begin(), trials.end(),
      [&sample](const Trial& trial)
      {
        return std::binary_search(sample.begin(), sample.end(), trial.Group) &&
          IsSound(trial.Factor, trial.Cost);
      });
  for (const Trial& trial : isWhole ? trials : std::vector<Trial>())
  {
    this->AddTrial(trial.Group, trial.Factor, trial.Cost);
  }
}

int RateControl::GetExpectedTrials() const
{
  return this->Target.Kind == RateTarget::Kinds::Factor
    ? 0
    : static_cast<int>(FirstFactors.size() * this->Stages.GetGroups(0).size());
}

double RateControl::GetRawBytes() const
{
  return RawTexelBytes * this->Field.FieldTexels;
}

double RateControl::GetMeanFactor() const
{
  const double sum =
    std::inner_product(this->Factors.begin(), this->Factors.end(), this->Field.Frames.begin(), 0.0);
  return sum / Sum(this->Field.Frames);
}

double RateControl::GetPSNR() const
{
  const double values = RawTexelBytes * this->MeasuredFrames * this->Field.FrameTexels;
  return values > 0.0 ? PSNR(this->SquaredError / values, MaximumLevel, MaximumPSNR) : 0.0;
}
}
