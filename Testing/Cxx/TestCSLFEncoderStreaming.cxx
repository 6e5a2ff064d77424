// SPDX-FileCopyrightText: Copyright (c) CSLF contributors
// SPDX-License-Identifier: BSD-3-Clause

// The encoder asks for bounded slabs, gives the same bytes for any number of threads, and stops
// when it is told to, leaving nothing behind.
#include "cslfCodecTesting.h"
#include "cslfTesting.h"
#include "vtkCSLFEncoder.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageAlgorithm.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>

namespace
{
/// Gives just the slices that are asked for, and counts them.
class FieldSource : public vtkImageAlgorithm
{
public:
  static FieldSource* New();
  vtkTypeMacro(FieldSource, vtkImageAlgorithm);

  vtkSmartPointer<vtkImageData> Field;
  int LargestRequest = 0;
  int Slices = 0;
  int FailingSlice = -1;

protected:
  FieldSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    outputVector->GetInformationObject(0)->Set(
      vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Field->GetExtent(), 6);
    return 1;
  }

  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    int extent[6];
    info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
    const int slices = extent[5] - extent[4] + 1;
    this->LargestRequest = std::max(this->LargestRequest, slices);
    this->Slices += slices;
    if (extent[4] <= this->FailingSlice && this->FailingSlice <= extent[5])
    {
      vtkErrorMacro("The source fails here.");
      return 0;
    }
    vtkImageData* output = vtkImageData::GetData(info);
    output->CopyStructure(this->Field);
    output->SetExtent(extent);
    vtkPointData* data = this->Field->GetPointData();
    output->GetPointData()->CopyAllocate(data);
    const int whole = this->Field->GetExtent()[5] + 1;
    const vtkIdType texels = this->Field->GetNumberOfPoints() / whole;
    output->GetPointData()->CopyData(data, 0, slices * texels, extent[4] * texels);
    output->GetFieldData()->ShallowCopy(this->Field->GetFieldData());
    return 1;
  }
};
vtkStandardNewMacro(FieldSource);

vtkSmartPointer<FieldSource> MakeSource(vtkImageData* field)
{
  auto source = vtkSmartPointer<FieldSource>::New();
  source->Field = field;
  return source;
}

void TestThreads(vtkImageData* field, const std::string& folder)
{
  for (int threads : { 1, 2 })
  {
    const auto source = MakeSource(field);
    vtkNew<vtkCSLFEncoder> encoder;
    encoder->SetInputConnection(source->GetOutputPort());
    encoder->SetPreset("ultrafast");
    const std::string fileName = folder + "/threads" + std::to_string(threads) + ".mkv";
    encoder->SetFileName(fileName.c_str());
    int written = 0;
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads }, [&]() { written = encoder->Write(); });
    CSLF_CHECK(written == 1);
    CSLF_CHECK(source->LargestRequest <= 32 * threads);
    CSLF_CHECK(source->Slices <= field->GetExtent()[5] + 2);
  }
  const auto one = cslf::testing::ReadBytes(folder + "/threads1.mkv");
  CSLF_CHECK(!one.empty() && one == cslf::testing::ReadBytes(folder + "/threads2.mkv"));
}

void TestAbort(vtkImageData* field, const std::string& folder)
{
  const std::string fileName = folder + "/aborted.mp4";
  cslf::testing::WriteBytes(fileName, { 'o', 'l', 'd' });
  const auto source = MakeSource(field);
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(caller);
      algorithm->SetAbortExecute(algorithm->GetProgress() > 0.1 ? 1 : 0);
    });
  encoder->AddObserver(vtkCommand::ProgressEvent, abort);
  const cslf::testing::Observed observed(encoder);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(observed.HasError("stopped"));
  CSLF_CHECK(!cslf::testing::Exists(fileName + ".partial"));
  CSLF_CHECK(cslf::testing::ReadBytes(fileName).size() == 3);
}

void TestFailingInput(vtkImageData* field, const std::string& folder, int slice)
{
  const std::string fileName = folder + "/failing.mp4";
  const auto source = MakeSource(field);
  source->FailingSlice = slice;
  vtkNew<vtkCSLFEncoder> encoder;
  encoder->SetInputConnection(source->GetOutputPort());
  encoder->SetPreset("ultrafast");
  encoder->SetFileName(fileName.c_str());
  const cslf::testing::Observed observed(encoder);
  const cslf::testing::Observed sourceObserved(source);
  CSLF_CHECK(encoder->Write() == 0);
  CSLF_CHECK(observed.GetErrors() == 1);
  CSLF_CHECK(sourceObserved.GetErrors() == 1);
  CSLF_CHECK(!cslf::testing::Exists(fileName));
  CSLF_CHECK(!cslf::testing::Exists(fileName + ".partial"));
}
}

int TestCSLFEncoderStreaming(int argc, char* argv[])
{
  const std::string folder = cslf::testing::MakeFolder(argc, argv, "EncoderStreaming");
  const auto field = cslf::testing::MakeByteField(6, 16);
  TestThreads(field, folder);
  TestAbort(field, folder);
  TestFailingInput(field, folder, 0);
  TestFailingInput(field, folder, 200);
  return cslf::testing::Result();
}
