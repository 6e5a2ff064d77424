// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCSLFResample.h"

#include "Options/cslfOptionTable.h"
#include "Pipeline/cslfFieldArrays.h"
#include "Pipeline/cslfFieldStream.h"
#include "Pipeline/cslfGuard.h"
#include "Pipeline/cslfParallelFor.h"
#include "Pipeline/cslfPhase.h"
#include "Pipeline/cslfRequests.h"
#include "Pipeline/cslfVTKCompatibility.h"
#include "Resampling/cslfKeyViews.h"
#include "Resampling/cslfTexelReducer.h"

#include <vtkDataArray.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkCSLFResample);
cslfGuardedRequestMacro(vtkCSLFResample);
cslfSetOptionMacro(vtkCSLFResample, ResolutionDivisor, ResolutionDivisor);
cslfSetOptionMacro(vtkCSLFResample, ViewpointStride, ViewpointStride);

vtkCSLFResample::vtkCSLFResample()
  : ResolutionDivisor(cslf::options::ResolutionDivisor.Default)
  , ViewpointStride(cslf::options::ViewpointStride.Default)
{
}

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

/// The bytes of a texel of float colour and depth.
constexpr double TexelBytesEstimate = 20.0;

/// The share of pulling in the progress.
constexpr double PullShare = 0.5;

int GetSlicesAtOnce(const int extent[6])
{
  const double texels = (extent[1] + 1.0) * (extent[3] + 1.0);
  return static_cast<int>(std::max(2.0, cslf::PulledBytes / (TexelBytesEstimate * texels)));
}
}

/// Fills the requested part of the output.
class vtkCSLFResample::Pass
{
public:
  Pass(vtkCSLFResample* self, const cslf::Nesting& nesting, vtkImageData* output)
    : Self(self)
    , Nesting(nesting)
    , Output(output)
    , Input(self->GetInputConnection(0, 0))
  {
    self->GetInputInformation(0, 0)->Get(Pipeline::WHOLE_EXTENT(), this->Whole);
  }

  /// False on failure, which it reports. An abort leaves the output empty.
  bool Run(const cslf::Slab& slices)
  {
    if (!this->Input.OpenUpdated())
    {
      return this->Fail(this->Input.GetError());
    }
    cslf::Phase phase(this->Self, "Resampling viewpoints");
    double done = 0.0;
    double next = 0.0;
    const cslf::PipelineWatch watch(this->Self->GetInputConnection(0, 0),
      [&](vtkAlgorithm* producer)
      {
        const double pulled = PullShare * producer->GetProgress();
        return phase.ReportFor(producer, done + (next - done) * pulled);
      });
    for (int first = slices.First; first <= slices.Last;)
    {
      const int last = this->Nesting.FindEnd(first, slices.Last, GetSlicesAtOnce(this->Whole));
      done = static_cast<double>(first - slices.First) / slices.GetCount();
      next = (last + 1.0 - slices.First) / slices.GetCount();
      const bool isRead =
        this->Input.Read({ this->Nesting.ToInput(first), this->Nesting.ToInput(last) });
      if (cslf::IsAborted(this->Self))
      {
        this->Output->Initialize();
        return true;
      }
      if (!isRead)
      {
        return this->Fail(this->Input.GetError());
      }
      if (first == slices.First)
      {
        this->AllocateOutput(slices);
      }
      vtkImageData* input = this->Input.GetImage();
      const cslf::TexelReducer reducer(this->Input.GetDescription(), this->Self->ResolutionDivisor);
      const auto report = [&](double share)
      { return phase.Report(done + (next - done) * (PullShare + (1.0 - PullShare) * share)); };
      const bool isGoing = cslf::ParallelFor(first, last + 1, report,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (int slice = static_cast<int>(begin); slice < end; ++slice)
          {
            reducer.Reduce(input, this->Nesting.ToInput(slice), this->Output, slice);
          }
        });
      if (!isGoing)
      {
        this->Output->Initialize();
        return true;
      }
      this->NoteMissing(input, first, last);
      first = last + 1;
    }
    cslf::SetMissing(this->Missing, this->Output);
    return true;
  }

private:
  void NoteMissing(vtkImageData* input, int first, int last)
  {
    const std::vector<int> missing =
      cslf::GetMissing(input, this->Input.GetDescription().Grid.GetSlices());
    for (int slice = first; slice <= last; ++slice)
    {
      if (std::binary_search(missing.begin(), missing.end(), this->Nesting.ToInput(slice)))
      {
        this->Missing->InsertNextValue(slice);
      }
    }
  }

  bool Fail(const std::string& error)
  {
    vtkErrorWithObjectMacro(this->Self, << error);
    this->Output->Initialize();
    return false;
  }

  void AllocateOutput(const cslf::Slab& slices)
  {
    const cslf::Description coarse = this->Nesting.Apply(this->Input.GetDescription());
    cslf::AllocateSlices(coarse, slices.First, slices.Last, this->Output);
    coarse.WriteTo(this->Output->GetFieldData());
  }

  vtkCSLFResample* Self;
  const cslf::Nesting& Nesting;
  vtkImageData* Output;
  cslf::FieldStream Input;
  int Whole[6];
  vtkNew<vtkIdTypeArray> Missing; ///< slices of the output
};

int vtkCSLFResample::RequestInformation(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto nesting = this->MakeNesting(inputVector);
  if (!nesting)
  {
    return 0;
  }
  int extent[6];
  nesting->GetWholeExtent(extent);
  cslf::SetFieldInformation(outputVector->GetInformationObject(0), extent);
  return 1;
}

int vtkCSLFResample::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // VTK requests data even from filters that could not describe their output.
  const auto nesting = this->MakeNesting(inputVector);
  if (!nesting)
  {
    return 0;
  }
  // The slices pulled first.
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  int extent[6];
  inInfo->Get(Pipeline::WHOLE_EXTENT(), extent);
  int asked[6];
  outputVector->GetInformationObject(0)->Get(Pipeline::UPDATE_EXTENT(), asked);
  const int last = nesting->FindEnd(asked[4], asked[5], GetSlicesAtOnce(extent));
  extent[4] = nesting->ToInput(asked[4]);
  extent[5] = nesting->ToInput(last);
  cslf::RequestFirstPart(inInfo, extent);
  return 1;
}

int vtkCSLFResample::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto nesting = this->MakeNesting(inputVector);
  if (!nesting)
  {
    return 0;
  }
  vtkInformation* outInfo = outputVector->GetInformationObject(0);
  int asked[6];
  outInfo->Get(Pipeline::UPDATE_EXTENT(), asked);
  const cslf::KeptRequests requests(this->GetInputConnection(0, 0));
  Pass pass(this, *nesting, vtkImageData::GetData(outInfo));
  std::string problem;
  const bool isDone = cslf::Guard([&] { return pass.Run({ asked[4], asked[5] }); }, problem);
  if (!problem.empty())
  {
    vtkErrorMacro("Cannot resample: " << problem << ".");
    vtkImageData::GetData(outInfo)->Initialize();
  }
  return isDone ? 1 : 0;
}

std::optional<cslf::Nesting> vtkCSLFResample::MakeNesting(vtkInformationVector** inputVector)
{
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  inputVector[0]->GetInformationObject(0)->Get(Pipeline::WHOLE_EXTENT(), extent);
  const cslf::Nesting nesting(extent, this->ResolutionDivisor, this->ViewpointStride);
  const std::string fault = nesting.FindError();
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault);
    return std::nullopt;
  }
  return nesting;
}

void vtkCSLFResample::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ResolutionDivisor: " << this->ResolutionDivisor << "\n";
  os << indent << "ViewpointStride: " << this->ViewpointStride << "\n";
}
