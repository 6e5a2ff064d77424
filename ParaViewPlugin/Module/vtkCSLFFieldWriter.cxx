// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFFieldWriter.h"

#include "Pipeline/cslfGuard.h"
#include "cslfGatherField.h"
#include "cslfGeometryPort.h"

#include <vtkAlgorithmOutput.h>
#include <vtkErrorCode.h>
#include <vtkImageData.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

vtkStandardNewMacro(vtkCSLFFieldWriter);

//------------------------------------------------------------------------------
int vtkCSLFFieldWriter::Write()
{
  if (this->GetNumberOfInputConnections(0) < 1)
  {
    return this->Superclass::Write();
  }
  vtkMultiProcessController* controller = this->GetController();
  const int rank = controller ? controller->GetLocalProcessId() : 0;
  const int ranks = controller ? controller->GetNumberOfProcesses() : 1;
  const bool isUpdated = this->GetInputAlgorithm()->UpdatePiece(rank, ranks, 0) != 0;
  vtkPolyData* geometry = this->UpdateGeometry();
  std::string fault = isUpdated ? "" : "Its input has failed.";
  const vtkSmartPointer<vtkImageData> field =
    cslf::GatherField(this->GetInput(), controller, fault);
  if (!fault.empty())
  {
    vtkErrorMacro("The light field is not written. " << fault);
    this->SetErrorCode(vtkErrorCode::UnknownError);
    return 0;
  }
  int outcome[2] = { 0, vtkErrorCode::NoError };
  if (rank == 0)
  {
    // The other ranks wait for the outcome.
    outcome[0] = cslf::GuardMethod(
      this, "The light field was not written", [&] { return this->WriteAlone(field, geometry); });
    outcome[1] = static_cast<int>(this->GetErrorCode());
  }
  if (ranks > 1)
  {
    controller->Broadcast(outcome, 2, 0);
    this->SetErrorCode(static_cast<unsigned long>(outcome[1]));
  }
  return outcome[0];
}

//------------------------------------------------------------------------------
// The geometry of the input's producer, or null if it has none. All ranks call this, because they
// make it together.
vtkPolyData* vtkCSLFFieldWriter::UpdateGeometry()
{
  vtkAlgorithmOutput* port = cslf::FindGeometryPort(this->GetInputConnection(0, 0));
  if (!port)
  {
    return nullptr;
  }
  port->GetProducer()->Update(port->GetIndex());
  return vtkPolyData::SafeDownCast(port->GetProducer()->GetOutputDataObject(port->GetIndex()));
}

//------------------------------------------------------------------------------
// Writes a field that is complete here, without the other ranks.
int vtkCSLFFieldWriter::WriteAlone(vtkImageData* field, vtkPolyData* geometry)
{
  const vtkSmartPointer<vtkMultiProcessController> controller = this->GetController();
  const vtkSmartPointer<vtkAlgorithmOutput> connection = this->GetInputConnection(0, 0);
  this->SetController(nullptr);
  this->SetInputData(field);
  this->SetGeometryData(geometry);
  const int success = this->Superclass::Write();
  this->SetGeometryData(nullptr);
  this->SetInputConnection(connection);
  this->SetController(controller);
  return success;
}
