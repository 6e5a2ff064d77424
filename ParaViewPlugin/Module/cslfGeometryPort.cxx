// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGeometryPort.h"

#include "vtkCSLFDecoder.h"
#include "vtkCSLFGeometryFilter.h"
#include "vtkCSLFResample.h"
#include "vtkCSLFSampler.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkPVPostFilter.h>

namespace
{
/// Whether a filter's output has the surfaces of its input. ParaView connects a vtkPVPostFilter to
/// each port that it shows.
bool KeepsSurfaces(vtkAlgorithm* filter)
{
  return (vtkPVPostFilter::SafeDownCast(filter) || vtkCSLFResample::SafeDownCast(filter)) &&
    filter->GetNumberOfInputConnections(0) == 1;
}
}

namespace cslf
{
vtkAlgorithmOutput* FindGeometryPort(vtkAlgorithmOutput* field)
{
  while (field && KeepsSurfaces(field->GetProducer()))
  {
    field = field->GetProducer()->GetInputConnection(0, 0);
  }
  vtkAlgorithm* maker = field && field->GetIndex() == 0 ? field->GetProducer() : nullptr;
  const bool hasGeometry = vtkCSLFSampler::SafeDownCast(maker) ||
    vtkCSLFDecoder::SafeDownCast(maker) || vtkCSLFGeometryFilter::SafeDownCast(maker);
  return hasGeometry ? maker->GetOutputPort(1) : nullptr;
}
}
