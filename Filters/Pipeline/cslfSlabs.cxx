// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfSlabs.h"

#include "Pipeline/cslfArrayLayout.h"

#include "vtkCSLFDecoder.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkDataArray.h>
#include <vtkExtentTranslator.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerRequestKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace cslf
{
namespace
{
// A slab's memory, estimated for texels of float colour and depth.
constexpr double SlabBytes = 64.0 * 1024 * 1024;
constexpr double TexelBytesEstimate = 20.0;
// The minimum number of slabs, if there are as many slices.
constexpr int SlabCount = 64;
// How many slices a video is decoded ahead, if the decoder keeps that many.
constexpr vtkIdType SlicesAhead = 512;
}

vtkSmartPointer<vtkImageData> PullSlices(
  vtkInformation* information, int first, int last, std::string& error)
{
  vtkImageData* image = vtkImageData::GetData(information);
  const auto holds = [&]()
  { return image && image->GetExtent()[4] <= first && image->GetExtent()[5] >= last; };
  if (!holds())
  {
    image = UpdateSlices(information, first, last) ? vtkImageData::GetData(information) : nullptr;
  }
  if (!holds())
  {
    error = "The input did not deliver the viewpoints " + std::to_string(first) + " to " +
      std::to_string(last) + ".";
    return nullptr;
  }
  return ToAOS(image, first, last);
}

void SplitAlongZ(vtkInformation* information)
{
  vtkExtentTranslator::UPDATE_SPLIT_MODE()->Set(information, vtkExtentTranslator::Z_SLAB_MODE);
}

void SetFieldInformation(vtkInformation* information, const int wholeExtent[6])
{
  information->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), wholeExtent, 6);
  information->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
  information->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  information->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  SplitAlongZ(information);
}

SlabStream::SlabStream(vtkAlgorithmOutput* connection)
  : Producer(connection->GetProducer())
  , Decoder(vtkCSLFDecoder::SafeDownCast(this->Producer))
  , Port(connection->GetIndex())
{
}

bool SlabStream::Fail(const std::string& error)
{
  this->Error = error;
  return false;
}

bool SlabStream::Open()
{
  auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(this->Producer->GetExecutive());
  if (!executive || !executive->UpdateInformation())
  {
    return false;
  }
  this->Requests.emplace(this->Producer->GetOutputPort(this->Port));
  int extent[6];
  executive->GetWholeExtent(this->Producer->GetOutputInformation(this->Port), extent);
  if (extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5])
  {
    return this->Fail("The input is empty.");
  }
  this->Whole = { extent[4], extent[5] };
  const double texels = (extent[1] - extent[0] + 1.0) * (extent[3] - extent[2] + 1.0);
  const double fitting = std::max(1.0, SlabBytes / (TexelBytesEstimate * texels));
  const int forProgress = std::max(1, this->Whole.GetCount() / SlabCount);
  this->SlabSize = static_cast<int>(std::min<double>(fitting, forProgress));
  return true;
}

Slab SlabStream::MakeSlab(int first) const
{
  return { first, std::min(this->Whole.Last, first + this->SlabSize - 1) };
}

std::vector<Slab> SlabStream::PlanSlabs(const std::function<bool(int)>& isWanted) const
{
  vtkNew<vtkIdTypeArray> order;
  if (this->Decoder)
  {
    this->Decoder->GetViewpointsInFileOrder(order);
  }
  for (int slice = this->Whole.First; !this->Decoder && slice <= this->Whole.Last; ++slice)
  {
    order->InsertNextValue(slice);
  }
  std::vector<Slab> slabs;
  int previous = this->Whole.First;
  for (vtkIdType k = 0; k < order->GetNumberOfValues(); ++k)
  {
    const int slice = static_cast<int>(order->GetValue(k));
    if (!isWanted(slice))
    {
      continue;
    }
    Slab* slab = slabs.empty() ? nullptr : &slabs.back();
    if (slab && slab->GetCount() < this->SlabSize && std::abs(slice - previous) == 1 &&
      (slice == slab->First - 1 || slice == slab->Last + 1))
    {
      slab->First = std::min(slab->First, slice);
      slab->Last = std::max(slab->Last, slice);
    }
    else
    {
      slabs.push_back({ slice, slice });
    }
    previous = slice;
  }
  return slabs;
}

void SlabStream::Announce(const std::vector<Slab>& slabs)
{
  this->Announced = slabs;
  this->Next = 0;
}

void SlabStream::ReadAhead(const Slab& slab)
{
  while (this->Next < this->Announced.size() && this->Announced[this->Next].First != slab.First)
  {
    ++this->Next;
  }
  vtkNew<vtkIdTypeArray> soon;
  for (std::size_t k = this->Next;
       k < this->Announced.size() && soon->GetNumberOfValues() < SlicesAhead; ++k)
  {
    for (int slice = this->Announced[k].First; slice <= this->Announced[k].Last; ++slice)
    {
      soon->InsertNextValue(slice);
    }
  }
  this->Decoder->Prefetch(soon);
}

bool SlabStream::Read(const Slab& slab)
{
  if (this->Decoder && !this->Announced.empty())
  {
    this->ReadAhead(slab);
  }
  if (!UpdateSlices(this->Producer->GetOutputInformation(this->Port), slab.First, slab.Last))
  {
    return false;
  }

  this->Image = vtkImageData::SafeDownCast(this->Producer->GetOutputDataObject(this->Port));
  std::string error;
  auto description = Description::ReadFrom(this->Image, error);
  if (!description)
  {
    return this->Fail(error);
  }
  const int* delivered = this->Image->GetExtent();
  if (delivered[4] > slab.First || delivered[5] < slab.Last)
  {
    return this->Fail("The input does not deliver the requested viewpoints.");
  }
  this->Image = ToAOS(this->Image, slab.First, slab.Last);
  if (this->HasDescription && description->ToText() != this->FieldDescription.ToText())
  {
    return this->Fail("The input's description changes between its parts.");
  }
  this->FieldDescription = *description;
  this->HasDescription = true;
  return true;
}

const unsigned char* SlabStream::GetSlice(const Channel& channel, int slice) const
{
  vtkDataArray* array = this->Image->GetPointData()->GetArray(channel.Name.c_str());
  const Layout& grid = this->FieldDescription.Grid;
  const std::int64_t texels = std::int64_t(grid.GetStripWidth()) * grid.GetResolution();
  const std::int64_t offset = (slice - this->Image->GetExtent()[4]) * texels;
  return static_cast<const unsigned char*>(array->GetVoidPointer(0)) +
    offset * channel.GetTexelBytes();
}
}
