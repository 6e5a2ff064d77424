// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfGatherField.h"

#include "Parallel/cslfRanks.h"
#include "Pipeline/cslfGuard.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <limits>
#include <utility>
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

/// The viewpoints that are missing between the parts, or nothing.
std::string FindGap(const std::vector<vtkSmartPointer<vtkImageData>>& parts)
{
  std::vector<std::pair<int, int>> ranges;
  ranges.reserve(parts.size());
  for (vtkImageData* part : parts)
  {
    ranges.emplace_back(part->GetExtent()[4], part->GetExtent()[5]);
  }
  std::sort(ranges.begin(), ranges.end());
  for (std::size_t i = 1; i < ranges.size(); ++i)
  {
    if (ranges[i].first > ranges[i - 1].second + 1)
    {
      return "No rank has the viewpoints " + std::to_string(ranges[i - 1].second + 1) + " to " +
        std::to_string(ranges[i].first - 1) + '.';
    }
    ranges[i].second = std::max(ranges[i].second, ranges[i - 1].second);
  }
  return {};
}

vtkSmartPointer<vtkImageData> JoinParts(const std::vector<vtkSmartPointer<vtkImageData>>& parts)
{
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

bool IsEmpty(vtkImageData* part)
{
  return !part || part->GetNumberOfPoints() == 0;
}

void SendPart(vtkImageData* part, vtkMultiProcessController* controller)
{
  int has = IsEmpty(part) ? 0 : 1;
  controller->Send(&has, 1, 0, SizeTag);
  if (has)
  {
    controller->Send(part, 0, PartTag);
  }
}

/// The parts of all ranks that are not empty.
std::vector<vtkSmartPointer<vtkImageData>> ReceiveParts(
  vtkImageData* own, vtkMultiProcessController* controller)
{
  std::vector<vtkSmartPointer<vtkImageData>> parts;
  if (!IsEmpty(own))
  {
    parts.emplace_back(own);
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
  return parts;
}
}

namespace cslf
{
vtkSmartPointer<vtkImageData> GatherField(
  vtkImageData* part, vtkMultiProcessController* controller, std::string& fault)
{
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return fault.empty() ? part : nullptr;
  }
  if (ShareError(controller, fault) >= 0)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkImageData> whole;
  if (controller->GetLocalProcessId() > 0)
  {
    SendPart(part, controller);
  }
  else
  {
    const std::vector<vtkSmartPointer<vtkImageData>> parts = ReceiveParts(part, controller);
    fault = FindGap(parts);
    std::string problem;
    Guard(
      [&]
      {
        whole = parts.empty() || !fault.empty() ? nullptr : JoinParts(parts);
        return true;
      },
      problem);
    // The other ranks wait for the outcome.
    fault = problem.empty() ? fault : "Its parts cannot be joined: " + problem + ".";
  }
  BroadcastText(controller, fault, 0);
  return whole;
}
}
