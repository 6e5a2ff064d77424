// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "cslfFieldStream.h"

#include "Pipeline/cslfArrayLayout.h"

#include <vtkAlgorithm.h>
#include <vtkAlgorithmOutput.h>
#include <vtkDataArray.h>
#include <vtkExtentTranslator.h>
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
// How many slices a video is decoded ahead, if the reader keeps that many.
constexpr std::size_t SlicesAhead = 512;

/// What is the same at all times of a field.
std::string DescribeShape(Description field)
{
  field.SceneBounds.reset();
  field.Sampling = "{}";
  return field.ToText();
}
}

void SetFieldInformation(vtkInformation* information, const int wholeExtent[6])
{
  information->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), wholeExtent, 6);
  information->Set(vtkDataObject::SPACING(), 1.0, 1.0, 1.0);
  information->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  information->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkExtentTranslator::UPDATE_SPLIT_MODE()->Set(information, vtkExtentTranslator::Z_SLAB_MODE);
}

FieldStream::FieldStream(vtkAlgorithmOutput* connection)
  : Producer(connection->GetProducer())
  , Port(connection->GetIndex())
{
}

bool FieldStream::Fail(const std::string& error)
{
  this->Error = error;
  return false;
}

bool FieldStream::Open()
{
  auto* executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(this->Producer->GetExecutive());
  return executive && UpdateInformation(this->Producer->GetOutputPort(this->Port)) &&
    this->OpenUpdated();
}

bool FieldStream::OpenUpdated()
{
  this->Requests.emplace(this->Producer->GetOutputPort(this->Port));
  this->Information = this->Producer->GetOutputInformation(this->Port);
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  this->Information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  if (extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5])
  {
    return this->Fail("The input is empty.");
  }
  this->Store = BorrowStore(this->Information);
  this->Whole = { extent[4], extent[5] };
  const double texels = (extent[1] - extent[0] + 1.0) * (extent[3] - extent[2] + 1.0);
  const double fitting = std::max(1.0, SlabBytes / (TexelBytesEstimate * texels));
  const int forProgress = std::max(1, this->Whole.GetCount() / SlabCount);
  this->SlabSize = static_cast<int>(std::min<double>(fitting, forProgress));
  return true;
}

std::vector<Slab> FieldStream::PlanSlabs(const std::function<bool(int)>& isWanted) const
{
  std::vector<int> order;
  for (int slice = this->Whole.First; slice <= this->Whole.Last; ++slice)
  {
    if (isWanted(slice))
    {
      order.push_back(slice);
    }
  }
  if (this->Store)
  {
    this->Store->Sort(order);
  }
  std::vector<Slab> slabs;
  int previous = this->Whole.First;
  for (const int slice : order)
  {
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

void FieldStream::Announce(const std::vector<Slab>& slabs)
{
  this->Announced = slabs;
  this->Next = 0;
}

void FieldStream::ReadAhead(const Slab& slab)
{
  while (this->Next < this->Announced.size() && this->Announced[this->Next].First != slab.First)
  {
    ++this->Next;
  }
  std::vector<int> soon;
  for (std::size_t k = this->Next; k < this->Announced.size() && soon.size() < SlicesAhead; ++k)
  {
    for (int slice = this->Announced[k].First; slice <= this->Announced[k].Last; ++slice)
    {
      soon.push_back(slice);
    }
  }
  this->Store->Prefetch(soon);
}

bool FieldStream::Read(const Slab& slab, int time)
{
  if (this->Store && !this->Announced.empty())
  {
    this->ReadAhead(slab);
  }
  this->Error.clear();
  const auto failToDeliver = [this, &slab]
  {
    return this->Fail("The input did not deliver the viewpoints " + std::to_string(slab.First) +
      " to " + std::to_string(slab.Last) + ".");
  };
  if (!UpdateSlices(this->Information, slab.First, slab.Last))
  {
    return failToDeliver();
  }
  auto* image = vtkImageData::GetData(this->Information);
  std::string error;
  const auto field = Description::ReadFrom(image, error);
  if (!field)
  {
    return this->Fail(error);
  }
  const int* delivered = image->GetExtent();
  if (delivered[4] > slab.First || delivered[5] < slab.Last)
  {
    return failToDeliver();
  }
  const std::string text = field->ToText();
  const bool isSame =
    time == this->Time ? text == this->Text : DescribeShape(*field) == DescribeShape(this->Field);
  if (!this->Text.empty() && !isSame)
  {
    return this->Fail("The input's description changes between its parts.");
  }
  this->Image = ToAOS(image, slab.First, slab.Last);
  this->Field = *field;
  this->Text = text;
  this->Time = time;
  return true;
}

const unsigned char* FieldStream::GetSlice(const Channel& channel, int slice) const
{
  vtkDataArray* array = this->Image->GetPointData()->GetArray(channel.Name.c_str());
  const Layout& grid = this->Field.Grid;
  const std::int64_t texels = std::int64_t(grid.GetStripWidth()) * grid.GetResolution();
  const std::int64_t offset = (slice - this->Image->GetExtent()[4]) * texels;
  return static_cast<const unsigned char*>(array->GetVoidPointer(0)) +
    offset * channel.GetTexelBytes();
}
}
