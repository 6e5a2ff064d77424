// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldSource.h"

#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>

namespace cslf
{
namespace testing
{
vtkStandardNewMacro(FieldSource);

int FieldSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  outputVector->GetInformationObject(0)->Set(
    vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Field->GetExtent(), 6);
  return 1;
}

int FieldSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  int extent[6];
  info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
  const int slices = extent[5] - extent[4] + 1;
  this->MaximumRequest = std::max(this->MaximumRequest, slices);
  this->Slices += slices;
  if (extent[4] <= this->FailingSlice && this->FailingSlice <= extent[5])
  {
    vtkErrorMacro("The source fails here.");
    return 0;
  }
  vtkImageData* output = vtkImageData::GetData(info);
  output->CopyStructure(this->Field);
  output->SetExtent(extent);
  vtkPointData* data = this->Field->GetPointData();
  output->GetPointData()->CopyAllocate(data);
  const int whole = this->Field->GetExtent()[5] + 1;
  const vtkIdType texels = this->Field->GetNumberOfPoints() / whole;
  output->GetPointData()->CopyData(data, 0, slices * texels, extent[4] * texels);
  output->GetFieldData()->ShallowCopy(this->Field->GetFieldData());
  return 1;
}

vtkSmartPointer<FieldSource> MakeSource(vtkImageData* field)
{
  auto source = vtkSmartPointer<FieldSource>::New();
  source->Field = field;
  return source;
}
}
}
