// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointSource.h"

#include "Pipeline/cslfArrayLayout.h"
#include "cslfFieldArrays.h"

#include <vtkImageData.h>

#include <utility>

namespace cslf
{
namespace
{
class ImageSource : public ViewpointSource
{
public:
  ImageSource(const Description& field, vtkImageData* image)
    : ViewpointSource(field, cslf::GetMissing(image, field.Grid.GetSlices()))
    , Whole(ToAOS(image, image->GetExtent()[4], image->GetExtent()[5]))
  {
  }

  void Prefetch(const std::vector<int>&) override {}
  void Wait() override {}
  bool IsReady(int) override { return true; }

  ViewpointSamples Get(int slice) override
  {
    const auto texels = static_cast<vtkIdType>(this->GetDescription().Grid.GetStripTexels());
    for (const KnownChannel id : KnownChannels)
    {
      // Who made the arrays may have resized them since.
      vtkDataArray* array = this->Whole.GetArray(id);
      if (array && array->GetNumberOfTuples() < (slice + 1) * texels)
      {
        return {};
      }
    }
    return this->Whole.At(slice * texels);
  }

  void Sort(std::vector<int>&) override {}

private:
  const ViewpointSamples Whole;
};
}

ViewpointSource::ViewpointSource(const Description& field, std::vector<int> missing)
  : Field(field)
  , Missing(std::move(missing))
{
}

ViewpointSource::~ViewpointSource() = default;

std::shared_ptr<ViewpointSource> MakeSource(const Description& field, vtkImageData* image)
{
  return std::make_shared<ImageSource>(field, image);
}
}
