// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFFieldWriter.h"

#include "cslfGatherField.h"

#include <vtkAlgorithmOutput.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkSmartPointer.h>

vtkStandardNewMacro(vtkCSLFFieldWriter);

//------------------------------------------------------------------------------
int vtkCSLFFieldWriter::Write()
{
  vtkMultiProcessController* controller = this->GetController();
  if (!controller || controller->GetNumberOfProcesses() < 2 ||
    this->GetNumberOfInputConnections(0) < 1)
  {
    return this->Superclass::Write();
  }
  this->GetInputAlgorithm()->UpdatePiece(
    controller->GetLocalProcessId(), controller->GetNumberOfProcesses(), 0);
  const vtkSmartPointer<vtkImageData> field = cslf::GatherField(this->GetInput(), controller);
  int outcome[2] = { 0, vtkErrorCode::NoError };
  if (controller->GetLocalProcessId() == 0)
  {
    outcome[0] = this->WriteAlone(field);
    outcome[1] = static_cast<int>(this->GetErrorCode());
  }
  controller->Broadcast(outcome, 2, 0);
  this->SetErrorCode(static_cast<unsigned long>(outcome[1]));
  return outcome[0];
}

//------------------------------------------------------------------------------
// Writes a field that is all here, without the other ranks.
int vtkCSLFFieldWriter::WriteAlone(vtkImageData* field)
{
  const vtkSmartPointer<vtkMultiProcessController> controller = this->GetController();
  const vtkSmartPointer<vtkAlgorithmOutput> connection = this->GetInputConnection(0, 0);
  this->SetController(nullptr);
  this->SetInputData(field);
  const int success = this->Superclass::Write();
  this->SetInputConnection(connection);
  this->SetController(controller);
  return success;
}
