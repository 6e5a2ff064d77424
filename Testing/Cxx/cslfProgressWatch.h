// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Records the phases and the progress that a filter or writer reports, and asks it to stop.
 */
#ifndef cslfProgressWatch_h
#define cslfProgressWatch_h

#include "cslfTesting.h"

#include <vtkAlgorithm.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkVersionMacros.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

namespace cslf
{
namespace testing
{
class ProgressWatch
{
public:
  /// After an abort, these reports are those that are under way, of several levels of the work. VTK
  /// since 9.3 also reports the end of aborted filters: of the one that works, and of its consumer.
  static constexpr int MaximumReportsAfterAbort =
    VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0) ? 6 : 4;

  /// Asks the algorithm to stop at a report in that phase, counted from 1. An empty name is that of
  /// no phase.
  explicit ProgressWatch(vtkAlgorithm* algorithm, std::string last = {}, int report = 1)
    : Algorithm(algorithm)
    , Last(std::move(last))
    , Report(report)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback([](vtkObject*, unsigned long, void* self, void*)
      { static_cast<ProgressWatch*>(self)->Note(); });
    this->Observer = algorithm->AddObserver(vtkCommand::ProgressEvent, command);
  }
  ~ProgressWatch() { this->Algorithm->RemoveObserver(this->Observer); }
  ProgressWatch(const ProgressWatch&) = delete;
  ProgressWatch& operator=(const ProgressWatch&) = delete;

  /// The names of phases, in the order in which they were first reported.
  const std::vector<std::string>& GetPhases() const { return this->Phases; }

  /// Checks the order of the phases, and that the progress has risen from 0 to 1.
  void CheckWhole(const std::vector<std::string>& phases) const
  {
    for (std::size_t i = 0; i < std::max(phases.size(), this->Phases.size()); ++i)
    {
      const std::string expected = i < phases.size() ? phases[i] : "none";
      const std::string actual = i < this->Phases.size() ? this->Phases[i] : "none";
      if (actual != expected)
      {
        std::cerr << "Phase " << i << " is \"" << actual << "\", expected \"" << expected << "\"\n";
        CSLF_CHECK(actual == expected);
      }
    }
    CSLF_CHECK(std::is_sorted(this->Progress.begin(), this->Progress.end()));
    CSLF_CHECK(!this->Progress.empty() && this->Progress.front() == 0.0);
    CSLF_CHECK(!this->Progress.empty() && this->Progress.back() == 1.0);
    CSLF_CHECK(!this->Algorithm->GetProgressText());
  }

  /// Checks that the algorithm was asked to stop, and stopped soon. How often it reports is about
  /// ten times a second.
  void CheckAborted() const
  {
    if (this->ReportsAfterAbort < 0 || this->ReportsAfterAbort > MaximumReportsAfterAbort)
    {
      std::cerr << "In \"" << this->Last << "\": " << this->ReportsAfterAbort << " reports\n";
      CSLF_CHECK(false);
    }
  }

private:
  void Note()
  {
    const char* text = this->Algorithm->GetProgressText();
    const std::string phase = text ? text : "";
    if (text && std::find(this->Phases.begin(), this->Phases.end(), phase) == this->Phases.end())
    {
      this->Phases.push_back(phase);
    }
    this->Progress.push_back(this->Algorithm->GetProgress());
    if (this->ReportsAfterAbort >= 0)
    {
      ++this->ReportsAfterAbort;
    }
    else if (!this->Last.empty() && phase == this->Last && --this->Report == 0)
    {
      this->Algorithm->SetAbortExecute(1);
      this->ReportsAfterAbort = 0;
    }
  }

  vtkAlgorithm* Algorithm;
  std::string Last;
  int Report;
  unsigned long Observer = 0;
  std::vector<std::string> Phases;
  std::vector<double> Progress;
  int ReportsAfterAbort = -1; ///< -1 before
};
}
}

#endif
