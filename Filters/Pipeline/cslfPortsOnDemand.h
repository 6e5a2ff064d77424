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
#include <vtkInformationVector.h>

namespace cslf
{
/// Handles REQUEST_DATA_NOT_GENERATED: only the port that is asked for will be made. The other
/// port's output stays as it is.
inline void ChoosePorts(vtkInformation* request, vtkInformationVector* outputs)
{
  const int other = request->Get(vtkExecutive::FROM_OUTPUT_PORT()) == 1 ? 0 : 1;
  outputs->GetInformationObject(other)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
}

/// Whether a port's output is to be made, in REQUEST_DATA.
inline bool IsPortWanted(vtkInformationVector* outputs, int port)
{
  return outputs->GetInformationObject(port)->Get(vtkDemandDrivenPipeline::DATA_NOT_GENERATED()) ==
    0;
}
}

#endif
