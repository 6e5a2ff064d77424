// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfViewpointSource.h"

#include "Pipeline/cslfArrayLayout.h"
#include "Pipeline/cslfMissingViewpoints.h"
#include "vtkCSLFDecoder.h"

#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>
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
    return this->Whole.At(
      static_cast<vtkIdType>(slice * this->GetDescription().Grid.GetStripTexels()));
  }

  void Sort(std::vector<int>&) override {}

private:
  const ViewpointSamples Whole;
};

std::vector<int> FindUnwritten(vtkCSLFDecoder* decoder)
{
  vtkNew<vtkIdTypeArray> viewpoints;
  decoder->GetUnwrittenViewpoints(viewpoints);
  const vtkIdType count = viewpoints->GetNumberOfValues();
  if (count > 0)
  {
    // Reports an error if they are not allowed to be missing.
    decoder->IsViewpointDamaged(viewpoints->GetValue(0));
  }
  return { viewpoints->GetPointer(0), viewpoints->GetPointer(count) };
}

class DecoderSource : public ViewpointSource
{
public:
  DecoderSource(const Description& field, vtkCSLFDecoder* decoder)
    : ViewpointSource(field, FindUnwritten(decoder))
    , Decoder(decoder)
    , Ranks(field.Grid.GetSlices())
  {
    vtkNew<vtkIdTypeArray> order;
    decoder->GetViewpointsInFileOrder(order);
    for (vtkIdType rank = 0; rank < order->GetNumberOfValues(); ++rank)
    {
      this->Ranks[order->GetValue(rank)] = static_cast<int>(rank);
    }
  }

  void Prefetch(const std::vector<int>& slices) override
  {
    vtkNew<vtkIdTypeArray> viewpoints;
    for (int slice : slices)
    {
      viewpoints->InsertNextValue(slice);
    }
    this->Decoder->Prefetch(viewpoints);
  }

  void Wait() override { this->Decoder->WaitForPrefetch(); }

  bool IsReady(int slice) override { return this->Decoder->IsViewpointReady(slice); }

  ViewpointSamples Get(int slice) override
  {
    vtkNew<vtkImageData> image;
    return this->Decoder->IsViewpointDamaged(slice) || !this->Decoder->GetViewpoint(slice, image)
      ? ViewpointSamples{}
      : ViewpointSamples(image);
  }

  void Sort(std::vector<int>& slices) override
  {
    std::sort(slices.begin(), slices.end(),
      [this](int a, int b) { return this->Ranks[a] < this->Ranks[b]; });
  }

private:
  const vtkSmartPointer<vtkCSLFDecoder> Decoder;
  std::vector<int> Ranks; ///< in the file
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

std::shared_ptr<ViewpointSource> MakeSource(const Description& field, vtkCSLFDecoder* decoder)
{
  return std::make_shared<DecoderSource>(field, decoder);
}
}
