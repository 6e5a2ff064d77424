// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "Pipeline/cslfScenePipeline.h"

#include <vtkInformation.h>
#include <vtkObjectFactory.h>

namespace cslf
{
vtkStandardNewMacro(ScenePipeline);

bool ScenePipeline::Gathers() const
{
  return this->Algorithm && this->MustGather && this->MustGather();
}

void ScenePipeline::EndUpdate(bool isDone)
{
  if (!isDone && !this->HasGathered)
  {
    this->HasGathered = true;
    this->GatherAsFailed();
  }
}

vtkTypeBool ScenePipeline::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const bool isData = request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()) != 0;
  const bool isInformation = request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()) != 0;
  const bool isExtent =
    request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()) != 0;
  if (!this->Gathers() || !(isData || isInformation || isExtent))
  {
    return this->Superclass::ProcessRequest(request, inputs, outputs);
  }
  if (isData)
  {
    this->HasGathered = false;
    const vtkTypeBool done =
      this->IsBroken ? 0 : this->Superclass::ProcessRequest(request, inputs, outputs);
    this->EndUpdate(done != 0);
    return done;
  }
  // The caller must continue to the data request, where the other ranks are.
  const bool isBroken = this->IsBroken && isExtent;
  this->IsBroken = isBroken || !this->Superclass::ProcessRequest(request, inputs, outputs);
  return 1;
}

int ScenePipeline::UpdateInformation()
{
  return this->Superclass::UpdateInformation() && !this->IsBroken;
}

vtkTypeBool ScenePipeline::Update(int port, vtkInformationVector* requests)
{
  this->HasGathered = false;
  const vtkTypeBool done = this->Superclass::Update(port, requests);
  if (this->Gathers())
  {
    this->EndUpdate(done != 0);
  }
  return done;
}
}
