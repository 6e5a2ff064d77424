// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/cslfPhase.h"

#include "Pipeline/cslfInterpreter.h"
#include "cslfVTKCompatibility.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

#include <algorithm>
#include <utility>

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

namespace
{
void Find(vtkAlgorithm* algorithm, std::vector<vtkSmartPointer<vtkAlgorithm>>& found)
{
  if (!algorithm || std::find(found.begin(), found.end(), algorithm) != found.end())
  {
    return;
  }
  found.emplace_back(algorithm);
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
    {
      Find(algorithm->GetInputConnection(port, i)->GetProducer(), found);
    }
  }
}
}

std::vector<vtkSmartPointer<vtkAlgorithm>> FindProducers(vtkAlgorithmOutput* connection)
{
  std::vector<vtkSmartPointer<vtkAlgorithm>> found;
  Find(connection ? connection->GetProducer() : nullptr, found);
  return found;
}

std::vector<vtkSmartPointer<vtkAlgorithm>> FindInputs(vtkAlgorithm* filter)
{
  std::vector<vtkSmartPointer<vtkAlgorithm>> found;
  Find(filter, found);
  found.erase(found.begin());
  return found;
}

PipelineWatch::PipelineWatch(
  const std::vector<vtkSmartPointer<vtkAlgorithm>>& filters, std::function<bool(vtkAlgorithm*)> act)
  : Act(std::move(act))
{
  for (const auto& algorithm : filters)
  {
    this->Add(algorithm);
  }
}

PipelineWatch::PipelineWatch(vtkAlgorithmOutput* connection, std::function<bool(vtkAlgorithm*)> act)
  : PipelineWatch(FindProducers(connection), std::move(act))
{
}

PipelineWatch::~PipelineWatch()
{
  for (const auto& [algorithm, observer] : this->Observers)
  {
    algorithm->RemoveObserver(observer);
  }
  // Newer versions of VTK do not reset it before the next update.
  for (vtkAlgorithm* algorithm : this->Stopped)
  {
    ResetAbort(algorithm);
  }
}

void PipelineWatch::Add(vtkAlgorithm* algorithm)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void*)
    {
      // Filters may report progress from their own threads.
      auto* watch = static_cast<PipelineWatch*>(self);
      auto* algorithm = vtkAlgorithm::SafeDownCast(caller);
      if (std::this_thread::get_id() == watch->Thread && !watch->Act(algorithm))
      {
        cslf::Abort(algorithm);
        watch->Stopped.insert(algorithm);
      }
    });
  this->Observers[algorithm] = algorithm->AddObserver(vtkCommand::ProgressEvent, command);
}
}
