// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/cslfPhase.h"

#include "Pipeline/cslfInterpreter.h"
#include "cslfVTKCompatibility.h"

#include <vtkAlgorithm.h>

#include <algorithm>

namespace cslf
{
Progress Within(const Progress& progress, double first, double last)
{
  return [progress, first, last](double share) { return progress(first + (last - first) * share); };
}

Progress OrAbort(const Progress& progress)
{
  return [progress](double share)
  {
    if (!progress(share))
    {
      throw Aborted();
    }
    return true;
  };
}

Phase::Phase(vtkAlgorithm* algorithm, const std::string& name, double last)
  : Algorithm(algorithm)
  , Name(name)
  , Shift(algorithm->GetProgressShift())
  , Scale(algorithm->GetProgressScale())
{
  if (const char* text = algorithm->GetProgressText())
  {
    this->NameAround = text;
  }
  if (this->Name.empty() && this->NameAround)
  {
    this->Name = *this->NameAround;
  }
  const double present =
    this->Scale > 0.0 ? (algorithm->GetProgress() - this->Shift) / this->Scale : 0.0;
  const double first = std::clamp(present, 0.0, last);
  algorithm->SetProgressShiftScale(this->Shift + this->Scale * first, this->Scale * (last - first));
  this->Report(0.0);
}

Phase::~Phase()
{
  this->Algorithm->SetProgressShiftScale(this->Shift, this->Scale);
  this->Algorithm->SetProgressText(this->NameAround ? this->NameAround->c_str() : nullptr);
}

bool Phase::Report(double share)
{
  return this->Report(nullptr, share);
}

bool Phase::ReportFor(vtkAlgorithm* filter, double share)
{
  return this->Report(filter->GetProgressText(), share);
}

bool Phase::Report(const char* name, double share)
{
  const WithLock lock; // the thread that reports may be one of those that compute
  const std::string text = name ? name : this->Name;
  this->Share = std::clamp(share, this->Share, 1.0);
  this->Algorithm->SetProgressText(text.empty() ? nullptr : text.c_str());
  this->Algorithm->UpdateProgress(this->Share);
  return !IsAborted(this->Algorithm);
}
}
