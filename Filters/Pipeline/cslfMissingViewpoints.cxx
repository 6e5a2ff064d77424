// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfMissingViewpoints.h"

#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <set>

namespace cslf
{
void SetMissing(vtkIdTypeArray* slices, vtkImageData* image)
{
  image->GetFieldData()->RemoveArray(MissingViewpointsName);
  if (slices->GetNumberOfValues() > 0)
  {
    vtkNew<vtkIdTypeArray> copy;
    copy->DeepCopy(slices);
    copy->SetName(MissingViewpointsName);
    image->GetFieldData()->AddArray(copy);
  }
}

std::vector<int> GetMissing(vtkImageData* image, int count)
{
  vtkDataArray* array = image->GetFieldData()->GetArray(MissingViewpointsName);
  std::set<int> slices;
  for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
  {
    const double slice = array->GetComponent(k, 0);
    if (slice >= 0.0 && slice < count)
    {
      slices.insert(static_cast<int>(slice));
    }
  }
  return { slices.begin(), slices.end() };
}
}
