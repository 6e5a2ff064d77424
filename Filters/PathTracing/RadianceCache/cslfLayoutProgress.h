// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * The progress of work on all triangles of a scene that consists of many short loops, and its end
 * if the user aborts it.
 */
#ifndef cslfLayoutProgress_h
#define cslfLayoutProgress_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

namespace cslf
{
/// What LayoutProgress throws if the work shall end. RadianceCache catches it.
struct LayoutAborted
{
};

/// Copies count together.
class LayoutProgress
{
public:
  /// The steps between two reports: a few hundredths of a second of simple ones.
  static constexpr std::size_t StepsOfReport = std::size_t(1) << 15;

  /// Reports nothing, and never ends the work.
  LayoutProgress() = default;

  /// `goOn` gets numbers that rise from 0 towards 1. If it returns false, the work ends. About
  /// `expected` steps are enough for two thirds of the way: how often loops are repeated depends on
  /// the scene.
  LayoutProgress(std::function<bool(double)> goOn, double expected)
    : Counter(std::make_shared<State>())
  {
    this->Counter->GoOn = std::move(goOn);
    this->Counter->Expected = std::max(expected, 1.0);
  }

  /// Counts steps, of whatever loop. Reports depend on their number only, so ranks that do the same
  /// report together. Only the calling thread may count.
  void Step(std::size_t steps = 1) const
  {
    if (this->Counter && (this->Counter->Steps += steps) >= this->Counter->NextReport)
    {
      this->Counter->Report();
    }
  }

private:
  struct State
  {
    std::function<bool(double)> GoOn;
    double Expected = 1.0;
    std::size_t Steps = 0;
    std::size_t NextReport = StepsOfReport;

    void Report()
    {
      this->NextReport = this->Steps + StepsOfReport;
      if (!this->GoOn(1.0 - std::exp(-static_cast<double>(this->Steps) / this->Expected)))
      {
        throw LayoutAborted();
      }
    }
  };

  std::shared_ptr<State> Counter;
};
}

#endif
