// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldArrays.h"

#include <vtkImageData.h>
#include <vtkPointData.h>

#include <glm/common.hpp>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <new>
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

namespace
{
/// Arrays up to this size are always allocated.
constexpr double LittleBytes = 64.0 * 1024 * 1024;

/// For larger arrays, at least one of this many slices must exist.
constexpr double MaximumMissing = 64.0;
}

glm::vec4 GetColor(vtkDataArray* array, vtkIdType tuple)
{
  glm::dvec4 color;
  array->GetTuple(tuple, &color.x);
  return glm::vec4(color) / (array->GetDataType() == VTK_UNSIGNED_CHAR ? 255.0f : 1.0f);
}

void SetColor(vtkDataArray* array, vtkIdType tuple, const glm::vec4& color)
{
  glm::dvec4 stored(color);
  if (array->GetDataType() == VTK_UNSIGNED_CHAR)
  {
    stored = glm::round(255.0 * glm::clamp(stored, 0.0, 1.0));
  }
  array->SetTuple(tuple, &stored.x);
}

vtkSmartPointer<vtkDataArray> MakeArray(const Channel& channel, vtkIdType tuples)
{
  auto array = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(channel.Type));
  array->SetName(channel.Name.c_str());
  array->SetNumberOfComponents(channel.Components);
  const vtkIdType tupleBytes = vtkIdType(channel.Components) * array->GetDataTypeSize();
  const bool isCountable =
    tuples >= 0 && tuples <= std::numeric_limits<vtkIdType>::max() / tupleBytes;
  const vtkIdType values = isCountable ? tuples * channel.Components : 0;
  void* memory = isCountable ? std::malloc(std::max<std::size_t>(tuples * tupleBytes, 1)) : nullptr;
  if (!memory)
  {
    throw std::bad_alloc();
  }
  constexpr int keep = 0;
  array->SetVoidArray(memory, values, keep, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  return array;
}

ViewpointSamples MakeSamples(const Description& field, vtkIdType tuples)
{
  ViewpointSamples samples;
  for (const ChannelId id : ChannelIds)
  {
    if (const Channel* channel = field.FindChannel(id))
    {
      samples.SetArray(id, MakeArray(*channel, tuples));
    }
  }
  return samples;
}

std::vector<ViewpointSamples> CopySamples(
  const Description& field, const std::vector<ViewpointSamples>& samples)
{
  const std::size_t texels = field.Grid.GetStripTexels();
  const ViewpointSamples all = MakeSamples(field, static_cast<vtkIdType>(texels * samples.size()));
  std::vector<ViewpointSamples> copies;
  for (const ViewpointSamples& viewpoint : samples)
  {
    copies.push_back(all.At(static_cast<vtkIdType>(texels * copies.size())));
    viewpoint.CopyTo(copies.back(), texels);
  }
  return copies;
}

std::vector<ViewpointSamples> MakeBlankSamples(const Description& field, std::size_t count)
{
  const ViewpointSamples samples =
    MakeSamples(field, static_cast<vtkIdType>(field.Grid.GetStripTexels()));
  Clear(field, samples);
  return std::vector<ViewpointSamples>(count, samples);
}

void Clear(const Description& field, const ViewpointSamples& samples)
{
  const std::size_t texels = field.Grid.GetStripTexels();
  for (const ChannelId id : ChannelIds)
  {
    if (const Channel* channel = field.FindChannel(id))
    {
      FillEmpty(*channel, samples.GetMemory(id), texels);
    }
  }
}

void AllocateSlices(const Description& field, int first, int last, vtkImageData* image)
{
  int extent[6];
  field.Grid.GetWholeExtent(extent);
  extent[4] = first;
  extent[5] = last;
  image->SetExtent(extent);
  image->SetSpacing(1.0, 1.0, 1.0);
  image->SetOrigin(0.0, 0.0, 0.0);
  for (const Channel& channel : field.Channels)
  {
    image->GetPointData()->AddArray(MakeArray(channel, image->GetNumberOfPoints()));
  }
  if (!field.Channels.empty())
  {
    image->GetPointData()->SetActiveScalars(field.Channels.front().Name.c_str());
  }
}

bool AreEnough(const Description& field, vtkIdType there, vtkIdType count)
{
  const double sliceBytes = static_cast<double>(field.GetTexelBytes()) *
    field.Grid.GetStripWidth() * field.Grid.GetResolution();
  return sliceBytes * static_cast<double>(count) <= LittleBytes ||
    MaximumMissing * static_cast<double>(there) >= static_cast<double>(count);
}
}
