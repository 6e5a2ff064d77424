// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/cslfPipelineWatch.h"

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
