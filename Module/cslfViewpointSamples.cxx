// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointSamples.h"

#include <vtkImageData.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cstring>

namespace cslf
{
ViewpointSamples::ViewpointSamples(vtkImageData* image)
{
  for (const ChannelId id : ChannelIds)
  {
    this->ArrayOf(id) = image->GetPointData()->GetArray(NameOf(id));
  }
}

ViewpointSamples ViewpointSamples::At(vtkIdType first) const
{
  ViewpointSamples samples = *this;
  samples.First = first;
  return samples;
}

bool ViewpointSamples::IsEmpty() const
{
  return std::all_of(this->Arrays.begin(), this->Arrays.end(),
    [](const vtkSmartPointer<vtkDataArray>& array) { return !array; });
}

void ViewpointSamples::AddTo(vtkImageData* image) const
{
  vtkPointData* data = image->GetPointData();
  for (const auto& array : this->Arrays)
  {
    if (array && data->GetScalars())
    {
      data->AddArray(array);
    }
    else if (array)
    {
      data->SetScalars(array);
    }
  }
}

void* ViewpointSamples::GetMemory(ChannelId id) const
{
  vtkDataArray* array = this->GetArray(id);
  return array ? array->GetVoidPointer(this->First * array->GetNumberOfComponents()) : nullptr;
}

void ViewpointSamples::CopyTo(const ViewpointSamples& target, std::size_t texels) const
{
  for (const ChannelId id : ChannelIds)
  {
    if (vtkDataArray* array = this->GetArray(id))
    {
      const int bytes = array->GetDataTypeSize() * array->GetNumberOfComponents();
      std::memcpy(target.GetMemory(id), this->GetMemory(id), texels * bytes);
    }
  }
}
}
