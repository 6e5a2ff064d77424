// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * Filters with two output ports: port 0 is the field, port 1 its geometry.
 */
#ifndef cslfPortsOnDemand_h
#define cslfPortsOnDemand_h

#include <vtkDemandDrivenPipeline.h>
#include <vtkExecutive.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerVectorKey.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>

namespace cslf
{
/// Whether the whole of an output is requested, as one piece.
inline bool IsWholeRequested(vtkInformation* output)
{
  const int* whole = output->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  const int* asked = output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT());
  return whole && asked && std::equal(whole, whole + 6, asked) &&
    output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()) <= 1;
}

/// Handles REQUEST_DATA_NOT_GENERATED. Whoever makes the whole field makes both ports, as VTK's
/// Update() does. A request for a part of it makes that part only, because consumers that stream
/// make many of them, and may not need the geometry. A request for the geometry makes no samples.
/// An output that is not made stays as it is.
inline void ChoosePorts(vtkInformation* request, vtkInformationVector* outputs, bool isWhole)
{
  vtkInformation* field = outputs->GetInformationObject(0);
  vtkInformation* geometry = outputs->GetInformationObject(1);
  if (request->Get(vtkExecutive::FROM_OUTPUT_PORT()) == 1)
  {
    field->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
  else if (!isWhole)
  {
    geometry->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

/// Whether a port's output is to be made, in REQUEST_DATA.
inline bool IsPortWanted(vtkInformationVector* outputs, int port)
{
  return outputs->GetInformationObject(port)->Get(vtkDemandDrivenPipeline::DATA_NOT_GENERATED()) ==
    0;
}

/// Tells the pipeline, in REQUEST_DATA, that a port's output was not made after all, so that the
/// next request makes it.
inline void SetNotMade(vtkInformationVector* outputs, int port)
{
  outputs->GetInformationObject(port)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
}
}

#endif
