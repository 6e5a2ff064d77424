// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Filters whose output ports are made separately: port 0 is the field, port 1 its geometry.
 */
#ifndef cslfPortsOnDemand_h
#define cslfPortsOnDemand_h

#include <vtkDemandDrivenPipeline.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationExecutivePortVectorKey.h>
#include <vtkInformationVector.h>

namespace cslf
{
/// Handles REQUEST_DATA_NOT_GENERATED. The port that is asked for will be made, and the geometry
/// also with the field if somebody will ask for it. Outputs of other ports stay as they are.
inline void ChoosePorts(vtkInformation* request, vtkInformationVector* outputs)
{
  const bool isForField = request->Get(vtkExecutive::FROM_OUTPUT_PORT()) != 1;
  vtkInformation* geometry = outputs->GetInformationObject(1);
  const bool isUsed = vtkExecutive::CONSUMERS()->Length(geometry) > 0;
  outputs->GetInformationObject(0)->Set(
    vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), isForField ? 0 : 1);
  geometry->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), isForField && !isUsed ? 1 : 0);
}

/// Whether a port's output is to be made, in REQUEST_DATA.
inline bool IsPortWanted(vtkInformationVector* outputs, int port)
{
  return outputs->GetInformationObject(port)->Get(vtkDemandDrivenPipeline::DATA_NOT_GENERATED()) ==
    0;
}
}

#endif
