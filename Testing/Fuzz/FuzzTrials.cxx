// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The stored trials of an unfinished file, and the coding of groups after they were read.
#include "Coding/RateControl/cslfRateControl.h"
#include "cslfFuzzing.h"

#include <cmath>

namespace
{
constexpr int Groups = 3;
constexpr double RawBytes = 1e5; // of a group
constexpr int MaximumSteps = 100;

/// A cost that halves in six factors, and an error that grows in proportion.
cslf::GroupCost MakeCost(double factor)
{
  const double share = std::exp2(-factor / 6.0);
  return { RawBytes * share, 10.0, 10.0 / share, false };
}

void Run(const cslf::RateTarget& target, const std::string& text)
{
  cslf::RateControl control(
    target, { std::vector<int>(Groups, 8), RawBytes / 24.0, [](bool) { return 500.0; } });
  control.SetTrials(text);
  const int known = control.GetTrialCount();
  cslf::fuzzing::Require(known % Groups == 0);
  std::vector<cslf::CodingTask> tasks;
  std::string error;
  int steps = 0;
  while (control.Next(tasks, error) && !tasks.empty())
  {
    cslf::fuzzing::Require(++steps <= MaximumSteps);
    for (const cslf::CodingTask& task : tasks)
    {
      cslf::fuzzing::Require(task.Group >= 0 && task.Group < Groups);
      for (const double factor : task.Factors)
      {
        cslf::fuzzing::Require(factor >= cslf::MinimumFactor && factor <= cslf::MaximumFactor);
        task.IsTrial ? control.AddTrial(task.Group, factor, MakeCost(factor))
                     : control.AddCoded(task.Group, MakeCost(factor));
      }
    }
  }
  cslf::fuzzing::Require(!tasks.empty() || !error.empty() || steps > 0);
  cslf::RateControl again(target, { std::vector<int>(Groups, 8), 1.0, [](bool) { return 0.0; } });
  again.SetTrials(control.GetTrials());
  cslf::fuzzing::Require(again.GetTrialCount() == control.GetTrialCount());
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char*>(data), size);
  Run({ cslf::RateTarget::Kinds::Ratio, 10.0 }, text);
  Run({ cslf::RateTarget::Kinds::PSNR, 40.0 }, text);
  return 0;
}
