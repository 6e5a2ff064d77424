// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGatherField.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace
{
constexpr int SizeTag = 5170;
constexpr int PartTag = 5171;

/// The array of the viewpoints that a reader has left empty, see vtkCSLFDecoder.
constexpr const char* MissingName = "MissingViewpoints";

/// Lists the missing viewpoints of all parts.
void JoinMissing(const std::vector<vtkSmartPointer<vtkImageData>>& parts, vtkImageData* whole)
{
  vtkNew<vtkIdTypeArray> missing;
  missing->SetName(MissingName);
  for (vtkImageData* part : parts)
  {
    vtkDataArray* array = part->GetFieldData()->GetArray(MissingName);
    for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
    {
      const double slice = array->GetComponent(k, 0);
      if (slice >= 0.0 && slice <= std::numeric_limits<int>::max())
      {
        missing->InsertNextValue(static_cast<vtkIdType>(slice));
      }
    }
  }
  whole->GetFieldData()->RemoveArray(MissingName);
  if (missing->GetNumberOfValues() > 0)
  {
    whole->GetFieldData()->AddArray(missing);
  }
}

/// An image of the slices of all parts, without values yet.
vtkSmartPointer<vtkImageData> MakeWhole(const std::vector<vtkSmartPointer<vtkImageData>>& parts)
{
  auto whole = vtkSmartPointer<vtkImageData>::New();
  int extent[6];
  parts.front()->GetExtent(extent);
  for (vtkImageData* part : parts)
  {
    extent[4] = std::min(extent[4], part->GetExtent()[4]);
    extent[5] = std::max(extent[5], part->GetExtent()[5]);
  }
  whole->SetExtent(extent);
  whole->SetOrigin(parts.front()->GetOrigin());
  whole->SetSpacing(parts.front()->GetSpacing());
  whole->GetFieldData()->ShallowCopy(parts.front()->GetFieldData());
  whole->GetPointData()->CopyAllOn();
  whole->GetPointData()->CopyAllocate(parts.front()->GetPointData(), whole->GetNumberOfPoints());
  whole->GetPointData()->SetNumberOfTuples(whole->GetNumberOfPoints());
  return whole;
}
}

namespace cslf
{
vtkSmartPointer<vtkImageData> GatherField(vtkImageData* part, vtkMultiProcessController* controller)
{
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return part;
  }
  const bool empty = !part || part->GetNumberOfPoints() == 0;
  if (controller->GetLocalProcessId() > 0)
  {
    int has = empty ? 0 : 1;
    controller->Send(&has, 1, 0, SizeTag);
    if (!empty)
    {
      controller->Send(part, 0, PartTag);
    }
    return nullptr;
  }
  std::vector<vtkSmartPointer<vtkImageData>> parts;
  if (!empty)
  {
    parts.emplace_back(part);
  }
  for (int rank = 1; rank < controller->GetNumberOfProcesses(); ++rank)
  {
    int has = 0;
    controller->Receive(&has, 1, rank, SizeTag);
    if (has)
    {
      auto received = vtkSmartPointer<vtkImageData>::New();
      controller->Receive(received, rank, PartTag);
      parts.push_back(received);
    }
  }
  if (parts.empty())
  {
    return nullptr;
  }
  vtkSmartPointer<vtkImageData> whole = MakeWhole(parts);
  JoinMissing(parts, whole);
  for (vtkImageData* source : parts)
  {
    const vtkIdType slice = vtkIdType(whole->GetDimensions()[0]) * whole->GetDimensions()[1];
    const vtkIdType first = slice * (source->GetExtent()[4] - whole->GetExtent()[4]);
    whole->GetPointData()->CopyData(
      source->GetPointData(), first, source->GetNumberOfPoints(), vtkIdType(0));
  }
  return whole;
}
}
