// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/cslfPipelineWatch.h"

#include "cslfVTKCompatibility.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>

#include <utility>

namespace cslf
{
PipelineWatch::PipelineWatch(vtkAlgorithmOutput* connection, std::function<bool()> act)
  : Act(std::move(act))
{
  if (connection)
  {
    this->Add(connection->GetProducer());
  }
}

PipelineWatch::~PipelineWatch()
{
  for (const auto& [algorithm, observer] : this->Observers)
  {
    algorithm->RemoveObserver(observer);
  }
}

void PipelineWatch::Add(vtkAlgorithm* algorithm)
{
  if (!algorithm || this->Observers.count(algorithm) > 0)
  {
    return;
  }
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(this);
  command->SetCallback(
    [](vtkObject* caller, unsigned long, void* self, void*)
    {
      // Filters may report from threads of their own.
      auto* watch = static_cast<PipelineWatch*>(self);
      if (std::this_thread::get_id() == watch->Thread && !watch->Act())
      {
        cslf::Abort(vtkAlgorithm::SafeDownCast(caller));
      }
    });
  this->Observers[algorithm] = algorithm->AddObserver(vtkCommand::ProgressEvent, command);
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
    {
      this->Add(algorithm->GetInputConnection(port, i)->GetProducer());
    }
  }
}
}
